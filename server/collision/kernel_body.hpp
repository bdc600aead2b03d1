// The kernels' one source, for lanes of any width: compiled once for each instruction set by kernels_*.cpp, which bring the three
// things that C++ cannot say in vectors (see PortableLanes). Includes nothing that is compiled elsewhere too: an inline function
// with this file's instructions must not be what a machine without them runs.
#pragma once

#include "server/collision/kernels.hpp"

// Vectors wider than the instruction set's are passed in some way of the compiler's own, and only within this file.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace mechane::collision {
namespace {

// The compilers' own vectors; their size must not depend on a template's parameter.
template <int Width>
struct VectorsOf;
template <>
struct VectorsOf<4> {
  typedef float F __attribute__((vector_size(16)));
  typedef int I __attribute__((vector_size(16)));
};
template <>
struct VectorsOf<8> {
  typedef float F __attribute__((vector_size(32)));
  typedef int I __attribute__((vector_size(32)));
};
template <>
struct VectorsOf<16> {
  typedef float F __attribute__((vector_size(64)));
  typedef int I __attribute__((vector_size(64)));
};

/// Lanes of `Width` floats. A class that derives from it may bring better root(), gather() and mask_of().
template <int Width>
struct PortableLanes {
  static constexpr int kWidth = Width;
  using F = typename VectorsOf<Width>::F;
  using I = typename VectorsOf<Width>::I;

  static F root(F x) {
    for (int i = 0; i < Width; ++i)
      x[i] = __builtin_sqrtf(x[i]);
    return x;
  }
  /// For each lane the two 16-bit values from table[index] on, the first in the low half.
  static I gather(const void* table, I index) {
    I out{};
    for (int i = 0; i < Width; ++i) {
      int pair = 0;
      __builtin_memcpy(&pair, static_cast<const char*>(table) + 2 * static_cast<long>(index[i]), sizeof pair);
      out[i] = pair;
    }
    return out;
  }
  static LaneMask mask_of(I condition) {
    LaneMask bits = 0;
    for (int i = 0; i < Width; ++i)
      bits |= (condition[i] != 0 ? 1U : 0U) << i;
    return bits;
  }
};

template <class Lanes>
struct KernelBody {
  using F = typename Lanes::F;
  using I = typename Lanes::I;
  static constexpr int kWidth = Lanes::kWidth;
  static constexpr LaneMask kAll = kWidth == 32 ? ~0U : (1U << kWidth) - 1;
  static constexpr float kTiny = 1e-20F;
  static constexpr int kLandings = 5;

  struct Point {
    F x, y, z;
  };
  /// g = m sigma(u, v) - 1 and its gradient dg/dp, 1/m.
  struct Local {
    F m, g;
    Point gradient;
  };
  struct Plane {
    Point n;
    F depth;
  };
  struct Texel {
    F sigma, sigma_u, sigma_v;
  };

  static F all(float value) { return F{} + value; }
  static F select(I condition, F a, F b) {
    return reinterpret_cast<F>((condition & reinterpret_cast<I>(a)) | (~condition & reinterpret_cast<I>(b)));
  }
  // Both give b where a is NaN.
  static F lesser(F a, F b) { return select(a < b, a, b); }
  static F greater(F a, F b) { return select(a > b, a, b); }
  static F magnitude(F x) { return reinterpret_cast<F>(reinterpret_cast<I>(x) & 0x7fffffff); }
  static F sign_of(F x) { return select(x < 0.0F, all(-1), all(1)); }
  static I to_int(F x) { return __builtin_convertvector(x, I); }
  static F to_float(I x) { return __builtin_convertvector(x, F); }
  static F clamp(F x, float least, float most) { return lesser(greater(x, all(least)), all(most)); }
  static F dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

  static F load(const float* from, int at) {
    F out;
    __builtin_memcpy(&out, from + at, sizeof out);
    return out;
  }
  template <class Array>
  static void store(F value, Array& to, int at) {
    __builtin_memcpy(&to[static_cast<std::size_t>(at)], &value, sizeof value);
  }
  static Point load_points(const PointsView& points, int at) {
    return {load(points.x, at), load(points.y, at), load(points.z, at)};
  }
  static void store_points(const Point& p, PointBlock& block, int at) {
    store(p.x, block.x, at);
    store(p.y, block.y, at);
    store(p.z, block.z, at);
  }

