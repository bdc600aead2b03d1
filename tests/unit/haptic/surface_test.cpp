// What a device with mass and its own flaws does on the surfaces that an author may write.
#include <algorithm>

#include <gtest/gtest.h>

#include "client-sdk/haptic/haptic_loop.hpp"
#include "client-sdk/haptic/simulated_stylus.hpp"
#include "server/hand/local_contact_model.hpp"
#include "server/state/surface_keys.hpp"
#include "tests/support/floor_server.hpp"
#include "tests/support/scripted_client.hpp"

namespace mechane::haptic {
namespace {

using namespace std::chrono_literals;

constexpr double kStiffness_n_per_m = 600;
constexpr double kPress_n = 2;

/// How far a stylus moves to and fro in a second, m, that a weight has pressed onto the surface for nine.
double trembles_m(const hand::LocalContact& surface) {
  const StylusConfig stylus_config{.load_W = Vec3(0, -kPress_n, 0)};
  SimulatedStylus stylus(stylus_config, Vec3(0, -kPress_n / kStiffness_n_per_m, 0));
  hand::LocalContactModel model;
  model.set(std::span(&surface, 1), Vec3::Zero());
  stylus.push(Vec3(0.01, -0.01, 0));
  Vec3 low = Vec3::Constant(1), high = Vec3::Constant(-1);
  for (Duration past{0}; past < 10s; past += kTickPeriod) {
    const client::HandSample sample = stylus.read(kTickPeriod);
    hand::HandForce force;
    force.force_W.f = model.render(sample.X_WH.p, sample.V_WH.v, 0ms);
    stylus.write(force);
    if (past < 9s) continue;
    low = low.cwiseMin(stylus.p_WH());
    high = high.cwiseMax(stylus.p_WH());
  }
  return (high - low).maxCoeff();
}

TEST(Surface, TheSteepestGroovesAndTheMostViscosityDoNotShakeAStylus) {
  hand::LocalContact surface;
  surface.n_W = Vec3::UnitY();
  surface.stiffness_n_per_m = kStiffness_n_per_m;
  surface.validity = 1h;
  const double resolution_m = StylusConfig{}.resolution_m;
  EXPECT_LE(trembles_m(surface), 1.5 * resolution_m) << "smooth";
  for (const double distance_m : {0.0005, 0.001, 0.002, 0.005, 0.01, 0.05}) {
    const double wave = 2 * kPi / distance_m;
    for (const double viscosity : {0.0, hand::kMaxViscosity_ns_per_m}) {
      surface.viscosity_ns_per_m = viscosity;
      surface.grooves = {hand::max_groove_depth_m(wave), Vec3(wave, 0, 0), kPi / 2};
      ASSERT_TRUE(hand::are_renderable(surface.grooves.depth_m, wave));
      EXPECT_LE(trembles_m(surface), 1.5 * resolution_m) << distance_m << " m, " << viscosity << " N s/m";
    }
  }
}

/// A hand with a stylus on a floor that changes how it feels, whoever touches it.
class ChangingFloor {
 public:
  explicit ChangingFloor(RenderMode mode) : loop_(std::move(HapticLoop::create(client_, stylus_, mode).value())) {
    stylus_.intend(kFree);
    run(kSoft_n_per_m, 1s);
  }
  void press() { stylus_.intend(kFree - Vec3(0, 0.03, 0)); }
  void run(double stiffness_n_per_m, Duration time) {
    floor_.feel({.stiffness_n_per_m = stiffness_n_per_m});
    for (Duration past{0}; past < time; past += kTickPeriod) {
      now_ += kTickPeriod;
      client_.answer_with(floor_.answer(client_.hand), now_);
      const Vec3 p_WH = stylus_.p_WH(), before_W = stylus_.force_W();
      loop_->tick(now_, kTickPeriod);
      given_j_ += before_W.dot(stylus_.p_WH() - p_WH);
      most_given_j = std::max(most_given_j, given_j_);
      largest_rise_n = std::max(largest_rise_n, stylus_.force_W().norm() - before_W.norm());
      most_n = std::max(most_n, stylus_.force_W().norm());
    }
  }
  double most_given_j = 0;
  double largest_rise_n = 0;
  double most_n = 0;

  static constexpr double kSoft_n_per_m = 100;

 private:
  inline static const Vec3 kFree{0, 0.02, 0};
  test::FloorServer floor_{{.stiffness_n_per_m = kSoft_n_per_m}};
  test::ScriptedClient client_;
  SimulatedStylus stylus_{{.hand = ArmConfig{}}, kFree};
  std::unique_ptr<HapticLoop> loop_;
  TimePoint now_{1h};
  double given_j_ = 0;  // what the stylus has given to the hand on it, less what the hand put in
};

// The agent touch.surface changes no surface under a hand. An activity that starts anew does, and a hand that a slow network has not shown
// to the server may be there; then the client's governor is what remains.
TEST(Surface, OneThatHardensUnderAHandGivesItNoEnergy) {
  for (const RenderMode mode : {RenderMode::local, RenderMode::server}) {
    ChangingFloor floor(mode);
    floor.press();
    floor.run(ChangingFloor::kSoft_n_per_m, 1s);
    for (int i = 0; i < 20; ++i) {
      floor.run(state::surface_key("stiffness").max, 70ms);
      floor.run(ChangingFloor::kSoft_n_per_m, 130ms);
    }
    const hand::GovernorConfig limits;
    EXPECT_GT(floor.most_n, 2) << "it hardened";
    EXPECT_LE(floor.most_n, limits.max_force_n + 1e-9);
    EXPECT_LE(floor.largest_rise_n, limits.max_slew_n_per_s * kTickSeconds + 1e-9);
    const double not_seen_j =
        limits.max_force_n * StylusConfig{}.resolution_m;  // by the observer, between two encoder steps
    EXPECT_LE(floor.most_given_j, HapticLoop::kEnergyMargin_j + not_seen_j);
  }
}

}  // namespace
}  // namespace mechane::haptic
