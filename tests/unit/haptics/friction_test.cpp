#include "server/haptics/friction.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "server/haptics/render_forces.hpp"
#include "tests/support/crank_world.hpp"

namespace mechane::haptics {
namespace {

constexpr double kDepth_m = 0.003;

/// A hand of one point, or a glove's palm, that touches a fixed body from above with a depth of 3 mm, wherever it is.
class Rub {
 public:
  explicit Rub(FrictionKind kind = FrictionKind::sticks, hand::HandKind hand = hand::HandKind::one_point)
      : world_(block()), state_(world_), renderer_(ForceRenderer::create(config(kind)).value()) {
    renderer_.start(state_);
    user().present = true;
    user().freshness = 1;
    user().sample.kind = hand;
    for (int i = 0; i < 1000; ++i)
      tick();
  }
  /// One tick with the hand moved on by `step_m`. Returns the force on it.
  Vec3 tick(const Vec3& step_m = Vec3::Zero()) {
    user().X_WS[0].p += step_m;
    user().X_WH.p += step_m;
    user().V_WH.v = step_m / kTickSeconds;
    user().contacts[0] = {BodyId(0), 0, user().X_WS[0].p, Vec3::UnitY(), kDepth_m};
    user().contact_count = touches_ ? 1 : 0;
    state_.bodies[0].load_W = Wrench{};
    renderer_.run(world_, *test::shared_hand(), state_);
    return user().output.force_W.f;
  }
  /// The force after many such ticks.
  Vec3 go(const Vec3& step_m, int ticks) {
    Vec3 f = Vec3::Zero();
    for (int i = 0; i < ticks; ++i)
      f = tick(step_m);
    return f;
  }
  state::UserState& user() { return state_.users[0]; }
  state::BodyState& body() { return state_.bodies[0]; }
  void touch(bool on) { touches_ = on; }

 private:
  static state::WorldDescription block() {
    state::WorldDescription world;
    state::BodyDescription body;
    body.name = "BLOCK";
    body.fixed = true;
    body.haptic.static_friction = 0.5;
    body.haptic.dynamic_friction = 0.3;
    world.bodies = {body};
    return world;
  }
  static ForceConfig config(FrictionKind kind) {
    ForceConfig config;
    config.friction = kind;
    config.governor.passivity = false;
    return config;
  }

  state::WorldDescription world_;
  state::WorldState state_;
  ForceRenderer renderer_;
  bool touches_ = true;
};

const Vec3 kStep(3e-5, 0, 0);  // 0.03 m/s

TEST(Friction, OfASlidingHandIsDynamicAndAgainstIt) {
  for (const auto kind : {FrictionKind::sticks, FrictionKind::damps}) {
    Rub rub(kind);
    const Vec3 f = rub.go(kStep, 500);
    EXPECT_NEAR(f.x() / f.y(), -0.3, 1e-6);
  }
}

TEST(Friction, HoldsAHandThatRests) {
  Rub rub;
  rub.go(kStep, 500);
  const Vec3 slid = rub.go(Vec3::Zero(), 500);
  EXPECT_NEAR(slid.x() / slid.y(), -0.3, 1e-6) << "what it pulled with when it stopped";
  const Vec3 back = rub.go(-kStep, 20);
  EXPECT_GT(back.x(), slid.x());
  Rub damped(FrictionKind::damps);
  damped.go(kStep, 500);
  EXPECT_EQ(damped.go(Vec3::Zero(), 500).x(), 0) << "what it was before";
}

TEST(Friction, IsStaticUntilItSlides) {
  Rub rub;
  double most = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 f = rub.tick(kStep / 3);
    most = std::max(most, -f.x() / f.y());
  }
  EXPECT_GT(most, 0.45);
  EXPECT_LE(most, 0.5 + 1e-9);
  EXPECT_NEAR(-rub.tick(kStep / 3).x(), 0.3 * 600 * kDepth_m, 0.01);
}

TEST(Friction, IsForgottenOnceTheHandHasLeftOrJumped) {
  Rub rub;
  ASSERT_LT(rub.go(kStep, 500).x(), -0.1);
  rub.touch(false);
  rub.go(kStep, 20);
  EXPECT_EQ(rub.user().anchor_count, 0u);
  rub.touch(true);
  EXPECT_EQ(rub.go(Vec3::Zero(), 1000).x(), 0);
  rub.go(kStep, 100);
  rub.user().jumped = true;
  rub.tick(Vec3(0.1, 0, 0));
  rub.user().jumped = false;
  EXPECT_NEAR(rub.go(Vec3::Zero(), 1000).x(), 0, 1e-9);
}

TEST(Friction, CarriesAHandWithABodyThatMoves) {
  Rub rub;
  for (int i = 0; i < 100; ++i) {
    rub.body().X_WB.p += kStep;
    rub.tick();
  }
  const double k = 600, moved_m = 100 * kStep.x();
  EXPECT_NEAR(rub.tick().x(), std::min(k * moved_m, 0.3 * k * kDepth_m), 1e-6);
  Rub together;
  for (int i = 0; i < 100; ++i) {
    together.body().X_WB.p += kStep;
    together.body().V_WB.v = kStep / kTickSeconds;
    together.tick(kStep);
  }
  EXPECT_NEAR(together.tick().x(), 0, 0.05);
}

TEST(Friction, OfAFingerThatRollsIsNone) {
  Rub rub(FrictionKind::sticks, hand::HandKind::glove);
  const double radius_m = 0.008 - kDepth_m;
  const double turn_rad = 1e-3;
  auto& X_WS = rub.user().X_WS[0];
  rub.user().anchor_count = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 step = Vec3(turn_rad * radius_m, 0, 0);
    X_WS.p += step;
    X_WS.R = Quat(Eigen::AngleAxisd(-turn_rad, Vec3::UnitZ())) * X_WS.R;
    FrictionAnchors anchors(rub.user());
    ContactPatch patch;
    patch.body = BodyId(0);
    patch.p_WC = X_WS.p - Vec3(0, radius_m, 0);  // where the finger's surface rests for a moment
    patch.n_BH_W = Vec3::UnitY();
    const Stretch stretch = anchors.stretch_of(patch, Pose{}).value_or(Stretch{});
    anchors.keep(patch, Pose{}, stretch);
    ASSERT_LT(stretch.s_W.norm(), 1e-4) << i;
  }
}

/// How far a palm creeps in a minute, m, that is pulled with 0.5 N along the surface, held by nothing but friction, and told to the server
/// with the steps of a tracker.
double creep_m(FrictionKind kind) {
  Rub rub(kind, hand::HandKind::glove);
  const double mass_kg = 0.4, pull_n = 0.5;
  double x = 0, v = 0, told = 0;
  const double tracker_step_m = 1e-4;
  for (int i = 0; i < 60'000; ++i) {
    const double tell = tracker_step_m * std::round(x / tracker_step_m);
    const Vec3 f = rub.tick(Vec3(tell - told, 0, 0));
    told = tell;
    v += kTickSeconds / mass_kg * (pull_n + f.x() - 10 * v);
    x += kTickSeconds * v;
  }
  return x;
}

TEST(Friction, AHandThatLiesStillDoesNotCreep) {
  EXPECT_LT(creep_m(FrictionKind::sticks), 0.001);
  EXPECT_GT(creep_m(FrictionKind::damps), 0.01) << "what it was before";
}

}  // namespace
}  // namespace mechane::haptics
