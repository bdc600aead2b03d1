// Whatever comes over the serial line of a glove, its driver gives a hand whose numbers are in their ranges, or none.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "client-sdk/drivers/lucidgloves/alpha.hpp"

namespace {

using namespace mechane::drivers;

void must(bool held) {
  if (!held) std::abort();
}

void check(const AlphaHand& hand) {
  double joints[MECHANE_HAND_JOINTS] = {};
  place_joints(hand, joints);
  for (const double angle : joints)
    must(std::isfinite(angle) && std::abs(angle) < 1.8);
  must(grasp_of(hand) >= 0 && grasp_of(hand) <= 1);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (const int full_scale : {4095, 1023}) {
    AlphaStream whole(full_scale);
    AlphaStream in_pieces(full_scale);
    whole.add(bytes);
    for (std::size_t at = 0; at < size; at += 7)
      in_pieces.add(bytes.substr(at, 7));
    must(whole.hands() == in_pieces.hands() && whole.trouble() == in_pieces.trouble());
    must(whole.hand().curl == in_pieces.hand().curl);
    check(whole.hand());
  }
  return 0;
}
