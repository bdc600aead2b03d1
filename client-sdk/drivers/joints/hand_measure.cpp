#include "client-sdk/drivers/joints/hand_measure.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::drivers {
namespace {

constexpr double kNearlyStraight = 0.85;  // from its first joint to its tip, as a share of its length

double length_between(const HandPoint& a, const HandPoint& b) noexcept {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace

void FirstMedian::add(double value) noexcept {
  if (count_ == kMost) return;
  values_[count_++] = value;
  const auto middle = values_.begin() + static_cast<std::ptrdiff_t>(count_ / 2);
  std::nth_element(values_.begin(), middle, values_.begin() + static_cast<std::ptrdiff_t>(count_));
  middle_ = *middle;
}

void HandMeasure::add(const HandPoints& points) noexcept {
  const HandPoint &index = points[point_of(1, 0)], &little = points[point_of(4, 0)];
  const HandPoint between{(index[0] + little[0]) / 2, (index[1] + little[1]) / 2, (index[2] + little[2]) / 2};
  palm_m_.add(length_between(points[0], between));
  for (std::size_t f = 0; f < MECHANE_FINGERS; ++f) {
    double length_m = 0;
    for (std::size_t joint = 0; joint + 1 < kJointsOfFinger; ++joint)
      length_m += length_between(points[point_of(f, joint)], points[point_of(f, joint + 1)]);
    const double straight_m = length_between(points[point_of(f, 0)], points[point_of(f, kJointsOfFinger - 1)]);
    if (straight_m > kNearlyStraight * length_m) finger_m_[f].add(length_m);
  }
}

void HandMeasure::tell(mechane_device_state& state) const noexcept {
  state.palm_m = palm_m_.middle();
  for (std::size_t f = 0; f < MECHANE_FINGERS; ++f)
    state.finger_m[f] = finger_m_[f].middle();
}

}  // namespace mechane::drivers
