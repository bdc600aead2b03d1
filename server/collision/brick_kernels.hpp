// Queries of a DistanceBrick, a vector of points at a time. See kernel_body.hpp.
#pragma once

#include "server/collision/kernel_lanes.hpp"

namespace mechane::collision {
namespace {

template <class Lanes>
struct BrickKernels : KernelMath<Lanes> {
  using Base = KernelMath<Lanes>;
  using Base::all;
  using Base::clamp;
  using Base::dot;
  using Base::first;
  using Base::greater;
  using Base::kAll;
  using Base::kWidth;
  using Base::load;
  using Base::load_points;
  using Base::select;
  using Base::store;
  using Base::store_points;
  using Base::to_float;
  using Base::to_int;
  using Base::transform;
  using typename Base::F;
  using typename Base::I;
  using typename Base::Point;

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
      // Seen from the box's nearest point, everything in the box lies ahead or to the side.
      const F ahead = greater(distance(map, cell_of(map, inner)), all(0)) * (map.inverse_cell / map.steepest);
      near |= Lanes::mask_of(at_box & (dot(way, way) + ahead * ahead <= radius * radius)) << at;
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
};

}  // namespace
}  // namespace mechane::collision
