// Whatever comes over the serial line of a CyberGlove, or stands in its calibration, the driver gives angles that a
// hand can have, or none. Input: the serial bytes, then, behind the first "\n#\n", the calibration.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "client-sdk/drivers/cyberglove/calibration.hpp"
#include "client-sdk/drivers/cyberglove/record.hpp"

namespace {

using namespace mechane::drivers;

void must(bool held) {
  if (!held) std::abort();
}

void check(const GloveCalibration& calibration, const GloveRecord& record) {
  double joints[MECHANE_HAND_JOINTS] = {};
  calibration.place_joints(record, joints);
  for (const double angle : joints)
    must(std::isfinite(angle) && std::abs(angle) < 3.2);
  must(grasp_of(joints) >= 0 && grasp_of(joints) <= 1);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  constexpr std::string_view kBetween = "\n#\n";
  const std::size_t between = std::min(input.find(kBetween), size);
  const std::string_view bytes = input.substr(0, between);
  for (const std::size_t sensors : {std::size_t{22}, std::size_t{18}}) {
    GloveRecords whole(sensors);
    GloveRecords in_pieces(sensors);
    whole.add(bytes);
    for (std::size_t at = 0; at < bytes.size(); at += 7)
      in_pieces.add(bytes.substr(at, 7));
    must(whole.count() == in_pieces.count() && whole.noise() == in_pieces.noise());
    for (std::size_t k = 0; k < sensors; ++k)
      must(whole.count() == 0 || whole.newest().sensors[k] != 0);
    GloveCalibration calibration(sensors);
    check(calibration, whole.newest());
    if (between < size) (void)calibration.take_text(input.substr(between + kBetween.size()));
    check(calibration, whole.newest());
  }
  return 0;
}
