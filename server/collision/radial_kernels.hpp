// Queries of a RadialMap, a vector of points at a time. See kernel_body.hpp.
#pragma once

#include "server/collision/kernel_lanes.hpp"

namespace mechane::collision {
namespace {

template <class Lanes>
struct RadialKernels : KernelMath<Lanes> {
  using Base = KernelMath<Lanes>;
  using Base::all;
  using Base::clamp;
  using Base::dot;
  using Base::first;
  using Base::greater;
  using Base::kAll;
  using Base::kTiny;
  using Base::kWidth;
  using Base::lesser;
  using Base::load;
  using Base::load_points;
  using Base::magnitude;
  using Base::outside_box;
  using Base::select;
  using Base::sign_of;
  using Base::store;
  using Base::store_points;
  using Base::to_float;
  using Base::to_int;
  using Base::transform;
  using typename Base::F;
  using typename Base::I;
  using typename Base::Point;

  static constexpr int kLandings = 5;

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
    const I low = Lanes::template gather<sizeof(std::uint16_t)>(map.texels, index);
    const I high = Lanes::template gather<sizeof(std::uint16_t)>(map.texels, index + n);
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

  /// g at the scaled point x. The gradient costs little more, and nothing where it is not used.
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
  /// On a concave surface a plane reaches beyond the surface that it touches, so the place where each guess lands is tested. A guess that
  /// lands near the surface is replaced by the surface's own plane there, which is one Newton step, and is the answer. One that lands in
  /// the solid under a similar surface is replaced by that surface's plane, which is tried next. Any other is dropped, and the next
  /// nearest is tried.
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
};

}  // namespace
}  // namespace mechane::collision
