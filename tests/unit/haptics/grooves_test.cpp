// Grooves and viscosity of a surface, as the server renders them and as it tells them to clients.
#include <gtest/gtest.h>

#include "server/hand/local_contact_model.hpp"
#include "tests/support/floor_server.hpp"

namespace mechane::haptics {
namespace {

constexpr double kStylusTip_m = 0.008;

hand::HandSample hand_at(double x_m, double depth_m) {
  hand::HandSample sample;
  sample.X_WH.p = Vec3(x_m, kStylusTip_m - depth_m, 0);
  return sample;
}

state::HapticMaterial grooved() {
  state::HapticMaterial material;
  material.static_friction = material.dynamic_friction = 0;
  material.groove_depth_m = 1e-4;
  material.groove_wave_B = Vec3(2 * kPi / 0.008, 0, 0);
  return material;
}

/// The force that is asked for, once the ramp of the visit is over and the slew limit has let it through.
Vec3 settled(test::FloorServer& server, const hand::HandSample& sample) {
  for (int i = 0; i < 600; ++i)
    server.answer(sample);
  return server.answer(sample).force_W.f;
}

TEST(Grooves, AHandThatLiesOnAFlankIsPushedToTheBottom) {
  test::FloorServer server(grooved());
  settled(server, hand_at(0, -0.005));  // free of contact while the ramp goes up
  const Vec3 right = settled(server, hand_at(0.002, 0.003));
  const Vec3 left = settled(server, hand_at(-0.002, 0.003));
  EXPECT_LT(right.x(), -0.02);
  EXPECT_NEAR(left.x(), -right.x(), 0.1 * left.x());
  EXPECT_NEAR(settled(server, hand_at(0.010, 0.003)).x(), right.x(), 0.1 * left.x()) << "on the next groove's flank";
  const Vec3 bottom = settled(server, hand_at(0, 0.003));
  const Vec3 ridge = settled(server, hand_at(0.004, 0.003));
  EXPECT_NEAR(bottom.x(), 0, 0.1 * left.x());
  constexpr double kShare = 2.0 / 3.0;  // of a ball's depth, as its touch has it
  EXPECT_NEAR(ridge.y() - bottom.y(), 600 * kShare * 1e-4, 0.2 * 600 * kShare * 1e-4);
}

// What a client renders at the place that the server saw is what the server renders there, and so it is a little further on.
TEST(Grooves, AClientFeelsTheSameOnesAsTheServer) {
  test::FloorServer server(grooved());
  settled(server, hand_at(0, -0.005));
  for (const double x_m : {-0.031, -0.007, 0.0, 0.0013, 0.012}) {
    settled(server, hand_at(x_m, 0.003));
    hand::LocalContactModel model;
    model.set(server.answer(hand_at(x_m, 0.003)).contact_span(), hand_at(x_m, 0.003).X_WH.p);
    for (const double on_m : {-0.003, -0.001, 0.0, 0.001, 0.003}) {
      const hand::HandSample there = hand_at(x_m + on_m, 0.003);
      const Vec3 of_server = settled(server, there);
      const Vec3 of_client = model.render(there.X_WH.p, Vec3::Zero(), Duration{0});
      // The depth itself differs by some percent: it is a mean over points of the tip.
      EXPECT_NEAR(of_client.x() / of_client.y(), of_server.x() / of_server.y(), 0.001) << x_m << " " << on_m;
      EXPECT_NEAR(of_client.y() / of_server.y(), 1, 0.08) << x_m << " " << on_m;
    }
  }
}

TEST(Viscosity, HoldsBackAHandThatSlides) {
  state::HapticMaterial material;
  material.static_friction = material.dynamic_friction = 0;
  material.viscosity_ns_per_m = 2;
  test::FloorServer server(material);
  settled(server, hand_at(0, -0.005));
  hand::HandSample sliding = hand_at(0, 0.003);
  sliding.V_WH.v = Vec3(0.1, 0, 0);
  EXPECT_NEAR(settled(server, sliding).x(), -0.2, 0.01);
  EXPECT_NEAR(server.answer(sliding).contacts[0].viscosity_ns_per_m, 2, 1e-12);
}

}  // namespace
}  // namespace mechane::haptics
