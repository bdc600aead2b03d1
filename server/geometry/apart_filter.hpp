// Which points lie apart from all that were taken before: a hash of cells as wide as the least distance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/base/math.hpp"

namespace mechane::geometry {

class ApartFilter {
 public:
  /// `least_m` > 0, metres.
  explicit ApartFilter(double least_m);

  /// Whether a point lies at least the least distance from all points put in so far.
  [[nodiscard]] bool is_apart(const Vec3& p) const;
  void put(const Vec3& p);

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t last = 0;  ///< the last point put into the cell, from 1 on; 0: the slot is free
  };
  struct Point {
    Vec3 p;
    std::uint32_t before;  ///< the point put into the same cell before it, from 1 on; 0: it is the first
  };
  struct Cell {
    std::int64_t x, y, z;
  };
  [[nodiscard]] Cell cell(const Vec3& p) const;
  /// The cell's slot, or the free one where it belongs.
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const;
  void grow();

  double least2_m2_;
  double cells_per_m_;
  std::vector<Slot> slots_;  ///< a power of two, at most half of them used
  std::size_t used_ = 0;
  std::vector<Point> points_;
};

}  // namespace mechane::geometry