  static Point transform(const BlockTransform& X, const Point& p) {
    const auto& r = X.R_BA;
    return {r[0] * p.x + r[1] * p.y + r[2] * p.z + X.p_BA[0], r[3] * p.x + r[4] * p.y + r[5] * p.z + X.p_BA[1],
            r[6] * p.x + r[7] * p.y + r[8] * p.z + X.p_BA[2]};
  }

  /// Squared distance to a box around the origin.
  static F outside_box(const Point& p, const std::array<float, 3>& half) {
    const Point out{greater(magnitude(p.x) - half[0], all(0)), greater(magnitude(p.y) - half[1], all(0)),
                    greater(magnitude(p.z) - half[2], all(0))};
    return dot(out, out);
  }
  static LaneMask first(std::size_t count) { return count >= kLanes ? 0xffffU : (1U << count) - 1; }

  // ---- radial map ---------------------------------------------------------------------------------------------------------------

  static Point scaled(const RadialView& map, const Point& p) {
    return {(p.x - map.center[0]) * map.inverse_half[0], (p.y - map.center[1]) * map.inverse_half[1],
            (p.z - map.center[2]) * map.inverse_half[2]};
  }

  /// sigma and its derivatives at (u, v) of a face, bilinear.
  static Texel texel(const RadialView& map, I face, F u, F v) {
    const int n = map.resolution;
    const float half_n = 0.5F * static_cast<float>(n - 1);
    const F tu = clamp(u * half_n + half_n, 0.0F, 2 * half_n);
    const F tv = clamp(v * half_n + half_n, 0.0F, 2 * half_n);
    const F last = all(static_cast<float>(n - 2));
    const I iu = to_int(lesser(tu, last));
    const I iv = to_int(lesser(tv, last));
    const F fu = tu - to_float(iu);
    const F fv = tv - to_float(iv);
    const I index = (face * n + iv) * n + iu;
    const I low = Lanes::gather(map.texels, index);
    const I high = Lanes::gather(map.texels, index + n);
    const F s00 = to_float(low & 0xffff);
    const F s10 = to_float((low >> 16) & 0xffff);
    const F s01 = to_float(high & 0xffff);
    const F s11 = to_float((high >> 16) & 0xffff);
    const F d0 = s10 - s00;
    const F d1 = s11 - s01;
    const F s0 = s00 + d0 * fu;
    const F s1 = s01 + d1 * fu;
    const float slope = map.sigma_step * half_n;
    return {(s0 + (s1 - s0) * fv) * map.sigma_step, (d0 + (d1 - d0) * fv) * slope, (s1 - s0) * slope};
  }

  /// Which axis is the longest, and the coordinates in its order.
  struct Face {
    I is_x, is_y;
    F a, b, c;
  };
  static Face face_of(const Point& x) {
    const F ax = magnitude(x.x);
    const F ay = magnitude(x.y);
    const F az = magnitude(x.z);
    const I is_x = (ax >= ay) & (ax >= az);
    const I is_y = ~is_x & (ay >= az);
    return {is_x, is_y, select(is_x, x.x, select(is_y, x.y, x.z)), select(is_x, x.y, select(is_y, x.z, x.x)),
            select(is_x, x.z, select(is_y, x.x, x.y))};
  }

  /// g at the scaled point x. The gradient costs little more, and what does not use it does not pay for it.
  static Local local(const RadialView& map, const Point& x) {
    const Face f = face_of(x);
    const F m = magnitude(f.a);
    const F inverse = 1.0F / (m + kTiny);
    const F u = f.b * inverse;
    const F v = f.c * inverse;
    const I axis = (f.is_x & 0) | (f.is_y & 1) | (~(f.is_x | f.is_y) & 2);
    const I face = 2 * axis + ((f.a < 0.0F) & 1);
    const Texel t = texel(map, face, u, v);
    // g = m sigma(u, v) - 1 with u = b / m, v = c / m: the chain rule's 1/m cancels against m.
    const F ga = sign_of(f.a) * (t.sigma - u * t.sigma_u - v * t.sigma_v);
    return {m, m * t.sigma - 1.0F,
            Point{select(f.is_x, ga, select(f.is_y, t.sigma_v, t.sigma_u)) * map.inverse_half[0],
                  select(f.is_x, t.sigma_u, select(f.is_y, ga, t.sigma_v)) * map.inverse_half[1],
                  select(f.is_x, t.sigma_v, select(f.is_y, t.sigma_u, ga)) * map.inverse_half[2]}};
  }

