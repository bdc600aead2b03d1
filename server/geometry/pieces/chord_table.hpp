// How far the straight lines between points of a piece leave the solid: the measure of its concavity.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "server/base/math.hpp"
#include "server/geometry/distance_grid.hpp"

namespace mechane::geometry {

struct ChordDepth {
  double depth_m = 0;     ///< the greatest distance from the solid along the chord; 0 when it stays inside
  Vec3 p = Vec3::Zero();  ///< where; the chord's start when it stays inside
};

/// Walks from a to b, both on the surface or inside the solid, in steps as long as the distance there allows.
[[nodiscard]] ChordDepth chord_depth(const DistanceGrid& grid, const Vec3& a, const Vec3& b);

/// The depth of the chord between each two of some points. A piece is the solid within a convex cell, so a chord between two of its
/// points leaves the piece only where it leaves the solid. A cut changes no chord; it only puts their ends into different pieces.
class ChordTable {
 public:
  ChordTable() = default;
  /// Depths are kept in steps of `unit_m`, up to 65535 of them. Uses all cores.
  ChordTable(const DistanceGrid& grid, std::span<const Vec3> points, double unit_m);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] double unit_m() const { return unit_m_; }
  /// All depths from point i, in units.
  [[nodiscard]] std::span<const std::uint16_t> row(std::size_t i) const { return {units_.data() + i * size_, size_}; }
  [[nodiscard]] std::uint16_t deepest() const;
  /// Pairs of points with deep chords, the deepest first: at most one for each point, at most `count`.
  [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> deep_pairs(std::size_t count) const;
  /// Makes the chord between i and j at least `units` deep.
  void raise(std::size_t i, std::size_t j, std::uint16_t units);

 private:
  std::size_t size_ = 0;
  double unit_m_ = 1;
  std::vector<std::uint16_t> units_;
};

}  // namespace mechane::geometry
