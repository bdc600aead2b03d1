#include "client-sdk/haptic/hand_speed.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/played_world.hpp"
#include "tests/support/property_draw.hpp"

namespace mechane::haptic {
namespace {

using namespace std::chrono_literals;

RC_GTEST_PROP(HandSpeed, IsKnownToTwoEncoderStepsOverItsTime, ()) {
  constexpr double kEncoder_m = 5.5e-5;
  const Vec3 v_WH = *test::between(0, 0.5) * test::any_unit(), w_WH = *test::between(0, 3) * test::any_unit();
  const Duration dt = *rc::gen::element(Duration(250us), Duration(1ms), Duration(4ms), Duration(30ms));
  HandSpeed speed;
  Twist told;
  for (int i = 0; i < 100; ++i) {
    const double t_s = i * to_seconds(dt);
    const Vec3 p_WH = kEncoder_m * (t_s / kEncoder_m * v_WH).array().round().matrix();
    told = speed.note({p_WH, quat_from_rotation_vector(t_s * w_WH)}, dt);
  }
  const double over_s = to_seconds(std::max(dt, HandSpeed::kOver));
  RC_ASSERT((told.v - v_WH).cwiseAbs().maxCoeff() <= kEncoder_m / over_s + 1e-9);
  RC_ASSERT((told.w - w_WH).norm() < 1e-6);
}

TEST(HandSpeed, OfAHandThatStopsIsZeroSoonAndOfOneThatWasLostAtOnce) {
  HandSpeed speed;
  Vec3 p_WH = Vec3::Zero();
  EXPECT_TRUE(speed.note({p_WH, Quat::Identity()}, 0ms).v.isZero(0));
  for (int i = 0; i < 50; ++i)
    (void)speed.note({p_WH += Vec3(1e-3, 0, 0), Quat::Identity()}, 1ms);
  for (Duration past = 1ms; past < HandSpeed::kOver; past += 1ms)
    EXPECT_GT(speed.note({p_WH, Quat::Identity()}, 1ms).v.x(), 0) << past.count();
  EXPECT_TRUE(speed.note({p_WH, Quat::Identity()}, 1ms).v.isZero(0));
  speed.forget();
  EXPECT_TRUE(speed.note({p_WH + Vec3(1, 0, 0), Quat::Identity()}, 1ms).v.isZero(0));
}

constexpr double kBall_m = 0.03;

/// A ball that nothing but hands holds.
std::shared_ptr<state::WorldDescription> loose_ball(double mass_kg) {
  state::BodyDescription ball;
  ball.name = "BALL";
  ball.mass_kg = mass_kg;
  ball.inertia_kg_m2 = 0.4 * mass_kg * kBall_m * kBall_m * Mat3::Identity();
  ball.use_gravity = false;
  ball.graspable = true;
  geometry::Superquadric shape;
  shape.a = Vec3::Constant(kBall_m);
  ball.object = std::make_shared<const collision::Object>(collision::make_superquadric_object(shape, 0.004));
  auto world = std::make_shared<state::WorldDescription>();
  world->bodies = {ball};
  world->agents = {{"HOLD",
                    "simulation.grasp",
                    {{"bodies", std::vector<std::string>{"BALL"}}, {"forceLimit", std::vector<double>{6}}},
                    0}};
  return world;
}

/// The forces of two seconds in which a stylus carries the ball along `v_W`.
std::vector<Vec3> carried(double mass_kg, const Vec3& v_W) {
  HandIntent intent;
  intent.X_WH.p = Vec3(kBall_m + 0.008, 0, 0);
  test::PlayedWorld play(loose_ball(mass_kg), std::span(&intent.X_WH.p, 1), RenderMode::local, {.delay_ms = 1});
  std::vector<Vec3> felt_W;
  for (int ms = 0; ms < 3000; ++ms) {
    if (ms == 100) intent = {.X_WH = {Vec3(kBall_m, 0, 0), Quat::Identity()}, .grasp_intent = 1};
    if (ms > 500) intent.X_WH.p += kTickSeconds * v_W;
    play.tick(std::span(&intent, 1));
    if (ms > 1000) felt_W.push_back(play.hand(0).force_W());
  }
  EXPECT_TRUE(play.state().users[0].grasp.active);
  EXPECT_NEAR((play.state().bodies[0].V_WB.v - v_W).norm(), 0, 0.005) << "the ball goes along";
  return felt_W;
}

/// How far a force is from its mean over 50 ms: 99 % of the milliseconds are below.
double swing_n(const std::vector<Vec3>& force_W) {
  constexpr std::size_t kHalf = 25;
  std::vector<double> swings_n;
  for (std::size_t i = kHalf; i + kHalf < force_W.size(); ++i) {
    Vec3 mean_W = Vec3::Zero();
    for (std::size_t j = i - kHalf; j <= i + kHalf; ++j)
      mean_W += force_W[j] / (2 * kHalf + 1);
    swings_n.push_back((force_W[i] - mean_W).norm());
  }
  std::sort(swings_n.begin(), swings_n.end());
  return swings_n[swings_n.size() * 99 / 100];
}

TEST(HandSpeed, LetsWhatIsCarriedSlowlyBeFeltWithoutTheEncodersSteps) {
  for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0.6, 0.64, 0.48)}) {
    for (const double mass_kg : {0.1, 0.5})
      EXPECT_LT(swing_n(carried(mass_kg, 0.02 * way)), 0.2) << mass_kg << " kg along " << way.transpose();
  }
}

}  // namespace
}  // namespace mechane::haptic
