// Forces and their contacts over the loopback, field by field.
#include <limits>

#include <rapidcheck.h>

#include "server/hand/deadband.hpp"
#include "tests/integration/transport/loopback.hpp"
#include "tests/support/property_draw.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::test {
namespace {

using client::LinkState;
using client::Role;
using namespace std::chrono_literals;

/// What a float can hold, so that it comes back the same.
double float_between(double low, double high) {
  return static_cast<double>(static_cast<float>(*between(low, high)));
}

Vec3 vector_within(double most) {
  return {float_between(-most, most), float_between(-most, most), float_between(-most, most)};
}

hand::LocalContact any_contact() {
  return {.p_W = vector_within(100),
          .n_W = any_unit(),
          .v_W = vector_within(50),
          .depth_m = float_between(-0.1, 0.1),
          .curvature_per_m = float_between(-500, 500),
          .stiffness_n_per_m = float_between(0, 5000),
          .damping_ns_per_m = float_between(0, 50),
          .static_friction = float_between(0, 2),
          .dynamic_friction = float_between(0, 2),
          .viscosity_ns_per_m = float_between(0, hand::kMaxViscosity_ns_per_m),
          .grooves = {float_between(0, 1e-4), vector_within(500), float_between(-1000, 1000)},
          .validity = std::chrono::microseconds(*rc::gen::inRange(0, 1'000'001))};
}

bool same(const hand::LocalContact& a, const hand::LocalContact& b) {
  return a.p_W == b.p_W && (a.n_W - b.n_W).norm() < 1e-6 && a.v_W == b.v_W && a.depth_m == b.depth_m &&
         a.curvature_per_m == b.curvature_per_m && a.stiffness_n_per_m == b.stiffness_n_per_m &&
         a.damping_ns_per_m == b.damping_ns_per_m && a.static_friction == b.static_friction &&
         a.dynamic_friction == b.dynamic_friction && a.viscosity_ns_per_m == b.viscosity_ns_per_m &&
         a.grooves.depth_m == b.grooves.depth_m && a.grooves.wave_W == b.grooves.wave_W &&
         a.grooves.phase_rad == b.grooves.phase_rad && a.validity == b.validity;
}

hand::HeldPath any_path() {
  using Kind = hand::HeldPath::Kind;
  const auto kind = *rc::gen::element(Kind::none, Kind::line, Kind::circle, Kind::free);
  return {.kind = kind,
          .p_HG = vector_within(1),
          .p_W = vector_within(100),
          .axis_W = any_unit(),
          .radius_m = float_between(0.01, 5),
          .along_n = float_between(kind == Kind::free ? 0 : -20, 20),
          .stiffness_n_per_m = float_between(0, 5000),
          .damping_ns_per_m = float_between(0, 50),
          .limit_n = float_between(0, 500),
          .validity = std::chrono::microseconds(*rc::gen::inRange(0, 1'000'001))};
}

bool same(const hand::HeldPath& a, const hand::HeldPath& b) {
  return a.kind == b.kind && a.p_HG == b.p_HG && a.p_W == b.p_W && (a.axis_W - b.axis_W).norm() < 1e-6 &&
         a.radius_m == b.radius_m && a.along_n == b.along_n && a.stiffness_n_per_m == b.stiffness_n_per_m &&
         a.damping_ns_per_m == b.damping_ns_per_m && a.limit_n == b.limit_n && a.validity == b.validity;
}

hand::HapticOutput any_answer() {
  hand::HapticOutput answer;
  answer.force_W.t = vector_within(5);
  for (double& force : answer.finger_force_n)
    force = float_between(0, 20);
  answer.reasons = *rc::gen::inRange(0u, 1u << hand::kReasonCount);
  answer.holding = *rc::gen::arbitrary<bool>();
  answer.held = any_path();
  answer.clicks = {*rc::gen::arbitrary<std::uint32_t>(), float_between(0, hand::kMaxClick_n)};
  answer.contact_count = *rc::gen::inRange<std::uint32_t>(0, hand::kMaxLocalContacts + 1);
  std::generate(answer.contacts.begin(), answer.contacts.end(), any_contact);
  return answer;
}

/// The force that answers a sample sent now.
std::optional<client::ForceSample> answer_to(client::Client& client, const Vec3& p) {
  const std::uint64_t before = client.sent_sequence();
  std::optional<client::ForceSample> force;
  (void)eventually([&] {
    client.send(hand_at(p));
    force = client.wait_force(50ms);
    return force && force->echo_sequence > before;
  });
  return force;
}

TEST_F(Loopback, EachFieldOfAForceAndOfItsContactsComesAsTheServerSetIt) {
  EchoServer server;
  auto client = connect(Role::hand);
  ASSERT_TRUE(client->wait_for(LinkState::joined, 10s));
  EXPECT_TRUE(rc::check([&] {
    const hand::HapticOutput sent = any_answer();
    const Vec3 p = vector_within(50);
    server.change([&](state::WorldState& world) { world.users[0].output = sent; });
    const auto came = answer_to(*client, p);
    RC_ASSERT(came.has_value());
    RC_ASSERT(came->force_W.f == p);
    RC_ASSERT(came->force_W.t == sent.force_W.t);
    RC_ASSERT(came->finger_force_n == sent.finger_force_n);
    RC_ASSERT(came->reasons == sent.reasons);
    RC_ASSERT(came->holding == sent.holding);
    RC_ASSERT(came->clicks.count == sent.clicks.count && came->clicks.strength_n == sent.clicks.strength_n);
    const bool on_path = sent.holding && sent.held.kind != hand::HeldPath::Kind::none;
    RC_ASSERT(same(came->held, on_path ? sent.held : hand::HeldPath{}));
    RC_ASSERT(came->contact_count == sent.contact_count);
    for (std::size_t i = 0; i < hand::kMaxLocalContacts; ++i)
      RC_ASSERT(same(came->contacts[i], i < sent.contact_count ? sent.contacts[i] : hand::LocalContact{}));
  }));
}

TEST_F(Loopback, AnAnswerWithAContactThatCannotBeIsSilence) {
  EchoServer server;
  auto client = connect(Role::hand);
  ASSERT_TRUE(client->wait_for(LinkState::joined, 10s));
  ASSERT_TRUE(feels(*client, Vec3(1, 0, 0)));
  server.change([](state::WorldState& world) {
    world.users[0].output.contact_count = 1;
    world.users[0].output.contacts[0].depth_m = std::numeric_limits<double>::quiet_NaN();
  });
  const std::uint64_t before = client->sent_sequence();
  const std::size_t arrived = server.samples().size();
  bool heard = false;
  ASSERT_TRUE(eventually([&] {
    client->send(hand_at(Vec3(2, 0, 0)));
    const auto force = client->wait_force(1ms);
    heard = heard || (force && force->echo_sequence > before);
    return server.samples().size() > arrived + 20;
  }));
  EXPECT_FALSE(heard);
  server.change([](state::WorldState& world) { world.users[0].output.contact_count = 0; });
  EXPECT_TRUE(feels(*client, Vec3(3, 0, 0)));
}

TEST_F(Loopback, AHandWithADeadbandIsAnsweredSeldomWhileItRestsAndAtOnceWhenItsForceChanges) {
  EchoServer server;
  auto client = connect(Role::hand, "tester", 0, "kiosk-1", 0.1);
  ASSERT_TRUE(client->wait_for(LinkState::joined, 10s));
  const Vec3 rest(1, 0, 0);
  const auto first = answer_to(*client, rest);
  ASSERT_TRUE(first.has_value());
  realtime::Wakeup never;
  std::optional<client::ForceSample> last = first;
  for (int i = 0; i < 300; ++i) {
    never.wait(1ms);
    client->send(hand_at(rest));
    if (const auto force = client->newest_force()) last = force;
  }
  const auto answers = static_cast<std::int64_t>(last->sequence - first->sequence);
  EXPECT_GT(answers, 0);
  EXPECT_LE(answers, 1 + (last->received - first->received) / (hand::kKeepAlive - kTickPeriod));
  const auto moved = answer_to(*client, Vec3(2, 0, 0));
  ASSERT_TRUE(moved.has_value());
  EXPECT_EQ(moved->force_W.f, Vec3(2, 0, 0));
}

}  // namespace
}  // namespace mechane::test
