// What a server says that lies, or that another program wrote in its name.
#include "client-sdk/client/parse.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/property_draw.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::client {
namespace {

using test::any_unit;
using test::between;

proto::HapticOutput honest_force(std::uint32_t contacts = kMaxLocalContacts) {
  proto::HapticOutput wire{};
  wire.protocol = proto::kProtocol;
  wire.contact_count = contacts;
  for (proto::WireLocalContact& contact : wire.contacts)
    proto::set_vec3(contact.n_W, any_unit());
  wire.holding = 1;
  wire.held.kind = mechane_held_circle;
  wire.held.radius_m = 0.2f;
  proto::set_vec3(wire.held.axis_W, any_unit());
  return wire;
}

std::vector<float*> numbers_of(proto::WireLocalContact& contact) {
  std::vector<float*> all{
      &contact.depth_m,         &contact.curvature_per_m,  &contact.stiffness_n_per_m,  &contact.damping_ns_per_m,
      &contact.static_friction, &contact.dynamic_friction, &contact.viscosity_ns_per_m, &contact.groove_depth_m,
      &contact.groove_phase_rad};
  for (auto* vector : {&contact.p_W, &contact.n_W, &contact.v_W, &contact.groove_wave_W}) {
    for (float& number : *vector)
      all.push_back(&number);
  }
  return all;
}

std::vector<float*> numbers_of(proto::WireHeldPath& held) {
  std::vector<float*> all{&held.radius_m, &held.along_n, &held.stiffness_n_per_m, &held.damping_ns_per_m,
                          &held.limit_n};
  for (auto* vector : {&held.p_HG, &held.p_W, &held.axis_W}) {
    for (float& number : *vector)
      all.push_back(&number);
  }
  return all;
}

float not_a_number() {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  return *rc::gen::element(std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity);
}

RC_GTEST_PROP(ParseForce, RefusesWhatIsNotFiniteAnywhere, ()) {
  proto::HapticOutput wire = honest_force();
  ForceSample force;
  RC_ASSERT(parse(wire, force));
  std::vector<float*> numbers = numbers_of(wire.held);
  for (proto::WireLocalContact& contact : wire.contacts) {
    const std::vector<float*> more = numbers_of(contact);
    numbers.insert(numbers.end(), more.begin(), more.end());
  }
  for (float& number : wire.f_W)
    numbers.push_back(&number);
  for (float& number : wire.t_W)
    numbers.push_back(&number);
  for (float& number : wire.finger_force_n)
    numbers.push_back(&number);
  numbers.push_back(&wire.click_n);
  **rc::gen::elementOf(numbers) = not_a_number();
  RC_ASSERT(!parse(wire, force));
}

RC_GTEST_PROP(ParseForce, DoesNotReadContactsBeyondTheirCount, ()) {
  const auto count = *rc::gen::inRange<std::uint32_t>(0, kMaxLocalContacts);
  proto::HapticOutput wire = honest_force(count);
  for (std::size_t i = count; i < kMaxLocalContacts; ++i)
    **rc::gen::elementOf(numbers_of(wire.contacts[i])) = not_a_number();
  ForceSample force;
  force.contacts.fill({.depth_m = 7});
  RC_ASSERT(parse(wire, force));
  RC_ASSERT(force.contact_span().size() == count);
  for (std::size_t i = count; i < kMaxLocalContacts; ++i)
    RC_ASSERT(force.contacts[i].depth_m == 0);
}

RC_GTEST_PROP(ParseForce, RefusesMoreContactsThanThereAre, ()) {
  proto::HapticOutput wire = honest_force();
  wire.contact_count = *rc::gen::inRange<std::uint32_t>(kMaxLocalContacts + 1, 0xffffffffu);
  ForceSample force;
  RC_ASSERT(!parse(wire, force));
}

RC_GTEST_PROP(ParseForce, MakesANormalThatIsNearlyUnitAUnitAndRefusesOthers, ()) {
  proto::HapticOutput wire = honest_force();
  const Vec3 unit = any_unit();
  const double length = *rc::gen::oneOf(between(0, 3), between(0.98, 1.02));
  RC_PRE(std::abs(std::abs(length - 1) - 0.01) > 1e-6);  // the limit itself is rounded
  const auto contact = *rc::gen::inRange<std::size_t>(0, kMaxLocalContacts);
  proto::set_vec3(wire.contacts[contact].n_W, length * unit);
  ForceSample force;
  RC_ASSERT(parse(wire, force) == (std::abs(length - 1) < 0.01));
  if (std::abs(length - 1) > 0.01) return;
  RC_ASSERT(std::abs(force.contacts[contact].n_W.norm() - 1) < 1e-12);
  RC_ASSERT((force.contacts[contact].n_W - unit).norm() < 1e-6);
}

TEST(ParseForce, TakesNoPathWhereNothingIsHeldAndNoneThatCannotBe) {
  proto::HapticOutput wire{};
  wire.protocol = proto::kProtocol;
  wire.held.kind = mechane_held_circle;
  wire.held.axis_W[2] = 1;
  wire.held.radius_m = 0.2f;
  wire.held.limit_n = -1;
  wire.held.valid_us = 3'000'000;
  ForceSample force;
  ASSERT_TRUE(parse(wire, force));
  EXPECT_EQ(force.held.kind, HeldPath::Kind::none);
  wire.holding = 1;
  ASSERT_TRUE(parse(wire, force));
  EXPECT_EQ(force.held.kind, HeldPath::Kind::circle);
  EXPECT_EQ(force.held.limit_n, 0);
  EXPECT_EQ(force.held.validity, std::chrono::seconds(1));
  wire.held.radius_m = 0;
  EXPECT_FALSE(parse(wire, force));
  wire.held.kind = mechane_held_line;
  EXPECT_TRUE(parse(wire, force));
  wire.held.axis_W[2] = 2;
  EXPECT_FALSE(parse(wire, force));
  wire.held.kind = mechane_held_circle + 1;
  EXPECT_FALSE(parse(wire, force));
}

RC_GTEST_PROP(ParseForce, LetsNoContactPullOrLastForLong, ()) {
  proto::HapticOutput wire = honest_force(1);
  wire.contacts[0].stiffness_n_per_m = static_cast<float>(*between(-1000, 1000));
  wire.contacts[0].damping_ns_per_m = static_cast<float>(*between(-50, 50));
  wire.contacts[0].static_friction = static_cast<float>(*between(-2, 2));
  wire.contacts[0].dynamic_friction = static_cast<float>(*between(-2, 2));
  wire.contacts[0].viscosity_ns_per_m = static_cast<float>(*between(-1, 4));
  wire.contacts[0].valid_us = *rc::gen::inRange(0u, 3'000'000u);
  wire.click_n = static_cast<float>(*between(-5, 5));
  ForceSample force;
  RC_ASSERT(parse(wire, force));
  const LocalContact& contact = force.contacts[0];
  RC_ASSERT(contact.stiffness_n_per_m == std::max(0.0f, wire.contacts[0].stiffness_n_per_m));
  RC_ASSERT(contact.damping_ns_per_m == std::max(0.0f, wire.contacts[0].damping_ns_per_m));
  RC_ASSERT(contact.static_friction == std::max(0.0f, wire.contacts[0].static_friction));
  RC_ASSERT(contact.dynamic_friction == std::max(0.0f, wire.contacts[0].dynamic_friction));
  RC_ASSERT(contact.viscosity_ns_per_m ==
            std::clamp<double>(wire.contacts[0].viscosity_ns_per_m, 0, hand::kMaxViscosity_ns_per_m));
  RC_ASSERT(force.clicks.strength_n == std::clamp<double>(wire.click_n, 0, hand::kMaxClick_n));
  RC_ASSERT(contact.validity == std::chrono::microseconds(std::min(wire.contacts[0].valid_us, 1'000'000u)));
}

RC_GTEST_PROP(ParseForce, TakesNoGroovesThatADeviceCannotRender, ()) {
  proto::HapticOutput wire = honest_force(1);
  wire.contacts[0].groove_depth_m = static_cast<float>(*between(-0.001, 0.002));
  proto::set_vec3(wire.contacts[0].groove_wave_W, *between(0, 5000) * any_unit());
  wire.contacts[0].depth_m = 0.003f;
  ForceSample force;
  RC_ASSERT(parse(wire, force));
  const hand::Grooves& grooves = force.contacts[0].grooves;
  RC_ASSERT(hand::are_renderable(grooves.depth_m, grooves.wave_W.norm()));
  RC_ASSERT(force.contacts[0].depth_m > 0);
}

TEST(ParseForce, RefusesAnotherProtocol) {
  proto::HapticOutput wire{};
  wire.protocol = proto::kProtocol + 1;
  ForceSample force;
  EXPECT_FALSE(parse(wire, force));
}

TEST(ParseStatus, a_gauge_goes_up_and_has_two_ends) {
  const auto takes = [](double least, double greatest, bool ranged = true) {
    std::vector<proto::WireQuantity> quantities(1);
    quantities[0].ranged = ranged;
    quantities[0].least = least;
    quantities[0].greatest = greatest;
    proto::WorldStatus wire{};
    wire.protocol = proto::kProtocol;
    proto::look_into(wire.quantities, quantities);
    WorldStatus status;
    return parse(wire, status) && status.quantities[0].range.has_value() == ranged;
  };
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(takes(-5, 20));
  EXPECT_TRUE(takes(kNone, kNone, false)) << "without a range they mean nothing";
  for (const auto& [least, greatest] :
       {std::pair{20.0, -5.0}, {1.0, 1.0}, {kNone, 1.0}, {0.0, kNone}, {0.0, kInfinity}, {-kInfinity, 0.0}})
    EXPECT_FALSE(takes(least, greatest)) << least << " " << greatest;
}

}  // namespace
}  // namespace mechane::client
