// Two hands on one thing, of one visitor or of two: a bar that they carry by its ends, and a crank.
#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "tests/support/played_world.hpp"

namespace mechane {
namespace {

using namespace std::chrono_literals;
using haptic::RenderMode;
using test::Network;

const Network kSlowNetworks[] = {{.delay_ms = 1}, {20, 5, 0.05}, {50, 5, 0.05}};
constexpr double kHalfBarM = 0.15;
constexpr double kTouchM = 0.0075;  // from the middle of a stylus' tip to a surface that it touches: 0.5 mm deep

/// The bar lies along x, about the origin. Nothing but hands holds it, and it has no weight of its own.
std::shared_ptr<state::WorldDescription> bar_world() {
  geometry::Superquadric shape;
  shape.a = Vec3(kHalfBarM, 0.02, 0.02);
  shape.e1 = shape.e2 = 0.3;
  auto world = test::make_crank_description();
  state::BodyDescription bar;
  bar.name = "BAR";
  bar.mass_kg = 0.5;
  bar.inertia_kg_m2 = Vec3(0.0002, 0.004, 0.004).asDiagonal();
  bar.use_gravity = false;
  bar.graspable = true;
  bar.object = std::make_shared<const collision::Object>(collision::make_superquadric_object(shape, 0.004));
  bar.haptic.stiffness_n_per_m = 600;
  world->bodies = {bar};
  world->joints = {};
  world->agents = {{"GRASP", "simulation.grasp", {{"bodies", std::vector<std::string>{"BAR"}}}, 0}};
  world->quantities = {{"held", "GRASP.active", ""}};
  world->steps[0].triggers = {};
  return world;
}

/// Two styluses, each with an aim that the test moves.
class TwoStyluses {
 public:
  TwoStyluses(std::shared_ptr<const state::WorldDescription> world, const Vec3& a, const Vec3& b,
              const Network& network)
      : aims_{a, b}, play_(std::move(world), aims_, RenderMode::local, network) {
    stay(1s);
  }

  /// The hands go by these ways at 0.1 m/s, and stay there.
  void go(const Vec3& a, const Vec3& b, Duration time) {
    const std::array<Vec3, 2> from = aims_, ways{a, b};
    for (Duration past{0}; past < time; past += kTickPeriod) {
      std::array<haptic::HandIntent, 2> intents;
      for (std::size_t u = 0; u < 2; ++u) {
        const double gone_m = 0.1 * to_seconds(past), way_m = ways[u].norm();
        aims_[u] = from[u] + ways[u] * (gone_m < way_m ? gone_m / way_m : 1.0);
        intents[u].X_WH.p = aims_[u];
        intents[u].grasp_intent = closed[u] ? 1 : 0;
      }
      play_.state().bodies[0].load_W.f.y() -= weight_n;
      play_.tick(intents);
      note();
    }
  }
  void go_alone(std::size_t u, const Vec3& way, Duration time) {
    std::array<Vec3, 2> ways{Vec3::Zero(), Vec3::Zero()};
    ways[u] = way;
    go(ways[0], ways[1], time);
  }
  void stay(Duration time) { go(Vec3::Zero(), Vec3::Zero(), time); }

  [[nodiscard]] const state::WorldState& state() const { return play_.state(); }
  [[nodiscard]] const Pose& X_WB() const { return play_.state().bodies[0].X_WB; }
  [[nodiscard]] bool holds(std::size_t u) const { return play_.state().users[u].grasp.active; }
  [[nodiscard]] Vec3 force_W(std::size_t u) const { return play_.hand(u).force_W(); }

  std::array<bool, 2> closed{true, true};
  double weight_n = 0;
  double most_n = 0;        ///< the largest force on a hand
  double energy_max_j = 0;  ///< the most that both hands together were given beyond what they had put in
  double least_x_n = 1e9, most_x_n = -1e9;  ///< of the force on the first hand, since the test has last set them

 private:
  void note() {
    for (std::size_t u = 0; u < 2; ++u)
      most_n = std::max(most_n, force_W(u).norm());
    energy_max_j = std::max(energy_max_j, play_.hand(0).energy_j() + play_.hand(1).energy_j());
    least_x_n = std::min(least_x_n, force_W(0).x());
    most_x_n = std::max(most_x_n, force_W(0).x());
  }

