// What a browser in a headset sends: whatever its bytes, hands of finite numbers come of them, or a refusal with a remedy. What hands are
// made of it can be sent to a server.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "client-sdk/gateway/browsers/tracked_message.hpp"
#include "client-sdk/gateway/browsers/tracked_motion.hpp"

namespace {

using namespace mechane;
using namespace mechane::gateway;

void must_hold(bool held) {
  if (!held) std::abort();
}

void look_at(const TrackedHand& hand) {
  TrackedMotion motion;
  const TimePoint now{std::chrono::seconds(1)};
  motion.take(hand, now);
  const auto sample = motion.at(now);
  must_hold(hand.tracked || !sample);
  if (!sample) return;
  must_hold(sample->X_WH.p.allFinite() && std::abs(sample->X_WH.R.norm() - 1) < 1e-6);
  must_hold(sample->hand_scale >= hand::kMinHandScale && sample->hand_scale <= hand::kMaxHandScale);
  must_hold(sample->grasp_intent >= 0 && sample->grasp_intent <= 1);
  for (const double angle : sample->joints)
    must_hold(std::isfinite(angle));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto hands = parse_tracked_message({reinterpret_cast<const std::byte*>(data), size});
  if (!hands) {
    must_hold(!hands.error().remedy.empty());
    return 0;
  }
  must_hold(hands->size() <= kMostTrackedHands);
  for (const TrackedHand& hand : *hands)
    look_at(hand);
  return 0;
}
