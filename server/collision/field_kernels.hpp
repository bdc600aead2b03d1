// Queries of a DistanceField, a vector of points at a time. See kernel_body.hpp, and DistanceField for what is stored.
#pragma once

#include "server/collision/field_leaves.hpp"

namespace mechane::collision {
namespace {

template <class Lanes>
struct FieldKernels : FieldLeaves<Lanes> {
  using Base = FieldLeaves<Lanes>;
  using Base::all;
  using Base::clamp;
  using Base::depth_of;
  using Base::dot;
  using Base::first;
  using Base::greater;
  using Base::kAll;
  using Base::kWidth;
  using Base::lesser;
  using Base::load;
  using Base::load_points;
  using Base::load_quads;
  using Base::mad;
  using Base::select;
  using Base::shuffle;
  using Base::store;
  using Base::store_points;
  using Base::to_float;
  using Base::to_int;
  using Base::told;
  using Base::unit;
  using typename Base::F;
  using typename Base::I;
  using typename Base::Point;
  using typename Base::Slope;
  static constexpr int kQuads = kWidth / 4;  // in a vector

  static I pick(I condition, I a, I b) { return (condition & a) | (~condition & b); }
  static Point transform(const BlockTransform& X, const Point& p) {
    const auto row = [&](std::size_t i) {
      const float* r = &X.R_BA[3 * i];
      return mad(all(r[0]), p.x, mad(all(r[1]), p.y, mad(all(r[2]), p.z, all(X.p_BA[i]))));
    };
    return {row(0), row(1), row(2)};
  }
  static Point rotate(const std::array<float, 9>& R, const Point& p) {
    const auto row = [&](std::size_t i) { return dot({all(R[3 * i]), all(R[3 * i + 1]), all(R[3 * i + 2])}, p); };
    return {row(0), row(1), row(2)};
  }

  /// A block, and a place in it: 0 to 1 along each edge, if the place lies in the box.
  struct Place {
    I block;
    Point f;
  };
  /// Of a place in units of blocks. One outside the box gets the block next to it. Indices are exact in floats: below 2^24.
  [[gnu::always_inline]] static Place place_of(const FieldView& map, const Point& u) {
    const auto floor_in = [&](F t, int axis) {
      const auto last = static_cast<float>(map.blocks[static_cast<std::size_t>(axis)] - 1);
      return to_float(to_int(clamp(t, 0.0F, last)));
    };
    const Point low{floor_in(u.x, 0), floor_in(u.y, 1), floor_in(u.z, 2)};
    const F row = all(static_cast<float>(map.blocks[0]));
    const F layer = all(static_cast<float>(map.blocks[0] * map.blocks[1]));
    return {to_int(mad(low.z, layer, mad(low.y, row, low.x))), {u.x - low.x, u.y - low.y, u.z - low.z}};
  }
  static I is_in_box(const Place& at) {
    const F least = lesser(at.f.x, lesser(at.f.y, at.f.z));
    const F most = greater(at.f.x, greater(at.f.y, at.f.z));
    return (least >= 0.0F) & (most < 1.0F);
  }
  /// Never more than the true distance, in blocks; see DistanceField::Plane.
  [[gnu::always_inline]] static F bound_at(const FieldView& map, const Place& at) {
    const I plane = Lanes::template gather<8>(map.entries, at.block);
    const Point slope{to_float((plane << 11) >> 25), to_float((plane << 18) >> 25), to_float((plane << 25) >> 25)};
    const F rise = dot(slope, {at.f.x - 0.5F, at.f.y - 0.5F, at.f.z - 0.5F});
    return mad(to_float(plane >> 21), all(kFieldValueStep), rise * kFieldSlopeStep);
  }

  /// Where a place, in units of blocks, lies in what its block's word says of: a leaf of 2^span blocks, or the block itself.
  [[gnu::always_inline]] static Point in_span(I word, const Point& u) {
    const F share = reinterpret_cast<F>((127 - (word >> kFieldSpanAt)) << 23);  // 2^-span
    const auto along = [&](F t) {
      t = t * share;
      return t - to_float(to_int(t));
    };
    return {along(u.x), along(u.y), along(u.z)};
  }
  /// The leaf of a place, found from its block's word on down. `f` becomes the place in the leaf.
  [[gnu::always_inline]] static I leaf_of(const FieldView& map, I word, Point& f) {
    for (int level = 0; level < kFieldLevels; ++level) {
      const I split = (word & 1) != 0;
      if (Lanes::mask_of(split) == 0) break;
      const auto halve = [&](F& t) {
        const F twice = t + t;
        const I upper = twice >= 1.0F;
        t = select(split, twice - select(upper, all(1), all(0)), t);
        return upper;
      };
      const I x = halve(f.x);
      const I y = halve(f.y);
      const I z = halve(f.z);
      const I child = (word >> 1) + ((x & 1) | (y & 2) | (z & 4));
      word = pick(split, Lanes::template gather<4>(map.children, child & split), word);
    }
    return word;
  }

