// Any bytes as a hand that a tracking program sent: a hand that joints can make, or nothing that changes what was known.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "client-sdk/drivers/joints/hand_datagram.hpp"
#include "client-sdk/drivers/joints/hand_geometry.hpp"
#include "client-sdk/drivers/joints/hand_measure.hpp"

namespace {

void must(bool held) {
  if (!held) std::abort();
}

void check_state(const mechane_device_state& state) {
  double squared = 0;
  for (const double part : state.orientation_wxyz)
    squared += part * part;
  must(std::abs(squared - 1) < 1e-9);
  for (const double part : state.position_m)
    must(std::abs(part) <= 10);
  for (const double angle : state.joints_rad)
    must(std::abs(angle) < 2.3);
  must(state.grasp >= 0 && state.grasp <= 1);
}

/// Lengths as driver.h has them.
void check_measure(const mechane::drivers::HandDatagram& hand) {
  mechane::drivers::HandMeasure measure;
  measure.add(hand.points);
  mechane_device_state state{};
  measure.tell(state);
  must(state.palm_m >= 0.02 && state.palm_m <= 0.25);
  for (const double length_m : state.finger_m)
    must(length_m == 0 || (length_m >= 0.005 && length_m <= 0.5));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  mechane::drivers::HandDatagram hand;
  const bool is_hand = *mechane::drivers::parse_hand_datagram(text, hand) == '\0';
  must(is_hand || (!hand.tracked && !hand.sequence && !hand.pinch));
  if (!is_hand || !hand.tracked) return 0;
  mechane_device_state state{};
  const mechane_device_state before = state;
  if (*mechane::drivers::place_tracked_hand(hand, state) != '\0') {
    must(std::memcmp(&before, &state, sizeof(state)) == 0);
    return 0;
  }
  check_state(state);
  check_measure(hand);
  return 0;
}
