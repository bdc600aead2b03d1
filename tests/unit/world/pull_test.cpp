// A body that a hand carries near its place: what the hand feels of the pull, and how the body moves.
#include <gtest/gtest.h>

#include "server/collision/superquadric_object.hpp"
#include "server/state/world_state.hpp"
#include "server/world/step.hpp"
#include "tests/support/crank_world.hpp"

namespace mechane::world {
namespace {

constexpr double kPull_n = 0.5, kPullFrom_m = 0.1;
const Vec3 kStart_W(0.15, -0.3, 0);

/// A ball of 20 g, and its place at the origin.
std::shared_ptr<state::WorldDescription> ball_and_place(double gravity_m_per_s2) {
  auto world = std::make_shared<state::WorldDescription>();
  world->gravity_W = Vec3(0, -gravity_m_per_s2, 0);
  constexpr double kRadius_m = 0.02, kMass_kg = 0.02;
  state::BodyDescription ball;
  ball.name = "BALL";
  ball.mass_kg = kMass_kg;
  ball.inertia_kg_m2 = 0.4 * kMass_kg * kRadius_m * kRadius_m * Mat3::Identity();
  ball.graspable = true;
  ball.X_WB.p = kStart_W;
  geometry::Superquadric shape;
  shape.a = Vec3::Constant(kRadius_m);
  ball.object = std::make_shared<const collision::Object>(collision::make_superquadric_object(shape, 0.004));
  world->bodies = {ball};
  using Texts = std::vector<std::string>;
  using Numbers = std::vector<double>;
  world->agents = {{"HOLD", "simulation.grasp", {{"bodies", Texts{"BALL"}}, {"forceLimit", Numbers{6}}}, 0},
                   {"SNAP",
                    "geometry.snap",
                    {{"object", Texts{"BALL"}},
                     {"tolerance", Numbers{0.02, 4}},
                     {"pull", Numbers{kPull_n}},
                     {"pullFrom", Numbers{kPullFrom_m}}},
                    0}};
  return world;
}

/// A hand takes the ball, and carries it.
class Carry {
 public:
  explicit Carry(double gravity_m_per_s2 = 9.81) {
    WorldConfig config;
    config.hand = test::shared_hand();
    world_ = std::move(World::create(ball_and_place(gravity_m_per_s2), config).value());
    for (int i = 0; i < 600; ++i)
      tick(Vec3::Zero());
  }
  /// In a straight line.
  void to(const Vec3& p_W, double seconds) {
    const int ticks = static_cast<int>(std::lround(seconds / kTickSeconds));
    const Vec3 v_W = (p_W - p_WH_) / seconds;
    for (int i = 0; i < ticks; ++i)
      tick(v_W);
  }
  void tick(const Vec3& v_W) {
    given_j_ += state().users[0].output.force_W.f.dot(v_W) * kTickSeconds;
    p_WH_ += v_W * kTickSeconds;
    state::TickInputs inputs;
    state::UserInput& input = inputs.users[0];
    input.present = input.fresh = true;
    input.sample.session = 1;
    input.sample.sequence = ++sequence_;
    input.sample.kind = hand::HandKind::one_point;
    input.sample.X_WH.p = p_WH_;
    input.sample.V_WH.v = v_W;
    input.sample.grasp_intent = sequence_ > 100 ? 1 : 0;
    step(*world_, inputs, nobody_, timer_);
  }
  [[nodiscard]] const state::WorldState& state() const { return world_->state; }
  [[nodiscard]] const state::BodyState& ball() const { return state().bodies[0]; }
  [[nodiscard]] bool held() const { return state().users[0].grasp.active; }
  [[nodiscard]] double ahead_of_hand_m() const { return p_WH_.x() - ball().X_WB.p.x(); }
  [[nodiscard]] double force_n() const { return state().users[0].output.force_W.f.x(); }
  [[nodiscard]] double given_j() const { return given_j_; }  ///< to the hand, less what it put in

 private:
  std::unique_ptr<World> world_;
  SystemClock clock_;
  PhaseTimer timer_{clock_};
  NoPublisher nobody_;
  Vec3 p_WH_ = kStart_W;
  std::uint64_t sequence_ = 0;
  double given_j_ = 0;
};

const Vec3 kBeside_W(0.15, 0, 0);
const Vec3 kNear_W(0.12, 0, 0);
const Vec3 kStrongest_W(kPullFrom_m / std::sqrt(5.0), 0, 0);

TEST(Pull, IsFeltThroughTheGraspAndTheLightestBodyLiesStillInIt) {
  Carry carry;
  ASSERT_TRUE(carry.held());
  carry.to(kBeside_W, 1);
  carry.to(kStrongest_W, 1);
  for (int i = 0; i < 500; ++i)
    carry.tick(Vec3::Zero());
  ASSERT_TRUE(carry.held());
  EXPECT_NEAR(carry.force_n(), -kPull_n, 0.02);
  for (int i = 0; i < 500; ++i) {
    carry.tick(Vec3::Zero());
    ASSERT_LT(carry.ball().V_WB.v.norm(), 1e-4) << i;
  }
}

TEST(Pull, DrawsTheBodyHomeAndDoesNotThrowIt) {
  Carry carry;
  carry.to(kBeside_W, 1);
  carry.to(kNear_W, 0.3);
  double most_ahead_m = 0, strongest_n = 0, largest_step_n = 0, last_n = carry.force_n();
  while (carry.held() && carry.ball().X_WB.p.x() > 0) {
    carry.tick(Vec3(-0.1, 0, 0));
    if (!carry.held()) break;
    most_ahead_m = std::max(most_ahead_m, carry.ahead_of_hand_m());
    strongest_n = std::max(strongest_n, -carry.force_n());
    largest_step_n = std::max(largest_step_n, std::abs(carry.force_n() - last_n));
    last_n = carry.force_n();
  }
  EXPECT_FALSE(carry.held()) << "the snap has taken it";
  EXPECT_GT(strongest_n, 0.9 * kPull_n);
  EXPECT_LT(most_ahead_m, 0.003);
  EXPECT_LT(largest_step_n, 0.02);
  carry.to(Vec3::Zero(), 0.5);
  EXPECT_LT(carry.ball().X_WB.p.norm(), 1e-9);
}

// Who has lifted a thing has put in what the pull gives back. Of a thing without weight the governor lets only its margin pass.
TEST(Pull, GivesAHandNoEnergyThatItDidNotPutIn) {
  Carry carry(0);
  ASSERT_TRUE(carry.held());
  carry.to(kBeside_W, 1);
  for (int i = 0; i < 1000 && carry.held(); ++i)
    carry.tick(Vec3(-0.15, 0, 0));
  EXPECT_FALSE(carry.held()) << "the ball is drawn home all the same";
  EXPECT_GT(carry.given_j(), 0);
  EXPECT_LE(carry.given_j(), hand::GovernorConfig{}.energy_margin_j + 1e-6);
}

TEST(Pull, SameInputsGiveTheSameBits) {
  Carry first, second;
  for (const double x_m : {0.08, 0.05, 0.12, 0.0}) {
    first.to(Vec3(x_m, 0, 0), 0.3);
    second.to(Vec3(x_m, 0, 0), 0.3);
    ASSERT_EQ(state::state_hash(first.state()), state::state_hash(second.state())) << x_m;
  }
}

}  // namespace
}  // namespace mechane::world