  /// Which spheres may hold a point inside: places in blocks, radii in metres.
  [[gnu::always_inline]] static I reaches(const FieldView& map, const Point& u, F radius_m) {
    const auto most = [&](std::size_t axis) { return static_cast<float>(map.blocks[axis]); };
    const Point inner{clamp(u.x, 0.0F, most(0)), clamp(u.y, 0.0F, most(1)), clamp(u.z, 0.0F, most(2))};
    const Point way{u.x - inner.x, u.y - inner.y, u.z - inner.z};
    // Seen from the point of the box that is nearest, everything in the box lies ahead or to the side.
    const F ahead = greater(bound_at(map, place_of(map, inner)) - map.slack, all(0));
    const F radius = mad(radius_m, all(map.inverse_block), all(map.margin));
    return mad(ahead, ahead, dot(way, way)) <= radius * radius;
  }

  static LaneMask field_near(const FieldView& map, const BlockTransform& X, const SpheresView& spheres,
                             std::size_t count) noexcept {
    LaneMask near = 0;
    for (int at = 0; at < static_cast<int>(count); at += kWidth) {
      const Point u = transform(X, {load(spheres.x, at), load(spheres.y, at), load(spheres.z, at)});
      near |= Lanes::mask_of(reaches(map, u, load(spheres.radius, at))) << at;
    }
    return near & first(count);
  }

  // Lists of fours are read kQuads at a time: the last is repeated until they are full. There is room.
  static void fill_up(std::uint32_t* fours, std::size_t count) {
    for (std::size_t i = count; i % kQuads != 0; ++i)
      fours[i] = fours[count - 1];
  }
  static LaneMask lanes_left(std::size_t left) { return left >= kQuads ? kAll : (LaneMask{1} << (4 * left)) - 1; }
  /// 4 i to 4 i + 3 for each i.
  [[gnu::always_inline]] static I numbers(const std::uint32_t* fours) {
    const F raw = load_quads([&](int) { return reinterpret_cast<const float*>(fours); });
    const F spread = shuffle(raw, raw, [](int lane) { return lane / 4; });
    return (reinterpret_cast<I>(spread) << 2) + (lane_numbers() & 3);
  }
  static I lane_numbers() { return read<I>(kFieldLanes); }
  template <class Vector>
  static Vector read(const std::uint32_t* from) {
    Vector out;
    __builtin_memcpy(&out, from, sizeof out);
    return out;
  }
  template <class Vector>
  static void append(std::uint32_t* to, Vector value, LaneMask lanes) {
    const Vector packed = Lanes::pack(value, lanes);
    __builtin_memcpy(to, &packed, sizeof packed);
  }

  static std::size_t field_sift(const FieldView& map, const BlockTransform& X, const SpheresView& spheres,
                                std::size_t stride, std::uint32_t* fours, std::size_t count,
                                std::uint32_t* out) noexcept {
    std::size_t found = 0;
    fill_up(fours, count);
    for (std::size_t at = 0; at < count; at += kQuads) {
      const auto of = [&](const float* from) {
        return load_quads([&](int k) { return from + stride * fours[at + static_cast<std::size_t>(k)]; });
      };
      const Point u = transform(X, {of(spheres.x), of(spheres.y), of(spheres.z)});
      const LaneMask near = Lanes::mask_of(reaches(map, u, of(spheres.radius))) & lanes_left(count - at);
      if (near == 0) continue;
      append(out + found, numbers(fours + at), near);
      found += static_cast<std::size_t>(__builtin_popcount(near));
    }
    return found;
  }

  /// Points that may lie inside: places in units of blocks, the blocks' words, numbers.
  struct Candidates {
    static constexpr std::size_t kRoom = 4 * kFieldBatch + kLanes;
    alignas(64) std::uint32_t x[kRoom], y[kRoom], z[kRoom], word[kRoom], number[kRoom];
    std::size_t count;
  };
  static void collect(const FieldView& map, const BlockTransform& X, const PointRuns& points, std::uint32_t* quads,
                      std::size_t count, Candidates& out) noexcept {
    out.count = 0;
    fill_up(quads, count);
    for (std::size_t at = 0; at < count; at += kQuads) {
      const auto of = [&](const float* from) {
        return load_quads([&](int k) {
          const std::uint32_t quad = quads[at + static_cast<std::size_t>(k)];
          return from + points.stride * (quad / 4) + std::size_t{4} * (quad % 4);
        });
      };
      const Point u = transform(X, {of(points.x), of(points.y), of(points.z)});
      const Place place = place_of(map, u);
      const I word = Lanes::template gather<8>(map.entries + 4, place.block);
      const I may = is_in_box(place) & (word != 0) & (bound_at(map, place) < map.slack);
      const LaneMask lanes = Lanes::mask_of(may) & lanes_left(count - at);
      if (lanes == 0) continue;
      append(out.x + out.count, u.x, lanes);
      append(out.y + out.count, u.y, lanes);
      append(out.z + out.count, u.z, lanes);
      append(out.word + out.count, word, lanes);
      append(out.number + out.count, numbers(quads + at), lanes);
      out.count += static_cast<std::size_t>(__builtin_popcount(lanes));
    }
  }
  template <class Value, class Vector>
  static void put(Value* to, Vector value, LaneMask lanes) {
    const Vector packed = Lanes::pack(value, lanes);
    __builtin_memcpy(to, &packed, sizeof packed);
  }

