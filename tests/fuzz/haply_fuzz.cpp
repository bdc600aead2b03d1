// Any bytes as what Haply's local service says: a state with finite numbers within the arm's reach, or nothing that
// changes what was known.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "client-sdk/drivers/haply/protocol.hpp"

namespace {

using mechane::drivers::HaplyFrame;

void check_frame(const HaplyFrame& frame) {
  double squared = 0;
  for (const double part : frame.grip_wxyz)
    squared += part * part;
  if (!(std::abs(squared - 1) < 1e-9) || frame.grip_buttons > 15) std::abort();
  for (const double part : frame.cursor_position_m)
    if (!(std::abs(part) <= 1)) std::abort();
  for (const double part : frame.cursor_force_n)
    if (!std::isfinite(part)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const std::string_view device : {"", "049D"}) {
    HaplyFrame frame;
    const auto parse = mechane::drivers::parse_haply(text, device, frame);
    check_frame(frame);
    if (parse.kind == mechane::drivers::HaplyMessage::state) {
      if (!mechane::drivers::is_haply_id(frame.device_id) || (!device.empty() && frame.device_id != device))
        std::abort();
    } else if (!frame.device_id.empty() || frame.has_grip) {
      std::abort();
    }
  }
  if (mechane::drivers::haply_devices(text).empty()) std::abort();
  if (const auto version = mechane::drivers::parse_haply_version(text);
      version && (version->first < 0 || version->second < 0))
    std::abort();
  return 0;
}
