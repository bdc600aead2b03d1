// How large the hand is that a tracker sees.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "client-sdk/drivers/joints/hand_datagram.hpp"
#include <mechane/driver.h>

namespace mechane::drivers {

/// The median of the first values; later ones are not taken.
class FirstMedian {
 public:
  void add(double value) noexcept;
  /// 0 before the first value.
  [[nodiscard]] double middle() const noexcept { return middle_; }

 private:
  static constexpr std::size_t kMost = 180;
  std::array<double, kMost> values_{};
  std::size_t count_ = 0;
  double middle_ = 0;
};

/// Measures one person's hand: its lengths are known from the first picture that shows them, and settle within some seconds of pictures. In
/// memory only. One thread; allocates nothing.
class HandMeasure {
 public:
  /// A picture of the whole hand, which place_tracked_hand() has taken. A finger that is bent hides its bones from a camera, so only those
  /// are measured that are nearly straight.
  void add(const HandPoints& points) noexcept;
  /// Fills in what is known: palm_m and finger_m.
  void tell(mechane_device_state& state) const noexcept;

 private:
  FirstMedian palm_m_;
  std::array<FirstMedian, MECHANE_FINGERS> finger_m_;
};

}  // namespace mechane::drivers
