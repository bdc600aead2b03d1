#include "server/geometry/chord_table.hpp"

#include <algorithm>
#include <cmath>

#include "server/base/parallel.hpp"

namespace mechane::geometry {
namespace {

constexpr double kLeastStep = 0.7;   // cells
constexpr std::size_t kRowBatch = 16;  // a thread is not worth a row

}  // namespace

ChordDepth chord_depth(const DistanceGrid& grid, const Vec3& a, const Vec3& b) {
  ChordDepth deepest{0, a};
  const double length = (b - a).norm();
  if (!(length > 0)) return deepest;
  const Vec3 along = (b - a) / length;
  const double least = kLeastStep * grid.cell_m();
  double t = 0;
  while (t < length) {
    const double d = grid.at(a + t * along);
    if (d > deepest.depth_m) deepest = {d, a + t * along};
    // Distance grows by a metre each metre at most: before that far no place can be deeper.
    t += std::max(least, deepest.depth_m - d);
  }
  return deepest;
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
  std::stable_sort(pairs.begin(), pairs.end(), [&](const auto& a, const auto& b) {
    return row(a.first)[a.second] > row(b.first)[b.second];
  });
  if (pairs.size() > count) pairs.resize(count);
  return pairs;
}

void ChordTable::raise(std::size_t i, std::size_t j, std::uint16_t units) {
  units_[i * size_ + j] = std::max(units_[i * size_ + j], units);
  units_[j * size_ + i] = std::max(units_[j * size_ + i], units);
}

}  // namespace mechane::geometry