  std::array<Vec3, 2> aims_;
  test::PlayedWorld play_;
};

TwoStyluses at_the_bars_ends(const Network& network) {
  return {bar_world(), Vec3(-kHalfBarM - kTouchM, 0, 0), Vec3(kHalfBarM + kTouchM, 0, 0), network};
}

TEST(TwoHands, FeelHalfEachOfWhatTheyLiftTogether) {
  TwoStyluses hands = at_the_bars_ends({.delay_ms = 1});
  ASSERT_TRUE(hands.holds(0) && hands.holds(1));
  hands.weight_n = 2;
  hands.go(Vec3(0, 0.1, 0), Vec3(0, 0.1, 0), 2s);
  for (std::size_t u = 0; u < 2; ++u)
    EXPECT_LT((hands.force_W(u) - Vec3(0, -1, 0)).norm(), 0.05) << "hand " << u;
  EXPECT_NEAR(hands.X_WB().p.y(), 0.1, 0.005) << "the springs of arms and grips";
  EXPECT_LT(rotation_vector(hands.X_WB().R).norm(), 0.002) << "it stays level";
}

TEST(TwoHands, ThatPullAgainstEachOtherFeelTheSameAndAreGivenNothing) {
  for (const Network& network : kSlowNetworks) {
    TwoStyluses hands = at_the_bars_ends(network);
    hands.go(Vec3(-0.02, 0, 0), Vec3(0.02, 0, 0), 2s);
    hands.least_x_n = 1e9, hands.most_x_n = -1e9;
    hands.stay(8s);
    ASSERT_TRUE(hands.holds(0) && hands.holds(1)) << network.delay_ms;
    const double pull_n = hands.force_W(0).x();
    EXPECT_GT(pull_n, 0.2) << network.delay_ms;
    EXPECT_LT((hands.force_W(0) + hands.force_W(1)).norm(), 0.1 * pull_n) << network.delay_ms;
    EXPECT_LT(hands.most_x_n - hands.least_x_n, 0.1 * pull_n) << network.delay_ms << " ms: they stand still";
    hands.go(Vec3(0.02, 0, 0), Vec3(-0.02, 0, 0), 2s);
    EXPECT_LE(hands.most_n, hand::GovernorConfig{}.max_force_n + 1e-9) << network.delay_ms;
    EXPECT_LE(hands.energy_max_j, 0.001) << network.delay_ms;
  }
}

/// One hand after the other opens, goes away, comes back and takes hold again.
TEST(TwoHands, HandAThingOverWithinAMillimetre) {
  TwoStyluses hands = at_the_bars_ends({.delay_ms = 1});
  hands.weight_n = 0.2;
  hands.go(Vec3(0, 0.05, 0), Vec3(0, 0.05, 0), 1s);
  for (const std::size_t u : {0U, 1U, 0U}) {
    const Vec3 p_WB = hands.X_WB().p;
    const Vec3 away(u == 0 ? -0.03 : 0.03, 0, 0);
    hands.closed[u] = false;
    hands.stay(200ms);
    hands.go_alone(u, away, 800ms);
    EXPECT_TRUE(!hands.holds(u) && hands.holds(1 - u));
    EXPECT_LT((hands.X_WB().p - p_WB).norm(), 0.001) << "hand " << u << " has let go";
    hands.go_alone(u, -away, 500ms);
    hands.closed[u] = true;
    hands.stay(500ms);
    EXPECT_TRUE(hands.holds(0) && hands.holds(1)) << "hand " << u;
    EXPECT_LT((hands.X_WB().p - p_WB).norm(), 0.001) << "hand " << u << " is back";
  }
}

TwoStyluses at_a_crank(const Network& network) {
  const double out_m = test::kCrankRadiusM + test::kGripRadiusM + kTouchM;
  return {test::make_crank_description(), Vec3(out_m, 0, 0.03), Vec3(out_m, 0, -0.03), network};
}

TEST(TwoHands, ThatTurnACrankAgainstEachOtherHoldItStill) {
  for (const Network& network : kSlowNetworks) {
    TwoStyluses hands = at_a_crank(network);
    ASSERT_TRUE(hands.holds(0) && hands.holds(1)) << network.delay_ms;
    hands.go(Vec3(0, 0.01, 0), Vec3(0, -0.01, 0), 3s);
    const double push_n = -hands.force_W(0).y();
    EXPECT_GT(push_n, 0.2) << network.delay_ms;
    EXPECT_NEAR(hands.force_W(1).y(), push_n, 0.1 * push_n) << network.delay_ms;
    EXPECT_NEAR(hands.state().joints[0].position, 0, 0.004) << network.delay_ms << " ms: a millimetre";
    EXPECT_LE(hands.energy_max_j, 0.001) << network.delay_ms;
  }
}

TEST(TwoHands, OneTurnsOnWhatTheOtherHasLetGo) {
  TwoStyluses hands = at_a_crank({20, 5, 0.05});
  hands.go(Vec3(0, 0.03, 0), Vec3(0, 0.03, 0), 1s);
  const double together_rad = hands.state().joints[0].position;
  EXPECT_NEAR(together_rad, 0.03 / test::kCrankRadiusM, 0.02);
  hands.closed[0] = false;
  hands.go_alone(0, Vec3(0.03, 0, 0), 1s);
  EXPECT_TRUE(!hands.holds(0) && hands.holds(1));
  EXPECT_NEAR(hands.state().joints[0].position, together_rad, 0.004);
  hands.go_alone(1, Vec3(0, 0.03, 0), 1s);
  EXPECT_NEAR(hands.state().joints[0].position, 0.06 / test::kCrankRadiusM, 0.03);
}

}  // namespace
}  // namespace mechane