  /// The tangent plane of g at `foot`, and the depth of x under it; depth 0: no such plane (every direction hereabouts is covered).
  static Plane tangent_plane(const RadialView& map, const Point& x, const Point& foot, F g, const Point& gradient) {
    const F square = dot(gradient, gradient);
    // g is nearly linear along a ray and from it to the sides, so g + gradient (y - foot) = 0 is the tangent plane.
    const Point way{(x.x - foot.x) * map.half[0], (x.y - foot.y) * map.half[1], (x.z - foot.z) * map.half[2]};
    const F g_at_x = g + dot(gradient, way);
    const I sound = square > kTiny;
    const F inverse = 1.0F / Lanes::root(select(sound, square, all(1)));
    const F depth = select(sound, greater(-g_at_x * inverse, all(0)), all(0));
    return {{gradient.x * inverse, gradient.y * inverse, gradient.z * inverse}, depth};
  }

  static Plane select(I condition, const Plane& a, const Plane& b) {
    return {{select(condition, a.n.x, b.n.x), select(condition, a.n.y, b.n.y), select(condition, a.n.z, b.n.z)},
            select(condition, a.depth, b.depth)};
  }

  /// The plane where the line through x along an axis leaves through the face on one of its ends.
  template <int Axis, int Sign>
  static Plane plane_along(const RadialView& map, const Point& x) {
    const F u = Axis == 0 ? x.y : Axis == 1 ? x.z : x.x;
    const F v = Axis == 0 ? x.z : Axis == 1 ? x.x : x.y;
    const F sign = all(Sign);
    const Texel t = texel(map, I{} + (2 * Axis + (Sign < 0 ? 1 : 0)), u, v);
    const F ga = sign * (t.sigma - u * t.sigma_u - v * t.sigma_v) * map.inverse_half[Axis];
    const F gu = t.sigma_u * map.inverse_half[(Axis + 1) % 3];
    const F gv = t.sigma_v * map.inverse_half[(Axis + 2) % 3];
    const Point foot{Axis == 0 ? sign : x.x, Axis == 1 ? sign : x.y, Axis == 2 ? sign : x.z};
    const Point gradient{Axis == 0   ? ga
                         : Axis == 1 ? gv
                                     : gu,
                         Axis == 0   ? gu
                         : Axis == 1 ? ga
                                     : gv,
                         Axis == 0   ? gv
                         : Axis == 1 ? gu
                                     : ga};
    return tangent_plane(map, x, foot, t.sigma - 1.0F, gradient);
  }

  static Plane nearer(const Plane& a, const Plane& b) {
    return select((b.depth > 0.0F) & ((b.depth < a.depth) | ~(a.depth > 0.0F)), b, a);
  }

  /// The nearest of seven tangent planes that is really there: where x's own ray and where the six ways along the axes meet the surface.
  /// On a concave surface a plane reaches beyond what it touches, so each guess is looked at where it lands. What lands near the
  /// surface gives way to the surface's own plane there, which is one Newton step, and is the answer. What lands in the wood under a
  /// like surface gives way to that one's plane, which is tried in its turn; any other is dropped, and the next nearest is tried.
  static Plane nearest_surface(const RadialView& map, const Point& x, const Local& here) {
    Plane guesses[8] = {tangent_plane(map, x, x, here.g, here.gradient),
                        plane_along<0, 1>(map, x),
                        plane_along<0, -1>(map, x),
                        plane_along<1, 1>(map, x),
                        plane_along<1, -1>(map, x),
                        plane_along<2, 1>(map, x),
                        plane_along<2, -1>(map, x),
                        Plane{}};
    Plane best{};
    I open = all(1) > 0.0F;
    for (int round = 0; round < kLandings && Lanes::mask_of(open) != 0; ++round) {
      Plane guess = guesses[0];
      for (int i = 1; i < 8; ++i)
        guess = nearer(guess, guesses[i]);
      const Point landed{x.x + guess.depth * guess.n.x * map.inverse_half[0],
                         x.y + guess.depth * guess.n.y * map.inverse_half[1],
                         x.z + guess.depth * guess.n.z * map.inverse_half[2]};
      const Local at = local(map, landed);
      const Plane there = tangent_plane(map, x, landed, at.g, at.gradient);
      const F left = -at.g;
      const F reach = 0.5F * guess.depth;
      const I alike = (there.depth > 0.0F) & (dot(there.n, guess.n) > 0.5F);
      const I arrived = (there.depth < 2.0F * guess.depth) &
                        ((left < 0.0F) | (left * left <= reach * reach * dot(at.gradient, at.gradient)));
      best = select(open & alike & arrived, there, best);
      open = open & ~(alike & arrived) & (guess.depth > 0.0F);
      best = select(open & ~(best.depth > 0.0F), guess, best);  // until something better comes
      for (Plane& other : guesses)
        other.depth = select(open & (other.depth <= guess.depth), all(0), other.depth);
      const I goes_on = open & alike & (there.depth > guess.depth);
      guesses[7] = select(goes_on, nearer(there, guesses[7]), guesses[7]);
    }
    return best;
  }

