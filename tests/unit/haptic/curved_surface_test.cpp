// What a stylus feels of a round thing over a slow network, while its client renders it by itself.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "client-sdk/haptic/haptic_loop.hpp"
#include "client-sdk/haptic/simulated_stylus.hpp"
#include "server/collision/superquadric_object.hpp"
#include "server/hand/local_contact_model.hpp"
#include "tests/support/floor_server.hpp"
#include "tests/support/slow_network.hpp"

namespace mechane::haptic {
namespace {

using namespace std::chrono_literals;

/// A round thing in the world's middle, and the way of a hand that slides to and fro on it.
struct RoundThing {
  Vec3 half_m;
  bool is_bar = false;  // along z, else a ball
  bool along = false;   // the bar, else around it

  [[nodiscard]] std::shared_ptr<const collision::Object> object() const {
    geometry::Superquadric shape;
    shape.a = half_m;
    shape.e1 = is_bar ? 0.1 : 1;
    shape.e2 = 1;
    return std::make_shared<const collision::Object>(collision::make_superquadric_object(shape, 0.004));
  }
  /// A place above the surface, `way_m` along the slide.
  [[nodiscard]] Vec3 above(double height_m, double way_m) const {
    const double angle_rad = along ? 0 : way_m / half_m.x();
    return (half_m.x() + height_m) * Vec3(std::cos(angle_rad), std::sin(angle_rad), 0) + Vec3(0, 0, along ? way_m : 0);
  }
};

/// How far the force in the hand is from that of the surface where the stylus really is: roots of mean squares.
struct SlideErrors {
  double direction_rad = 0, size_n = 0;
  double energy_j = 0;  ///< the most that the hand was given beyond what it had put in
};

SlideErrors slide_over(const RoundThing& thing, int delay_ms, bool curved) {
  constexpr double kTip_m = 0.008, kWanted_m = -0.008, kSpeed_m_per_s = 0.2, kReach_m = 0.03, kFirm_n = 0.5;
  const auto object = thing.object();
  test::FloorServer server(object), here(object);
  for (test::FloorServer* one : {&server, &here})
    one->feel({.stiffness_n_per_m = 600, .static_friction = 0, .dynamic_friction = 0});
  test::ScriptedClient client;
  SimulatedStylus stylus({.hand = ArmConfig{}}, thing.above(kTip_m + 0.02, 0));
  test::SlowNetwork network(client, {.delay_ms = delay_ms, .jitter_ms = 5, .loss = 0.05}, 1);
  const auto loop = std::move(HapticLoop::create(client, stylus, RenderMode::local).value());
  SlideErrors errors;
  double given_j = 0, count = 0;
  for (int ms = 0; ms < 2200; ++ms) {
    const TimePoint now = TimePoint(1h) + ms * kTickPeriod;
    hand::HapticOutput answer = server.answer(client.hand);
    for (hand::LocalContact& contact : answer.contacts)
      if (!curved) contact.curvature_per_m = 0;
    network.send(answer, now);
    network.deliver(now);
    const double t_s = ms * kTickSeconds;
    const double way_m = kReach_m * std::sin(kSpeed_m_per_s / kReach_m * std::max(0.0, t_s - 1));
    stylus.intend(thing.above(kTip_m + std::max(kWanted_m, 0.02 - 0.03 * t_s), way_m));
    const Vec3 before = stylus.p_WH(), force_W = stylus.force_W();
    loop->tick(now, kTickPeriod);
    given_j += force_W.dot(stylus.p_WH() - before);
    errors.energy_j = std::max(errors.energy_j, given_j);
    hand::HandSample sample;
    sample.X_WH.p = stylus.p_WH();
    hand::LocalContactModel model;
    model.set(here.answer(sample).contact_span(), stylus.p_WH());
    const Vec3 right_W = model.render(stylus.p_WH(), Vec3::Zero(), 0ms);
    const Vec3 felt_W = loop->rendered().force_W.f;
    if (t_s < 1.2 || right_W.norm() < kFirm_n || felt_W.isZero(0)) continue;
    errors.direction_rad += std::pow(std::atan2(right_W.cross(felt_W).norm(), right_W.dot(felt_W)), 2);
    errors.size_n += std::pow(right_W.norm() - felt_W.norm(), 2);
    ++count;
  }
  EXPECT_GT(count, 500) << "it slides on the surface";
  errors.direction_rad = std::sqrt(errors.direction_rad / count);
  errors.size_n = std::sqrt(errors.size_n / count);
  return errors;
}

constexpr double kMostEnergy_j = 1e-3;

TEST(CurvedSurface, IsFeltWhereItIsThoughTheAnswersAreLate) {
  for (const RoundThing& thing : {RoundThing{Vec3::Constant(0.05)}, RoundThing{Vec3::Constant(0.02)},
                                  RoundThing{Vec3(0.015, 0.015, 0.2), true}, RoundThing{Vec3(0.08, 0.08, 0.2), true}}) {
    for (const int delay_ms : {20, 50}) {
      SCOPED_TRACE(testing::Message() << thing.half_m.x() << " m, " << delay_ms << " ms");
      const SlideErrors plane = slide_over(thing, delay_ms, false), curved = slide_over(thing, delay_ms, true);
      EXPECT_LT(curved.direction_rad, 0.3 * plane.direction_rad);
      EXPECT_LT(curved.size_n, 0.6 * plane.size_n);
      EXPECT_LE(curved.energy_j, kMostEnergy_j);
    }
  }
}

// Along a thin bar the surface is straight; where the hand turns back, the server cannot know in which direction it will go.
TEST(CurvedSurface, ThatIsStraightAlongTheWayStaysNearlySo) {
  const RoundThing bar{Vec3(0.015, 0.015, 0.2), true, true};
  for (const int delay_ms : {20, 50}) {
    const SlideErrors curved = slide_over(bar, delay_ms, true);
    EXPECT_LT(curved.direction_rad, 0.06) << delay_ms;
    EXPECT_LT(curved.size_n, 0.15) << delay_ms;
    EXPECT_LE(curved.energy_j, kMostEnergy_j) << delay_ms;
  }
}

}  // namespace
}  // namespace mechane::haptic
