// Lane: one user's way between the network and a loop, for as long as one binding of a hand to a world lasts.
#pragma once

#include <cstdint>
#include <memory>

#include "server/hand/freshness.hpp"
#include "server/realtime/mailbox.hpp"
#include "server/state/input.hpp"
#include "server/state/world_state.hpp"

namespace mechane::transport {

class KioskLink;

/// A checked sample, and when it came, on our clock.
struct ArrivedSample {
  hand::SentSample sample;
  TimePoint arrived;
};

/// What a tick has for one device.
struct OutgoingForce {
  hand::HapticOutput output;
  std::uint64_t tick = 0;
  Duration waited{0};  ///< age of the answered input when the tick took it
};

/// Each mailbox has one producer and one consumer for the lane's whole life: a hand that moves to another world, and so to another
/// loop thread, gets a new lane.
struct Lane {
  std::shared_ptr<KioskLink> link;  ///< where forces are written
  std::uint32_t user = 0;
  std::uint64_t session = 0;
  hand::SampleAge order;                    ///< the listener's
  Duration input_age{0};                    ///< the haptic publisher's: as it was with the last force
  realtime::Mailbox<ArrivedSample> inputs;  ///< DDS listener to loop
  realtime::Mailbox<OutgoingForce> forces;  ///< loop to haptic publisher
};

}  // namespace mechane::transport
