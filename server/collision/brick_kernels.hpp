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
  using Base::lesser;
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
    F base;                // of all values
  };
  /// Where a point's cell is stored, and the bytes of its values.
  struct Place {
    F fx, fy, fz;  // in the cell
    F base;
    I entry, at, cells, layer_step;
    I sheets;
  };
  /// The cell of a point, in blocks. A point outside the box gets the cell next to it. Indices are exact in floats: below 2^24.
  [[gnu::always_inline]] static Place place_of(const BrickView& map, const Point& u) {
    const auto floor_below = [](F t, F most) { return to_float(to_int(lesser(greater(t, all(0)), most))); };
    const auto block_at = [&](F t, int count) { return floor_below(t, all(static_cast<float>(count - 1))); };
    const F bx = block_at(u.x, map.blocks[0]);
    const F by = block_at(u.y, map.blocks[1]);
    const F bz = block_at(u.z, map.blocks[2]);
    const auto row = static_cast<float>(map.blocks[0]);
    const auto layer = static_cast<float>(map.blocks[0] * map.blocks[1]);
    Place place;
    const I entry = Lanes::template gather<sizeof(std::uint32_t)>(map.index, to_int(bz * layer + by * row + bx));
    // See DistanceBrick::Entry: 2 bits of level, 20 of place, 1 each for outer, inner and three, 7 of base.
    const I level = entry & 3;
    place.entry = entry;
    place.sheets = level == 3;
    place.cells = (I{} + 1) << (level & ~place.sheets);
    const F along = to_float(place.cells);
    const F last = along - 1.0F;
    const F stride = along + 1.0F;
    const Point v{(u.x - bx) * along, (u.y - by) * along, (u.z - bz) * along};
    const F ix = floor_below(v.x, last);
    const F iy = floor_below(v.y, last);
    const F iz = floor_below(v.z, last);
    place.at = (entry & 0x3ffffc) + to_int((iz * stride + iy) * stride + ix);
    place.layer_step = to_int(stride * stride);
    place.fx = v.x - ix;
    place.fy = v.y - iy;
    place.fz = v.z - iz;
    place.base = to_float((entry >> 25) << 5);
    return place;
  }
  // A cell fills 13 registers, too many to pass in a call.
  [[gnu::always_inline]] static Cell first_cell(const BrickView& map, const Place& place) {
    Cell c;
    c.fx = place.fx;
    c.fy = place.fy;
    c.fz = place.fz;
    c.base = place.base;
    if (Lanes::mask_of(place.cells > 1) == 0) {
      read_sheet(map, place.at, c);  // one cell: half the gathers, and the same values
    } else {
      read_values(map, place.at, place.cells + 1, place.layer_step, c);
    }
    return c;
  }
  /// For a block with sheets: the cell of the sheet that decides at the point; see DistanceBrick.
  [[gnu::always_inline]] static Cell cell_of(const BrickView& map, const Point& u) {
    const Place place = place_of(map, u);
    Cell c = first_cell(map, place);
    if (Lanes::mask_of(place.sheets) == 0) return c;
    Cell rest = c;
    read_sheet(map, place.at + (place.sheets & 8), rest);
    const I three = three_of(place);
    if (Lanes::mask_of(three) != 0) {
      Cell third = rest;
      read_sheet(map, place.at + (place.sheets & 8) + (three & 8), third);
      take(three & inner_takes(place, steps(third), steps(rest)), third, rest);
    }
    take(place.sheets & outer_takes(place, steps(rest), steps(c)), rest, c);
    const F unit = unit_of(place);
    for (F Cell::*value : kValues)
      c.*value *= unit;
    return c;
  }
  /// The distance alone, to the bits that distance(map, cell_of(map, u)) has: twice a float is exact.
  [[gnu::always_inline]] static F distance_at(const BrickView& map, const Point& u) {
    const Place place = place_of(map, u);
    Cell c = first_cell(map, place);
    F value = steps(c);
    if (Lanes::mask_of(place.sheets) != 0) {
      read_sheet(map, place.at + (place.sheets & 8), c);
      F rest = steps(c);
      const I three = three_of(place);
      if (Lanes::mask_of(three) != 0) {
        read_sheet(map, place.at + (place.sheets & 8) + (three & 8), c);
        const F third = steps(c);
        rest = select(three & inner_takes(place, third, rest), third, rest);
      }
      value = select(place.sheets & outer_takes(place, rest, value), rest, value) * unit_of(place);
    }
    return (value + place.base) * map.step_m;
  }
  static I three_of(const Place& place) { return place.sheets & ((place.entry << 7) < 0); }
  static I inner_takes(const Place& place, F third, F second) { return ((place.entry << 8) < 0) ^ (third < second); }
  static I outer_takes(const Place& place, F rest, F first) { return ((place.entry << 9) < 0) ^ (rest < first); }
  static F unit_of(const Place& place) { return select(place.sheets, all(2), all(1)); }
  static constexpr F Cell::*kValues[] = {&Cell::x00, &Cell::x10, &Cell::x01, &Cell::x11,
                                         &Cell::d00, &Cell::d10, &Cell::d01, &Cell::d11};
  /// Where `holds`, the values of `other` in place of those of `c`.
  [[gnu::always_inline]] static void take(I holds, const Cell& other, Cell& c) {
    for (F Cell::*value : kValues)
      c.*value = select(holds, other.*value, c.*value);
  }
  template <int Byte>
  static F byte_of(I four) {
    return to_float((four << (24 - 8 * Byte)) >> 24);
  }
  [[gnu::always_inline]] static void read_values(const BrickView& map, I at, I row_step, I layer_step, Cell& c) {
    const auto four = [&](I index) { return Lanes::template gather<1>(map.values, index); };
    const I g00 = four(at);
    const I g10 = four(at + row_step);
    const I g01 = four(at + layer_step);
    const I g11 = four(at + layer_step + row_step);
    c.d00 = byte_of<1>(g00) - byte_of<0>(g00);
    c.d10 = byte_of<1>(g10) - byte_of<0>(g10);
    c.d01 = byte_of<1>(g01) - byte_of<0>(g01);
    c.d11 = byte_of<1>(g11) - byte_of<0>(g11);
    c.x00 = byte_of<0>(g00) + c.d00 * c.fx;
    c.x10 = byte_of<0>(g10) + c.d10 * c.fx;
    c.x01 = byte_of<0>(g01) + c.d01 * c.fx;
    c.x11 = byte_of<0>(g11) + c.d11 * c.fx;
  }
  /// A sheet's eight values lie side by side, as those of a block of one cell do.
  [[gnu::always_inline]] static void read_sheet(const BrickView& map, I at, Cell& c) {
    const I low = Lanes::template gather<1>(map.values, at);
    const I high = Lanes::template gather<1>(map.values, at + 4);
    c.d00 = byte_of<1>(low) - byte_of<0>(low);
    c.d10 = byte_of<3>(low) - byte_of<2>(low);
    c.d01 = byte_of<1>(high) - byte_of<0>(high);
    c.d11 = byte_of<3>(high) - byte_of<2>(high);
    c.x00 = byte_of<0>(low) + c.d00 * c.fx;
    c.x10 = byte_of<2>(low) + c.d10 * c.fx;
    c.x01 = byte_of<0>(high) + c.d01 * c.fx;
    c.x11 = byte_of<2>(high) + c.d11 * c.fx;
  }
  [[gnu::always_inline]] static F steps(const Cell& c) {
    const F y0 = c.x00 + (c.x10 - c.x00) * c.fy;
    const F y1 = c.x01 + (c.x11 - c.x01) * c.fy;
    return y0 + (y1 - y0) * c.fz;
  }
  static Point brick_coordinates(const BrickView& map, const Point& p) {
    return {(p.x - map.origin[0]) * map.inverse_block, (p.y - map.origin[1]) * map.inverse_block,
            (p.z - map.origin[2]) * map.inverse_block};
  }
  static F distance(const BrickView& map, const Cell& c) { return (steps(c) + c.base) * map.step_m; }

  static LaneMask brick_near(const BrickView& map, const BlockTransform& X, const SpheresView& spheres,
                             std::size_t count) noexcept {
    LaneMask near = 0;
    const auto most = [&](int axis) { return static_cast<float>(map.blocks[static_cast<std::size_t>(axis)]); };
    for (int at = 0; at < static_cast<int>(count); at += kWidth) {
      const Point u =
          brick_coordinates(map, transform(X, {load(spheres.x, at), load(spheres.y, at), load(spheres.z, at)}));
      const F radius = load(spheres.radius, at) * map.inverse_block;
      const Point inner{clamp(u.x, 0.0F, most(0)), clamp(u.y, 0.0F, most(1)), clamp(u.z, 0.0F, most(2))};
      const Point way{u.x - inner.x, u.y - inner.y, u.z - inner.z};
      const I at_box = dot(way, way) <= radius * radius;
      if (Lanes::mask_of(at_box) == 0) continue;
      // Seen from the point of the box that is nearest, everything in the box lies ahead or to the side.
      const F ahead = greater(distance_at(map, inner) - map.slack_m, all(0)) * map.inverse_block;
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
      const auto within = [](F t, int blocks) { return (t >= 0.0F) & (t <= static_cast<float>(blocks)); };
      const I in_box = within(u.x, map.blocks[0]) & within(u.y, map.blocks[1]) & within(u.z, map.blocks[2]);
      store_points(p, out.p_Q, at);
      store(all(0), out.m, at);  // exact wherever it reaches, so it is preferred to every radial map
      if (Lanes::mask_of(in_box) == 0) continue;
      inside |= Lanes::mask_of(in_box & (distance_at(map, u) < 0.0F)) << at;
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
      const I sound = square > 0.0F;  // on a medial axis every direction leads out: take z
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
