// Any bytes as a recorded hand: moments that a driver may give, or a fault in words.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "client-sdk/drivers/playback/recording.hpp"

namespace {

void check_state(const mechane_device_state& state) {
  double squared = 0;
  for (const double part : state.orientation_wxyz)
    squared += part * part;
  if (!(squared > 0.98 && squared < 1.02) || !(state.grasp >= 0 && state.grasp <= 1)) std::abort();
  for (const double part : state.position_m)
    if (!(std::abs(part) <= 100)) std::abort();
  for (const double joint : state.joints_rad)
    if (!std::isfinite(joint)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  mechane::drivers::HandRecording recording;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (!recording.take_text(text).empty()) return 0;
  for (const double share : {-0.1, 0.0, 0.3, 0.5, 0.99, 1.0, 2.0})
    check_state(recording.at(share * recording.length_s()));
  return 0;
}
