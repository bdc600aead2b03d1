#include "server/hand/local_contact_model.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::hand {
namespace {

using namespace std::chrono_literals;

double number(double from, double to) {
  return from + (to - from) * *rc::gen::inRange(0, 10'001) / 10'000.0;
}

Vec3 unit() {
  const double z = number(-1, 1);
  const double a = number(0, 2 * kPi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(a), r * std::sin(a), z};
}

LocalContact wall(double stiffness = 600) {
  LocalContact c;
  c.n_W = Vec3::UnitZ();
  c.stiffness_n_per_m = stiffness;
  return c;
}

/// Grooves along x and z, as steep as is allowed or less.
Grooves any_grooves() {
  const double wave = 2 * kPi / number(0.001, 0.02);
  const double angle = number(0, 2 * kPi);
  return {number(0, 1) * max_groove_depth_m(wave), wave * Vec3(std::cos(angle), 0, 0.5 * std::sin(angle)),
          number(0, 2 * kPi)};
}

RC_GTEST_PROP(LocalContactModel, PushesWithStiffnessTimesDepthWhereTheServerSawIt, ()) {
  LocalContact c = wall(number(10, 2000));
  c.n_W = unit();
  c.p_W = Vec3(number(-1, 1), number(-1, 1), number(-1, 1));
  c.depth_m = number(0, 0.02);
  c.curvature_per_m = *rc::gen::element(0.0, 15.0, -15.0);
  // The hand's reference point lies anywhere: at the tip's centre, or at a wrist.
  const Vec3 p_WH0(number(-1, 1), number(-1, 1), number(-1, 1));
  LocalContactModel model;
  RC_ASSERT(model.set(std::span(&c, 1), p_WH0) == 1);
  const Vec3 force = model.render(p_WH0, Vec3::Zero(), 0ms);
  RC_ASSERT((force - c.stiffness_n_per_m * c.depth_m * c.n_W).norm() < 1e-6);
  // Moved on by a little along the normal: that much less deep, on a plane and on a sphere.
  const Vec3 p_WH = p_WH0 + 0.3 * c.depth_m * c.n_W;
  RC_ASSERT((model.render(p_WH, Vec3::Zero(), 1ms) - 0.7 * c.stiffness_n_per_m * c.depth_m * c.n_W).norm() < 1e-6);
}

TEST(LocalContactModel, ASphereFallsAwayBesideItAndAHollowRises) {
  const Vec3 aside(0.01, 0, 0);
  for (const double curvature : {20.0, 0.0, -20.0}) {
    LocalContact c = wall();
    c.depth_m = 0.002;
    c.curvature_per_m = curvature;
    LocalContactModel model;
    model.set(std::span(&c, 1), Vec3::Zero());
    const double plane = c.stiffness_n_per_m * c.depth_m;
    const double force = model.render(aside, Vec3::Zero(), 0ms).norm();
    const double bulge = curvature * aside.squaredNorm() / 2;  // to second order
    EXPECT_NEAR(force, std::max(plane - c.stiffness_n_per_m * bulge, 0.0), 0.05 * plane) << curvature;
  }
}

// Small steps of place and speed make small steps of force, through the touch of the surface too.
RC_GTEST_PROP(LocalContactModel, IsContinuous, ()) {
  LocalContact c = wall(number(100, 1500));
  c.damping_ns_per_m = number(0, 5);
  c.dynamic_friction = number(0, 1);
  c.curvature_per_m = *rc::gen::element(0.0, 10.0, -10.0);
  c.v_W = Vec3(number(-0.2, 0.2), 0, number(-0.2, 0.2));
  c.viscosity_ns_per_m = number(0, kMaxViscosity_ns_per_m);
  c.grooves = any_grooves();
  LocalContactModel model;
  model.set(std::span(&c, 1), Vec3::Zero());
  const Vec3 p(number(-0.01, 0.01), number(-0.01, 0.01), number(-0.005, 0.002));
  const Vec3 v(number(-0.5, 0.5), number(-0.5, 0.5), number(-0.5, 0.5));
  const Duration age = std::chrono::microseconds(*rc::gen::inRange(0, 40'000));
  const Vec3 dp = 1e-9 * unit();
  const Vec3 dv = 1e-9 * unit();
  const Vec3 change = model.render(p + dp, v + dv, age + 1us) - model.render(p, v, age);
  RC_ASSERT(change.norm() < 2e-3);
}

TEST(LocalContactModel, DampsOnlyWhatPushesIn) {
  LocalContact c = wall();
  c.depth_m = 0.002;
  c.damping_ns_per_m = 5;
  LocalContactModel model;
  model.set(std::span(&c, 1), Vec3::Zero());
  const double still = model.render(Vec3::Zero(), Vec3::Zero(), 0ms).z();
  EXPECT_NEAR(model.render(Vec3::Zero(), Vec3(0, 0, -0.1), 0ms).z(), still + 0.5, 1e-12);
  EXPECT_EQ(model.render(Vec3::Zero(), Vec3(0, 0, 0.1), 0ms).z(), still);
  c.v_W = Vec3(0, 0, 0.1);  // the wall comes
  model.set(std::span(&c, 1), Vec3::Zero());
  EXPECT_NEAR(model.render(Vec3::Zero(), Vec3::Zero(), 0ms).z(), still + 0.5, 1e-12);
}

RC_GTEST_PROP(LocalContactModel, FrictionStaysInItsConeAndOpposesTheSlide, ()) {
  LocalContact c = wall();
  c.depth_m = number(0, 0.01);
  c.damping_ns_per_m = number(0, 5);
  c.dynamic_friction = number(0, 1);
  LocalContactModel model;
  model.set(std::span(&c, 1), Vec3::Zero());
  const Vec3 v(number(-0.3, 0.3), number(-0.3, 0.3), 0);
  for (int ms = 0; ms < 50; ++ms) {
    const Vec3 force = model.render(1e-3 * ms * v, v, 0ms);
    const Vec3 tangential(force.x(), force.y(), 0);
    RC_ASSERT(tangential.norm() <= c.dynamic_friction * force.z() * (1 + 1e-12) + 1e-12);
    RC_ASSERT(tangential.dot(v) <= 0);
  }
}

/// 1.2 N on a wall with a friction of one half; the hand is new there.
LocalContactModel pressed(Vec3 v_W = Vec3::Zero()) {
  LocalContact c = wall();
  c.depth_m = 0.002;
  c.dynamic_friction = 0.5;
  c.v_W = v_W;
  LocalContactModel model;
  model.set(std::span(&c, 1), Vec3::Zero());
  return model;
}

TEST(LocalContactModel, AHandThatIsPushedAsideIsHeldAndSlidesBeyondTheCone) {
  LocalContactModel model = pressed();
  const auto sideways_n = [&model](double x_m) { return model.render(Vec3(x_m, 0, 0), Vec3::Zero(), 0ms).x(); };
  EXPECT_NEAR(sideways_n(0.0005), -0.3, 1e-12) << "as stiff as the wall";
  for (int ms = 0; ms < 60'000; ++ms)
    ASSERT_NEAR(sideways_n(0.0005), -0.3, 1e-12) << "it crept in " << ms << " ms";
  EXPECT_NEAR(sideways_n(0.02), -0.6, 1e-12) << "half of 1.2 N";
  EXPECT_NEAR(sideways_n(0.0195), -0.3, 1e-12) << "on the way back it gives way first";
  EXPECT_NEAR(sideways_n(0.01), 0.6, 1e-12);
}

TEST(LocalContactModel, AHandIsHeldByStaticFrictionUntilItSlidesAndByDynamicFrictionUntilItGoesBack) {
  LocalContact c = wall();
  c.depth_m = 0.002;
  c.static_friction = 0.5;
  c.dynamic_friction = 0.25;
  LocalContactModel model;
  const auto sideways_n = [&](double x_m) {
    model.set(std::span(&c, 1), Vec3(x_m, 0, 0));  // each answer goes on with what is known of the surface
    return model.render(Vec3(x_m, 0, 0), Vec3::Zero(), 0ms).x();
  };
  model.set(std::span(&c, 1), Vec3::Zero());
  EXPECT_NEAR(sideways_n(0.0009), -0.54, 1e-12) << "more than half of 0.6 N";
  EXPECT_NEAR(sideways_n(0.0011), -0.3, 1e-12) << "it has come loose";
  EXPECT_NEAR(sideways_n(0.0030), -0.3, 1e-12);
  EXPECT_NEAR(sideways_n(0.0028), -0.18, 1e-12) << "it went back, and sticks";
  EXPECT_NEAR(sideways_n(0.0034), -0.54, 1e-12);
}

TEST(LocalContactModel, FrictionForgetsWhereAHandStuckThatHasLeft) {
  LocalContactModel model = pressed();
  (void)model.render(Vec3(0.0005, 0, 0), Vec3::Zero(), 0ms);
  (void)model.render(Vec3(0.005, 0, 0.01), Vec3::Zero(), 0ms);
  EXPECT_NEAR(model.render(Vec3(0.005, 0, 0), Vec3::Zero(), 0ms).x(), 0, 1e-12);
}

TEST(LocalContactModel, FrictionIsTheSameHoweverNoisyTheVelocity) {
  LocalContactModel model = pressed();
  const Vec3 p_WH(0.0005, 0, 0);
  const Vec3 still = model.render(p_WH, Vec3::Zero(), 0ms);
  EXPECT_EQ(model.render(p_WH, Vec3(0.055, 0, 0), 0ms), still) << "one count of an encoder in a millisecond";
}

TEST(LocalContactModel, TheHandGoesOnStickingFromOneAnswerToTheNext) {
  LocalContactModel model = pressed();
  LocalContact c = wall();
  c.depth_m = 0.002;
  c.dynamic_friction = 0.5;
  Vec3 p_WH = Vec3::Zero();
  for (int answer = 0; answer < 10; ++answer) {
    p_WH.x() += 0.00005;
    model.set(std::span(&c, 1), p_WH);
    EXPECT_NEAR(model.render(p_WH, Vec3::Zero(), 0ms).x(), -600 * p_WH.x(), 1e-12);
  }
  c.n_W = Vec3::UnitY();
  model.set(std::span(&c, 1), p_WH);
  EXPECT_NEAR(model.render(p_WH, Vec3::Zero(), 0ms).x(), 0, 1e-12) << "another wall";
}

TEST(LocalContactModel, ASurfaceThatMovesTakesTheHandAlong) {
  LocalContactModel model = pressed(Vec3(0.05, 0, 0));
  EXPECT_NEAR(model.render(Vec3::Zero(), Vec3::Zero(), 4ms).x(), 600 * 0.05 * 0.004, 1e-12);
  LocalContact c = wall();
  c.depth_m = 0.002;
  c.dynamic_friction = 0.5;
  c.v_W = Vec3(0.05, 0, 0);
  model.set(std::span(&c, 1), Vec3::Zero());
  EXPECT_NEAR(model.render(Vec3::Zero(), Vec3::Zero(), 4ms).x(), 600 * 0.05 * 0.008, 1e-12) << "on from there";
}

// A hand that draws a closed path at 1 kHz through a static wall gets no energy out of it, beyond what sampling a spring makes:
// half its stiffness times the square of each step.
RC_GTEST_PROP(LocalContactModel, IsPassiveOnAStaticWall, ()) {
  LocalContact c = wall(number(100, 1500));
  c.damping_ns_per_m = number(0, 5);
  c.static_friction = number(0, 1.5);
  c.dynamic_friction = number(0, 1);
  c.viscosity_ns_per_m = number(0, kMaxViscosity_ns_per_m);
  c.curvature_per_m = *rc::gen::element(0.0, 10.0, -5.0);
  if (*rc::gen::arbitrary<bool>()) c.grooves = any_grooves();
  c.validity = 1h;
  LocalContactModel model;
  model.set(std::span(&c, 1), Vec3::Zero());
  const double ax = number(0, 0.02), az = number(0, 0.008), fx = *rc::gen::inRange(1, 5), fz = *rc::gen::inRange(1, 5);
  const double phase = number(0, 2 * kPi);
  const auto place = [&](int i) {
    const double t = 2 * kPi * i / 1000.0;
    return Vec3(ax * std::sin(fx * t), 0, az * std::sin(fz * t + phase));
  };
  // Where grooves bend most, the slope of the force is that of the spring, of the flank and of the crest.
  const double steepest = c.grooves.depth_m > 0 ? 1 + kMaxFlank + kMaxCrest_per_m * 0.008 : 1;
  double out_j = 0, sampling_j = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 step = place(i + 1) - place(i);
    const Vec3 v = (place(i) - place(i - 1)) / 1e-3;
    out_j += model.render(place(i), v, 0ms).dot(step);
    sampling_j += steepest * c.stiffness_n_per_m * step.squaredNorm();
  }
  RC_ASSERT(out_j <= sampling_j + 1e-9);
}

TEST(LocalContactModel, AHandIsPushedIntoTheGroovesAndFeelsThemWhereTheyAre) {
  LocalContact c = wall(1000);
  c.depth_m = 0.002;
  const double distance_m = 0.008;
  c.grooves = {.depth_m = 1e-4, .wave_W = Vec3(2 * kPi / distance_m, 0, 0), .phase_rad = 0};
  LocalContactModel model;
  const Vec3 p_WH0(0.3, 0, 0);  // at the bottom of a groove
  model.set(std::span(&c, 1), p_WH0);
  const auto force = [&](double x_m) { return model.render(p_WH0 + Vec3(x_m, 0, 0), Vec3::Zero(), 0ms); };
  EXPECT_NEAR(force(0).z(), 1000 * 0.0019, 1e-9);
  EXPECT_NEAR(force(distance_m / 2).z(), 1000 * 0.002, 1e-9) << "on the ridge";
  EXPECT_NEAR(force(distance_m).z(), 1000 * 0.0019, 1e-9) << "in the next groove";
  EXPECT_LT(force(distance_m / 4).x(), -0.05) << "back to the bottom";
  EXPECT_GT(force(-distance_m / 4).x(), 0.05);
  EXPECT_NEAR(force(distance_m / 2).x(), 0, 1e-9);
  // The next answer, for a hand that has gone on, says the same of the same place.
  c.grooves.phase_rad = kPi / 2;
  const Vec3 before = force(distance_m / 4 + 0.001);
  model.set(std::span(&c, 1), p_WH0 + Vec3(distance_m / 4, 0, 0));
  EXPECT_LT((force(distance_m / 4 + 0.001) - before).norm(), 1e-9);
}

// A saw would hold a hand and throw it; a wall that vanished would be worse.
TEST(LocalContactModel, SmoothsGroovesThatAreTooSteep) {
  LocalContact c = wall();
  c.depth_m = 0.002;
  c.grooves = {.depth_m = 0.001, .wave_W = Vec3(5000, 0, 0), .phase_rad = 1};
  LocalContactModel model;
  model.set(std::span(&c, 1), Vec3::Zero());
  EXPECT_EQ(model.render(Vec3::Zero(), Vec3::Zero(), 0ms), Vec3(0, 0, 1.2));
}

// Without friction, the force is the slope of the spring's energy: in whatever way a hand moves, it gets back what it gave.
RC_GTEST_PROP(LocalContactModel, TheForceOfGroovesIsTheGradientOfAnEnergy, ()) {
  LocalContact c = wall();
  c.depth_m = number(0.0005, 0.004);
  c.grooves = any_grooves();
  c.grooves.wave_W.z() = 0;
  RC_PRE(are_renderable(c.grooves.depth_m, c.grooves.wave_W.norm()));
  LocalContactModel model;
  model.set(std::span(&c, 1), Vec3::Zero());
  const auto energy_j = [&](const Vec3& p) {
    const double phase = c.grooves.phase_rad + c.grooves.wave_W.dot(p);
    const double left_m = c.depth_m - p.z() - 0.5 * c.grooves.depth_m * (1 + std::cos(phase));
    return left_m > 0 ? 0.5 * c.stiffness_n_per_m * left_m * left_m : 0;
  };
  const Vec3 p(number(-0.01, 0.01), number(-0.01, 0.01), number(-0.003, 0.003));
  const Vec3 force = model.render(p, Vec3::Zero(), 0ms);
  constexpr double kStep_m = 1e-7;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 step = kStep_m * Vec3::Unit(axis);
    RC_ASSERT(std::abs(force[axis] + (energy_j(p + step) - energy_j(p - step)) / (2 * kStep_m)) < 1e-3);
  }
}

TEST(LocalContactModel, ViscosityOfSeveralTouchesIsNoMoreThanThatOfOne) {
  std::vector<LocalContact> contacts(5, wall(100));
  for (LocalContact& c : contacts) {
    c.depth_m = 0.002;
    c.viscosity_ns_per_m = 1.5;
  }
  LocalContactModel model;
  model.set(contacts, Vec3::Zero());
  EXPECT_NEAR(model.render(Vec3::Zero(), Vec3(0.1, 0, 0), 0ms).x(), -0.1 * kMaxViscosity_ns_per_m, 1e-12);
}

TEST(LocalContactModel, ViscosityHoldsBackWhatSlidesAndNothingElse) {
  LocalContact c = wall();
  c.depth_m = 0.002;
  c.viscosity_ns_per_m = 2;
  LocalContactModel model;
  model.set(std::span(&c, 1), Vec3::Zero());
  const Vec3 still = model.render(Vec3::Zero(), Vec3::Zero(), 0ms);
  EXPECT_LT((model.render(Vec3::Zero(), Vec3(0.1, 0, 0.1), 0ms) - still - Vec3(-0.2, 0, 0)).norm(), 1e-12);
}

TEST(LocalContactModel, FollowsTheSurfaceWhileValidAndFadesOutAfterwards) {
  LocalContact c = wall(1000);
  c.depth_m = 0.001;
  c.v_W = Vec3(0, 0, 0.1);
  c.validity = 10ms;
  LocalContactModel model;
  model.set(std::span(&c, 1), Vec3::Zero());
  EXPECT_NEAR(model.render(Vec3::Zero(), Vec3::Zero(), 5ms).z(), 1.5, 1e-9);
  EXPECT_NEAR(model.render(Vec3::Zero(), Vec3::Zero(), 10ms).z(), 2.0, 1e-9);
  EXPECT_NEAR(model.render(Vec3::Zero(), Vec3::Zero(), 20ms).z(), 1.0, 1e-9) << "half faded, and no further ahead";
  EXPECT_EQ(model.render(Vec3::Zero(), Vec3::Zero(), 30ms), Vec3::Zero());
  EXPECT_EQ(model.render(Vec3::Zero(), Vec3::Zero(), Duration::max()), Vec3::Zero());
}

TEST(LocalContactModel, LeavesOutWhatCannotBeAndWhatIsTooMuch) {
  std::vector<LocalContact> contacts(12, wall());
  contacts[0].n_W = Vec3::Zero();
  contacts[1].depth_m = std::numeric_limits<double>::quiet_NaN();
  contacts[2].stiffness_n_per_m = -5;
  LocalContactModel model;
  EXPECT_EQ(model.set(contacts, Vec3::Zero()), 8u);
  EXPECT_EQ(model.set(std::span(contacts).first(4), Vec3::Zero()), 1u);
  EXPECT_EQ(model.set(contacts, Vec3(std::nan(""), 0, 0)), 0u);
  EXPECT_EQ(model.render(Vec3::Zero(), Vec3::Zero(), 0ms), Vec3::Zero());
}

}  // namespace
}  // namespace mechane::hand