  static LaneMask radial_near(const RadialView& map, const BlockTransform& X, const SpheresView& spheres,
                              std::size_t count) noexcept {
    LaneMask near = 0;
    for (int at = 0; at < static_cast<int>(count); at += kWidth) {
      const Point p = transform(X, {load(spheres.x, at), load(spheres.y, at), load(spheres.z, at)});
      const F radius = load(spheres.radius, at);
      const Point from{p.x - map.center[0], p.y - map.center[1], p.z - map.center[2]};
      const I at_box = outside_box(from, map.half) <= radius * radius;
      if (Lanes::mask_of(at_box) == 0) continue;
      // g grows in proportion to the distance from the centre, so it holds beyond the box, too.
      const Local here =
          local(map, {from.x * map.inverse_half[0], from.y * map.inverse_half[1], from.z * map.inverse_half[2]});
      near |= Lanes::mask_of(at_box & (here.g <= map.steepest * radius)) << at;
    }
    return near & first(count);
  }

  static LaneMask radial_inside(const RadialView& map, const BlockTransform& X, const PointsView& points,
                                InsideBlock& out) noexcept {
    LaneMask inside = 0;
    for (int at = 0; at < static_cast<int>(kLanes); at += kWidth) {
      const Point p = transform(X, load_points(points, at));
      const Point x = scaled(map, p);
      // Written so that NaN is outside.
      const I in_box = (magnitude(x.x) <= 1.0F) & (magnitude(x.y) <= 1.0F) & (magnitude(x.z) <= 1.0F);
      store_points(p, out.p_Q, at);
      if (Lanes::mask_of(in_box) == 0) continue;
      const Local here = local(map, x);
      store(here.m, out.m, at);
      inside |= Lanes::mask_of(in_box & (here.g < 0.0F)) << at;
    }
    return inside;
  }

  static void radial_depth(const RadialView& map, const PointBlock& p_Q, LaneMask wanted, DepthBlock& out) noexcept {
    for (int at = 0; at < static_cast<int>(kLanes); at += kWidth) {
      if (((wanted >> at) & kAll) == 0) continue;
      const Point x = scaled(map, load_points(p_Q.view(), at));
      const Local here = local(map, x);
      const Plane best = nearest_surface(map, x, here);
      store(best.depth, out.depth_m, at);
      store_points(best.n, out.n_Q, at);
    }
  }

  // ---- distance brick -----------------------------------------------------------------------------------------------------------

  /// The cell of a point and its eight values, as the value on the low corner and differences.
  struct Cell {
    F fx, fy, fz;
    F x00, x10, x01, x11;  // along x
    F d00, d10, d01, d11;  // their slopes
  };
  static Cell cell_of(const BrickView& map, const Point& u) {
    const auto low = [](F t, int nodes) { return to_int(clamp(t, 0.0F, static_cast<float>(nodes - 2))); };
    const I ix = low(u.x, map.nodes[0]);
    const I iy = low(u.y, map.nodes[1]);
    const I iz = low(u.z, map.nodes[2]);
    const I index = (iz * map.nodes[1] + iy) * map.nodes[0] + ix;
    const int layer = map.nodes[0] * map.nodes[1];
    const I g00 = Lanes::gather(map.values, index);
    const I g10 = Lanes::gather(map.values, index + map.nodes[0]);
    const I g01 = Lanes::gather(map.values, index + layer);
    const I g11 = Lanes::gather(map.values, index + layer + map.nodes[0]);
    const auto first = [](I pair) { return to_float((pair << 16) >> 16); };
    const auto slope = [&](I pair) { return to_float(pair >> 16) - first(pair); };
    Cell c;
    c.fx = u.x - to_float(ix);
    c.fy = u.y - to_float(iy);
    c.fz = u.z - to_float(iz);
    c.d00 = slope(g00);
    c.d10 = slope(g10);
    c.d01 = slope(g01);
    c.d11 = slope(g11);
    c.x00 = first(g00) + c.d00 * c.fx;
    c.x10 = first(g10) + c.d10 * c.fx;
    c.x01 = first(g01) + c.d01 * c.fx;
    c.x11 = first(g11) + c.d11 * c.fx;
    return c;
  }
  static Point brick_coordinates(const BrickView& map, const Point& p) {
    return {(p.x - map.origin[0]) * map.inverse_cell, (p.y - map.origin[1]) * map.inverse_cell,
            (p.z - map.origin[2]) * map.inverse_cell};
  }
  static F distance(const BrickView& map, const Cell& c) {
    const F y0 = c.x00 + (c.x10 - c.x00) * c.fy;
    const F y1 = c.x01 + (c.x11 - c.x01) * c.fy;
    return (y0 + (y1 - y0) * c.fz) * map.step_m;
  }

