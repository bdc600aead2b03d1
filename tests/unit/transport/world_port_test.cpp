// What passes between a loop and the hands of its world where time does not run as usual. No network.
#include "server/transport/world_port.hpp"

#include <gtest/gtest.h>

#include "server/transport/hand_channel.hpp"
#include "server/transport/haptic_publisher.hpp"

namespace mechane::transport {
namespace {

using std::chrono::milliseconds;

std::shared_ptr<const state::WorldDescription> one_body() {
  auto world = std::make_shared<state::WorldDescription>();
  world->bodies.emplace_back().name = "CRANK";
  return world;
}

class WorldPortTest : public testing::Test {
 protected:
  WorldPortTest() { EXPECT_TRUE(port_.bind_user(0, "kiosk-1", 0, 7)); }

  void send(std::uint64_t sequence, TimePoint arrived) {
    ArrivedSample sample;
    sample.sample.session = 7;
    sample.sample.sequence = sequence;
    sample.arrived = arrived;
    channel_->inputs.publish(sample);
  }
  /// The world of a tick in which the hand holds the body and feels it.
  void tick() {
    ++state_.tick;
    state_.users[0].present = true;
    hand::HapticOutput& output = state_.users[0].output;
    output.force_W.f = Vec3(1, 0, 0);
    output.contact_count = 1;
    output.holding = true;
    output.held.kind = hand::HeldPath::Kind::line;
    output.clicks = {5, 0.5};
    port_.publish_forces(state_);
    port_.publish(state_);
  }
  hand::HapticOutput felt() {
    const OutgoingForce* force = channel_->forces.take();
    EXPECT_NE(force, nullptr);
    return force == nullptr ? hand::HapticOutput{} : force->output;
  }

  std::shared_ptr<const state::WorldDescription> world_ = one_body();
  state::WorldState state_{*world_};
  std::shared_ptr<HandChannel> channel_ = std::make_shared<HandChannel>();
  HapticPublisher haptic_{0, std::nullopt};
  WorldPort port_{"world-1", world_, haptic_,
                  [this](const std::string&, std::uint32_t, std::uint64_t session) {
                    channel_->session = session;
                    return channel_;
                  },
                  [](const std::shared_ptr<HandChannel>&) {}};
  state::TickInputs inputs_;
  const TimePoint begin_ = TimePoint(std::chrono::seconds(1000));
};

TEST_F(WorldPortTest, ASampleThatComesBetweenTicksIsFreshForTheNextOne) {
  port_.gather(inputs_, begin_);
  EXPECT_TRUE(inputs_.users[0].present);
  EXPECT_FALSE(inputs_.users[0].fresh);
  send(1, begin_ + milliseconds(1));
  port_.hold(state_, begin_ + milliseconds(2));
  port_.hold(state_, begin_ + milliseconds(3));
  port_.gather(inputs_, begin_ + milliseconds(4));
  EXPECT_TRUE(inputs_.users[0].fresh);
  EXPECT_EQ(inputs_.users[0].sample.sequence, 1U);
  EXPECT_EQ(inputs_.users[0].age, milliseconds(3));
  port_.gather(inputs_, begin_ + milliseconds(5));
  EXPECT_FALSE(inputs_.users[0].fresh);
}

TEST_F(WorldPortTest, CommandsWaitForATick) {
  ASSERT_TRUE(port_.offer_command({.id = 9, .kind = state::CommandKind::next_step}));
  port_.hold(state_, begin_);
  port_.gather(inputs_, begin_ + milliseconds(1));
  ASSERT_EQ(inputs_.command_count, 1U);
  EXPECT_EQ(inputs_.commands[0].id, 9U);
}

TEST_F(WorldPortTest, HandsThatAreNotLetThroughAreGoneAndComeBack) {
  port_.let_through({.hands = false, .forces = true});
  send(1, begin_);
  port_.gather(inputs_, begin_);
  EXPECT_FALSE(inputs_.users[0].present);
  EXPECT_FALSE(inputs_.users[0].fresh);
  port_.let_through({});
  send(2, begin_ + milliseconds(1));
  port_.gather(inputs_, begin_ + milliseconds(1));
  EXPECT_TRUE(inputs_.users[0].present);
  EXPECT_TRUE(inputs_.users[0].fresh);
}

TEST_F(WorldPortTest, RestIsWhenHandsAreGoneAndNoForceIsLeft) {
  port_.gather(inputs_, begin_);
  port_.publish_forces(state_);
  EXPECT_FALSE(port_.forces_are_zero()) << "the hand is there";
  port_.let_through({.hands = false, .forces = true});
  port_.gather(inputs_, begin_ + milliseconds(1));
  state_.users[0].output.force_W.f = Vec3(0.1, 0, 0);
  port_.publish_forces(state_);
  EXPECT_FALSE(port_.forces_are_zero());
  state_.users[0].output = {};
  port_.publish_forces(state_);
  EXPECT_TRUE(port_.forces_are_zero());
  port_.let_through({});
  port_.gather(inputs_, begin_ + milliseconds(2));
  port_.publish_forces(state_);
  EXPECT_FALSE(port_.forces_are_zero());
}

TEST_F(WorldPortTest, WithoutForcesADeviceFeelsNothingAndAPointerHoldsOn) {
  port_.gather(inputs_, begin_);
  tick();
  EXPECT_EQ(felt().force_W.f, Vec3(1, 0, 0));
  port_.let_through({.hands = true, .forces = false});
  send(4, begin_);
  port_.gather(inputs_, begin_ + milliseconds(1));
  tick();
  for (const bool held : {false, true}) {
    if (held) port_.hold(state_, begin_ + milliseconds(2));
    const hand::HapticOutput quiet = felt();
    EXPECT_EQ(quiet.force_W.f, Vec3(0, 0, 0));
    EXPECT_EQ(quiet.contact_count, 0U);
    EXPECT_EQ(quiet.held.kind, hand::HeldPath::Kind::none);
    EXPECT_EQ(quiet.clicks.count, 5U);
    EXPECT_EQ(quiet.clicks.strength_n, 0);
    EXPECT_TRUE(quiet.holding);
    EXPECT_EQ(quiet.echo_sequence, 4U);
  }
}

TEST_F(WorldPortTest, DisplaysSeeAWorldThatStandsStill) {
  port_.gather(inputs_, begin_);
  tick();
  ASSERT_NE(port_.take_snapshot(), nullptr) << "of the first tick";
  int seen = 0;
  for (std::uint64_t i = 1; i <= 10 * WorldPort::kTicksPerFrame; ++i) {
    const TimePoint now = begin_ + milliseconds(i);
    port_.hold(state_, now);
    const SceneSnapshot* shown = port_.take_snapshot();
    if (shown == nullptr) continue;
    ++seen;
    EXPECT_EQ(shown->tick, 1U);
    EXPECT_EQ(shown->sampled_ns, to_ns(now));
  }
  EXPECT_EQ(seen, 10);
  state::Event event;
  EXPECT_FALSE(port_.take_event(event)) << "events are told once";
}

}  // namespace
}  // namespace mechane::transport
