#include "server/geometry/pieces/chord_table.hpp"

#include <algorithm>
#include <cmath>

#include "server/base/parallel.hpp"

namespace mechane::geometry {
namespace {

constexpr float kLeastStep = 0.8F;     // cells
constexpr std::size_t kRowBatch = 16;  // a single row is too little work for a thread

}  // namespace

ChordDepth chord_depth(const DistanceGrid& grid, const Vec3& a, const Vec3& b) {
  const Vec3f from = grid.to_cells(a);
  const Vec3f way = grid.to_cells(b) - from;
  const float length = way.norm();
  if (!(length > 0)) return {0, a};
  const Vec3f along = way / length;
  const auto cell_m = static_cast<float>(grid.cell_m());
  float deepest = 0;  // cells, as all here
  float at = 0;
  for (float t = 0; t < length;) {
    const float d = grid.at_cells(from + t * along) / cell_m;
    if (d > deepest) {
      deepest = d;
      at = t;
    }
    // Distance changes by at most one cell per cell, and the end is on the surface again: the rest may be too short for a deeper place.
    if (0.5F * (d + length - t) < deepest) break;
    t += std::max(kLeastStep, deepest - d);
  }
  return {static_cast<double>(deepest * cell_m), a + static_cast<double>(at / length) * (b - a)};
}

ChordTable::ChordTable(const DistanceGrid& grid, std::span<const Vec3> points, double unit_m)
    : size_(points.size()), unit_m_(unit_m), units_(points.size() * points.size(), 0) {
  for_each_index((size_ + kRowBatch - 1) / kRowBatch, [&](std::size_t batch) {
    for (std::size_t i = batch * kRowBatch; i < std::min(size_, (batch + 1) * kRowBatch); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double units = chord_depth(grid, points[i], points[j]).depth_m / unit_m_;
        units_[i * size_ + j] = static_cast<std::uint16_t>(std::min(units, 65535.0));
      }
    }
  });
  for (std::size_t i = 0; i < size_; ++i) {
    for (std::size_t j = 0; j < i; ++j)
      units_[j * size_ + i] = units_[i * size_ + j];
  }
}

std::uint16_t ChordTable::deepest() const {
  return units_.empty() ? std::uint16_t{0} : *std::max_element(units_.begin(), units_.end());
}

std::vector<std::pair<std::size_t, std::size_t>> ChordTable::deep_pairs(std::size_t count) const {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 1; i < size_; ++i) {
    const auto from = row(i).begin();
    const auto most = std::max_element(from, from + static_cast<std::ptrdiff_t>(i));
    if (*most > 0) pairs.emplace_back(i, static_cast<std::size_t>(most - from));
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [&](const auto& a, const auto& b) { return row(a.first)[a.second] > row(b.first)[b.second]; });
  if (pairs.size() > count) pairs.resize(count);
  return pairs;
}

void ChordTable::raise(std::size_t i, std::size_t j, std::uint16_t units) {
  units_[i * size_ + j] = std::max(units_[i * size_ + j], units);
  units_[j * size_ + i] = std::max(units_[j * size_ + i], units);
}

}  // namespace mechane::geometry