  static LaneMask brick_near(const BrickView& map, const BlockTransform& X, const SpheresView& spheres,
                             std::size_t count) noexcept {
    LaneMask near = 0;
    const auto most = [&](int axis) { return static_cast<float>(map.nodes[static_cast<std::size_t>(axis)] - 1); };
    for (int at = 0; at < static_cast<int>(count); at += kWidth) {
      const Point u =
          brick_coordinates(map, transform(X, {load(spheres.x, at), load(spheres.y, at), load(spheres.z, at)}));
      const F radius = load(spheres.radius, at) * map.inverse_cell;
      const Point inner{clamp(u.x, 0.0F, most(0)), clamp(u.y, 0.0F, most(1)), clamp(u.z, 0.0F, most(2))};
      const Point way{u.x - inner.x, u.y - inner.y, u.z - inner.z};
      const I at_box = dot(way, way) <= radius * radius;
      if (Lanes::mask_of(at_box) == 0) continue;
      // What the grid says is right to less than a cell's diagonal; seen from the box's nearest point the surface lies ahead.
      const F far = distance(map, cell_of(map, inner)) * map.inverse_cell - 1.8F;
      near |= Lanes::mask_of(at_box & (far <= radius)) << at;
    }
    return near & first(count);
  }

  static LaneMask brick_inside(const BrickView& map, const BlockTransform& X, const PointsView& points,
                               InsideBlock& out) noexcept {
    LaneMask inside = 0;
    for (int at = 0; at < static_cast<int>(kLanes); at += kWidth) {
      const Point p = transform(X, load_points(points, at));
      const Point u = brick_coordinates(map, p);
      const auto within = [](F t, int nodes) { return (t >= 0.0F) & (t <= static_cast<float>(nodes - 1)); };
      const I in_box = within(u.x, map.nodes[0]) & within(u.y, map.nodes[1]) & within(u.z, map.nodes[2]);
      store_points(p, out.p_Q, at);
      store(all(0), out.m, at);  // exact wherever it reaches: it goes before every radial map
      if (Lanes::mask_of(in_box) == 0) continue;
      inside |= Lanes::mask_of(in_box & (distance(map, cell_of(map, u)) < 0.0F)) << at;
    }
    return inside;
  }

  static void brick_depth(const BrickView& map, const PointBlock& p_Q, LaneMask wanted, DepthBlock& out) noexcept {
    for (int at = 0; at < static_cast<int>(kLanes); at += kWidth) {
      if (((wanted >> at) & kAll) == 0) continue;
      const Cell c = cell_of(map, brick_coordinates(map, load_points(p_Q.view(), at)));
      const F y0 = c.x00 + (c.x10 - c.x00) * c.fy;
      const F y1 = c.x01 + (c.x11 - c.x01) * c.fy;
      const F ex0 = c.d00 + (c.d10 - c.d00) * c.fy;
      const F ex1 = c.d01 + (c.d11 - c.d01) * c.fy;
      const F ey0 = c.x10 - c.x00;
      const F ey1 = c.x11 - c.x01;
      const Point gradient{ex0 + (ex1 - ex0) * c.fz, ey0 + (ey1 - ey0) * c.fz, y1 - y0};
      const F square = dot(gradient, gradient);
      const I sound = square > 0.0F;  // on a medial axis the way out is anywhere: along z then
      const F inverse = 1.0F / Lanes::root(select(sound, square, all(1)));
      store_points({select(sound, gradient.x * inverse, all(0)), select(sound, gradient.y * inverse, all(0)),
                    select(sound, gradient.z * inverse, all(1))},
                   out.n_Q, at);
      store(greater(-distance(map, c), all(0)), out.depth_m, at);
    }
  }

  static constexpr Kernels table(const char* name) {
    return {name, &radial_near, &brick_near, &radial_inside, &brick_inside, &radial_depth, &brick_depth};
  }
};

}  // namespace
}  // namespace mechane::collision
