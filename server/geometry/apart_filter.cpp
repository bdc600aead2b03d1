#include "server/geometry/apart_filter.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "server/base/assert.hpp"

namespace mechane::geometry {
namespace {

constexpr std::size_t kFirstSlots = 256;
// A cell is a little wider than the least distance, so that rounding never puts two near points further apart than neighbouring cells.
constexpr double kWider = 1 + 1e-9;

// Two cells may share a key. That only costs a few more comparisons.
std::uint64_t key_of(std::int64_t x, std::int64_t y, std::int64_t z) {
  return static_cast<std::uint64_t>(x) * 73856093U ^ static_cast<std::uint64_t>(y) * 19349663U ^
         static_cast<std::uint64_t>(z) * 83492791U;
}

}  // namespace

ApartFilter::ApartFilter(double least_m)
    : least2_m2_(least_m * least_m), cells_per_m_(1 / (least_m * kWider)), slots_(kFirstSlots) {
  MECHANE_ASSERT(least_m > 0);
}

ApartFilter::Cell ApartFilter::cell(const Vec3& p) const {
  const auto along = [&](double v) { return static_cast<std::int64_t>(std::floor(v * cells_per_m_)); };
  return {along(p.x()), along(p.y()), along(p.z())};
}

std::size_t ApartFilter::slot_of(std::uint64_t key) const {
  constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15U;  // spreads keys over the upper bits (Fibonacci hashing)
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = (key * kGolden >> 32U) & mask;
  while (slots_[at].last != 0 && slots_[at].key != key)
    at = (at + 1) & mask;
  return at;
}

bool ApartFilter::is_apart(const Vec3& p) const {
  // Its own cell first, the corners last: nearly all points have one nearby, and are refused at once.
  static constexpr std::array<int, 27> kNearestFirst{13, 4,  10, 12, 14, 16, 22, 1, 3, 5,  7,  9,  11, 15,
                                                     17, 19, 21, 23, 25, 0,  2,  6, 8, 18, 20, 24, 26};
  const Cell c = cell(p);
  for (const int n : kNearestFirst) {
    std::uint32_t at = slots_[slot_of(key_of(c.x + n % 3 - 1, c.y + n / 3 % 3 - 1, c.z + n / 9 - 1))].last;
    for (; at != 0; at = points_[at - 1].before) {
      if ((points_[at - 1].p - p).squaredNorm() < least2_m2_) return false;
    }
  }
  return true;
}

void ApartFilter::put(const Vec3& p) {
  if (2 * (used_ + 1) > slots_.size()) grow();
  const Cell c = cell(p);
  const std::uint64_t key = key_of(c.x, c.y, c.z);
  Slot& slot = slots_[slot_of(key)];
  if (slot.last == 0) ++used_;
  points_.push_back({p, slot.last});
  slot = {key, static_cast<std::uint32_t>(points_.size())};
}

void ApartFilter::grow() {
  const std::vector<Slot> before = std::exchange(slots_, std::vector<Slot>(2 * slots_.size()));
  for (const Slot& slot : before) {
    if (slot.last != 0) slots_[slot_of(slot.key)] = slot;
  }
}

}  // namespace mechane::geometry
