// A surface that changes with the step, as clients are told of it.
#include <gtest/gtest.h>

#include "server/collision/superquadric_object.hpp"
#include "server/world/step.hpp"
#include "tests/support/crank_world.hpp"

namespace mechane::world {
namespace {

constexpr double kRadius_m = 0.05, kTip_m = 0.008;
constexpr double kDough_n_per_m = 100, kBread_n_per_m = 2000;

/// A loaf that is dough, and bread while BAKED is on.
std::shared_ptr<state::WorldDescription> loaf() {
  auto world = std::make_shared<state::WorldDescription>();
  state::BodyDescription body;
  body.name = "LOAF";
  body.fixed = true;
  body.haptic.stiffness_n_per_m = kDough_n_per_m;
  geometry::Superquadric shape;
  shape.a = Vec3::Constant(kRadius_m);
  body.object = std::make_shared<const collision::Object>(collision::make_superquadric_object(shape, 0.004));
  world->bodies = {body};
  world->agents = {{"BAKED",
                    "touch.surface",
                    {{"object", std::vector<std::string>{"LOAF"}}, {"stiffness", std::vector<double>{kBread_n_per_m}}},
                    0}};
  return world;
}

TEST(Surface, ThatAStepChangesIsToldToAHandThatComesAnewAndNotToOneThatPresses) {
  WorldConfig config;
  config.hand = test::shared_hand();
  const auto world = std::move(World::create(loaf(), config).value());
  world->state.agent_enabled[0] = 0;
  SystemClock clock;
  PhaseTimer timer(clock);
  NoPublisher nobody;
  state::TickInputs inputs;
  state::UserInput& hand = inputs.users[0];
  hand.present = hand.fresh = true;
  hand.sample.session = 1;
  const auto stiffness_at = [&](double depth_m) {
    ++hand.sample.sequence;
    hand.sample.X_WH.p = Vec3(0, kRadius_m + kTip_m - depth_m, 0);
    step(*world, inputs, nobody, timer);
    const hand::HapticOutput& out = world->state.users[0].output;
    return out.contact_count == 1 ? out.contacts[0].stiffness_n_per_m : 0;
  };
  EXPECT_EQ(stiffness_at(0.002), kDough_n_per_m);
  world->state.agent_enabled[0] = 1;
  EXPECT_EQ(stiffness_at(0.002), kDough_n_per_m);
  stiffness_at(-0.002);  // agents come before touches in a tick, and still saw the last one's
  EXPECT_GT(stiffness_at(-0.002), kDough_n_per_m) << "it is near, and is told what comes";
  EXPECT_EQ(stiffness_at(0.002), kBread_n_per_m);
  world->state.agent_enabled[0] = 0;
  EXPECT_EQ(stiffness_at(0.002), kBread_n_per_m);
}

}  // namespace
}  // namespace mechane::world
