// Whole exhibits of machine.water_network, from their files to their ticks, against closed forms: a water clock and a coin machine. A hand
// is a force on a body here.
#include <cmath>
#include <functional>
#include <memory>

#include <gtest/gtest.h>

#include "server/scenario/checker.hpp"
#include "server/world/step.hpp"
#include "tests/support/crank_world.hpp"
#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::world {
namespace {

constexpr double kG_m_s2 = 9.81;

/// One of the files beside this test, without its shapes: nothing in it collides.
class WaterWorks {
 public:
  explicit WaterWorks(const std::string& name) {
    const auto file = test::source_folder() / "tests/unit/world/exhibits" / name;
    for (const x3d::Problem& problem : scenario::check(file))
      ADD_FAILURE() << to_string(problem);
    scenario::FakeLoader loader;
    x3d::Problems problems(name);
    auto description = scenario::read_scenario(file, loader, problems);
    if (!description) throw std::runtime_error(description.error().to_string());
    WorldConfig config;
    config.hand = test::shared_hand();
    auto world = World::create(std::make_shared<const state::WorldDescription>(std::move(*description)), config);
    if (!world) throw std::runtime_error(world.error().to_string());
    world_ = std::move(*world);
  }

  using Look = std::function<void(state::WorldState&)>;
  /// `look` comes before each tick.
  void run(double seconds, const Look& look = {}) {
    for (long ticks = std::lround(seconds / kTickSeconds); ticks > 0; --ticks) {
      if (look) look(world_->state);
      world::step(*world_, {}, publisher_, timer_);
    }
  }
  [[nodiscard]] BodyId body(const std::string& name) const { return world_->description->find_body(name); }
  [[nodiscard]] double position(const std::string& joint) const {
    return world_->state[world_->description->find_joint(joint)].position;
  }
  [[nodiscard]] double quantity(const std::string& name) const {
    return world_->state.quantities.at(world_->description->find_quantity(name).index());
  }

 private:
  std::unique_ptr<World> world_;
  SystemClock clock_;
  PhaseTimer timer_{clock_};
  NoPublisher publisher_;
};

double spout_m3_s(double bore_m, double discharge, double head_m) {
  return discharge * kPi * bore_m * bore_m / 4 * std::sqrt(2 * kG_m_s2 * head_m);
}

TEST(WaterWorks, AWaterClocksPointerRisesEvenlyAndTheCockEmptiesIt) {
  WaterWorks clock("water-clock.x3d");
  clock.run(1);
  const double start_m = clock.position("GUIDE");
  const double area_m2 = kPi * 0.025 * 0.025;
  const double rise_m_s = spout_m3_s(0.002, 0.7, 0.3) / area_m2;
  for (const double seconds : {4, 8, 12}) {
    clock.run(4);
    const double expected_m = rise_m_s * seconds;
    EXPECT_NEAR(clock.position("GUIDE") - start_m, expected_m, 0.01 * expected_m) << seconds;
  }
  EXPECT_NEAR(clock.quantity("overflow"), 2.0 / 60 - 1000 * spout_m3_s(0.002, 0.7, 0.3), 1e-4);
  const double level_m = clock.quantity("water");
  clock.run(1, [&](state::WorldState& state) { state[clock.body("COCK")].load_W.t.z() += 0.03; });
  EXPECT_NEAR(clock.position("TAP"), 1.4, 0.01);
  clock.run(2 * area_m2 / spout_m3_s(0.015, 0.6, level_m) * level_m);
  EXPECT_LT(clock.quantity("water"), 0.01) << "what the spout brings runs through";
  EXPECT_LT(clock.position("GUIDE"), start_m - 0.03);
}

/// What flows while the beam swings: up under the coin to the angle at which that slides off, on by its swing, and back under the
/// counterweight. The valve opens with the angle.
double dose_m3() {
  const double inertia_kg_m2 = 0.002, slides_rad = 0.2, full_rad = 0.6;
  const double up_rad_s2 = (0.05 * kG_m_s2 * 0.12 - 0.02) / inertia_kg_m2, back_rad_s2 = 0.02 / inertia_kg_m2;
  const double up_s = std::sqrt(2 * slides_rad / up_rad_s2), rate_rad_s = up_rad_s2 * up_s;
  const double back_s = (rate_rad_s + std::sqrt(rate_rad_s * rate_rad_s + 2 * back_rad_s2 * slides_rad)) / back_rad_s2;
  const double angle_s = up_rad_s2 * std::pow(up_s, 3) / 6 + slides_rad * back_s + rate_rad_s * back_s * back_s / 2 -
                         back_rad_s2 * std::pow(back_s, 3) / 6;
  return spout_m3_s(0.008, 0.6, 0.25) * angle_s / full_rad;
}

TEST(WaterWorks, ACoinsWeightPoursADose) {
  WaterWorks machine("coin-machine.x3d");
  machine.run(1);
  EXPECT_EQ(machine.quantity("dose"), 0) << "the coin waits in the slot";
  const auto push = [&](double newtons) {
    return [&machine, newtons](state::WorldState& state) { state[machine.body("COIN")].load_W.f.y() += newtons; };
  };
  const double dose_l = 1000 * dose_m3();
  for (const double coins : {1, 2}) {
    machine.run(0.5, push(-2));
    machine.run(2);
    EXPECT_EQ(machine.quantity("coins"), coins);
    EXPECT_NEAR(machine.quantity("dose"), coins * dose_l, 0.05 * coins * dose_l);
    EXPECT_NEAR(machine.position("BEAM"), 0, 1e-3) << "it is shut again";
    machine.run(0.5, push(3));
  }
}

}  // namespace
}  // namespace mechane::world