  static std::size_t field_hits(const FieldView& map, const BlockTransform& X, const std::array<float, 9>& R_AQ,
                                const PointRuns& points, std::uint32_t* quads, std::size_t count,
                                const HitRuns& out) noexcept {
    Candidates some;
    collect(map, X, points, quads, count, some);
    std::size_t found = 0;
    for (std::size_t at = 0; at < some.count; at += kWidth) {
      const std::size_t left = some.count - at;
      const I used = lane_numbers() < static_cast<int>(left);
      const I word = read<I>(some.word + at) & used;
      Point f = in_span(word, {read<F>(some.x + at), read<F>(some.y + at), read<F>(some.z + at)});
      const I leaf = leaf_of(map, word, f);
      const Slope s = told(map, leaf, f);
      const LaneMask inside = Lanes::mask_of(used & (leaf != 0) & (s.value < 0.0F));
      if (inside == 0) continue;
      const Point n = rotate(R_AQ, unit(s.g));
      put(out.point + found, read<I>(some.number + at), inside);
      put(out.depth_m + found, depth_of(map, s), inside);
      put(out.n_x + found, n.x, inside);
      put(out.n_y + found, n.y, inside);
      put(out.n_z + found, n.z, inside);
      const std::size_t next = found + static_cast<std::size_t>(__builtin_popcount(inside));
      found = next < out.room ? next : out.room;
    }
    return found;
  }

  static bool have_stayed(const GroupsView& now, const GroupPlaces& then, std::size_t count, float margin_m) noexcept {
    LaneMask stayed = 0;
    for (int at = 0; at < static_cast<int>(count); at += kWidth) {
      F turn = all(0);
      for (std::size_t i = 0; i < now.R.size(); ++i) {
        const F change = load(now.R[i], at) - load(then.R[i].data(), at);
        turn = mad(change, change, turn);
      }
      const Point middle = load_points({now.spheres.x, now.spheres.y, now.spheres.z}, at);
      const Point before = load_points({then.x.data(), then.y.data(), then.z.data()}, at);
      const Point way{middle.x - before.x, middle.y - before.y, middle.z - before.z};
      // A rotation moves what lies r from the middle by at most r times the difference of the matrices' norm over the root of 2.
      const F most = mad(Lanes::root(turn * 0.5F), load(now.spheres.radius, at), Lanes::root(dot(way, way)));
      stayed |= Lanes::mask_of(most <= margin_m) << at;
    }
    return (~stayed & first(count)) == 0;
  }

  // The same for parts among others, through ClusterQuery.
  static Point in_blocks(const FieldView& map, const Point& p_Q) {
    const auto along = [&](F p, std::size_t i) { return (p - map.origin[i]) * map.inverse_block; };
    return {along(p_Q.x, 0), along(p_Q.y, 1), along(p_Q.z, 2)};
  }
  struct Told {
    I known;
    Slope s;
  };
  [[gnu::always_inline]] static Told ask(const FieldView& map, const Point& p_Q) {
    const Point u = in_blocks(map, p_Q);
    const Place place = place_of(map, u);
    const I may = is_in_box(place) & (bound_at(map, place) < map.slack);
    const I word = Lanes::template gather<8>(map.entries + 4, place.block) & may;
    Point f = in_span(word, u);
    const I leaf = leaf_of(map, word, f);
    return {leaf != 0, told(map, leaf, f)};
  }
  static LaneMask field_inside(const FieldView& map, const BlockTransform& X, const PointsView& points,
                               InsideBlock& out) noexcept {
    LaneMask inside = 0;
    for (int at = 0; at < static_cast<int>(kLanes); at += kWidth) {
      const Point p = transform(X, load_points(points, at));
      store_points(p, out.p_Q, at);
      store(all(0), out.m, at);  // exact wherever it reaches, so it is preferred to every radial map
      const Told here = ask(map, p);
      inside |= Lanes::mask_of(here.known & (here.s.value < 0.0F)) << at;
    }
    return inside;
  }
  static void field_depth(const FieldView& map, const PointBlock& p_Q, LaneMask wanted, DepthBlock& out) noexcept {
    for (int at = 0; at < static_cast<int>(kLanes); at += kWidth) {
      if (((wanted >> at) & kAll) == 0) continue;
      const Told here = ask(map, load_points(p_Q.view(), at));
      store_points(unit(here.s.g), out.n_Q, at);
      store(greater(depth_of(map, here.s), all(0)), out.depth_m, at);
    }
  }
};

}  // namespace
}  // namespace mechane::collision
