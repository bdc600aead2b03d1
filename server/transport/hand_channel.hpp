// HandChannel: carries one hand's samples and forces between the network and a loop, while the hand is bound to one world.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "server/hand/deadband.hpp"
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

/// What a tick gives to one device.
struct OutgoingForce {
  hand::HapticOutput output;
  Vec3 p_WH = Vec3::Zero();  ///< of the sample that it answers
  std::uint64_t tick = 0;
  Duration waited{0};  ///< age of the input that it answers, when the tick took that
};

/// Each mailbox has one producer and one consumer for the channel's whole life: a hand that moves to another world, and so to another
/// loop thread, gets a new channel.
struct HandChannel {
  std::shared_ptr<KioskLink> link;  ///< where forces are written
  std::uint32_t user = 0;
  std::uint64_t session = 0;
  hand::SampleAge order;                    ///< for the listener only
  std::atomic<double> deadband_share{0};    ///< as the newest sample asks for; 0: each force is written
  hand::OutputDeadband deadband;            ///< for the haptic publisher only
  Duration input_age{0};                    ///< at the last force; for the haptic publisher only
  realtime::Mailbox<ArrivedSample> inputs;  ///< DDS listener to loop
  realtime::Mailbox<OutgoingForce> forces;  ///< loop to haptic publisher
};

}  // namespace mechane::transport
