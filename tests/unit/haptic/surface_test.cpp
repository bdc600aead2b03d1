// What a device with mass and its own flaws does on the surfaces that an author may write.
#include <algorithm>

#include <gtest/gtest.h>

#include "client-sdk/haptic/simulated_stylus.hpp"
#include "server/hand/local_contact_model.hpp"

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

}  // namespace
}  // namespace mechane::haptic
