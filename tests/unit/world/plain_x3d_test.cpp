// Standard X3D files as they run: shapes from the file, built for touch, moved by the whole tick; against closed forms, within 1 %.
#include <cmath>
#include <functional>
#include <memory>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "server/content/object_store.hpp"
#include "server/scenario/compiler.hpp"
#include "server/world/step.hpp"
#include "tests/support/crank_world.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_files.hpp"

namespace mechane::world {
namespace {

std::string box_body(const std::string& def, const std::string& fields, const std::string& geometry) {
  return fmt::format(
      "<RigidBody DEF='{0}' containerField='bodies' {1}><CollidableShape DEF='C_{0}' containerField='geometry'>"
      "<Shape containerField='shape'>{2}</Shape></CollidableShape></RigidBody>\n",
      def, fields, geometry);
}

class Loader final : public scenario::ObjectLoader {
 public:
  explicit Loader(const std::filesystem::path& cache) : store_(cache) {}
  Expected<std::shared_ptr<const collision::Object>> load(const std::filesystem::path& file, const std::string& node,
                                                          const geometry::SolidChoice& solid) override {
    collision_build::BuildConfig config;
    config.solid = solid;
    return store_.load(file, node, config);
  }
  Expected<std::string> content_hash(const std::filesystem::path& file) override { return scenario::hash_file(file); }

 private:
  content::ObjectStore store_;
};

/// A file's world, from reading it to its ticks.
class PlainWorld {
 public:
  explicit PlainWorld(const std::string& scene) {
    read(folder_.write("plain.x3d", "<X3D version='4.0' profile='Full'><Scene>" + scene + "</Scene></X3D>"));
  }
  explicit PlainWorld(const std::filesystem::path& file) { read(file); }

  void run(double seconds, const std::function<void()>& look = {}) {
    for (long ticks = std::lround(seconds / kTickSeconds); ticks > 0; --ticks) {
      world::step(*world_, {}, publisher_, timer_);
      time_s_ += kTickSeconds;
      if (look) look();
    }
  }
  [[nodiscard]] double time_s() const { return time_s_; }
  [[nodiscard]] const state::WorldDescription& description() const { return *world_->description; }
  [[nodiscard]] const state::BodyState& body(const std::string& name) const {
    return world_->state[world_->description->find_body(name)];
  }
  /// A field of one of X3D's nodes: "SENSOR.isActive".
  [[nodiscard]] double value(const std::string& name) const {
    state::MemoryLayout layout;
    if (!agents::AgentSet::create(*world_->description, layout)) throw std::runtime_error("no agents");
    return world_->state.memory[layout.find(name)->index];
  }

 private:
  void read(const std::filesystem::path& file) {
    Loader loader(folder_.path() / "cache");
    x3d::Problems problems("plain.x3d");
    auto description = scenario::read_scenario(file, loader, problems);
    if (!description) throw std::runtime_error(description.error().to_string());
    WorldConfig config;
    config.hand = test::shared_hand();
    auto world = World::create(std::make_shared<const state::WorldDescription>(std::move(*description)), config);
    if (!world) throw std::runtime_error(world.error().to_string());
    world_ = std::move(*world);
  }

  test::ScratchFolder folder_;
  std::unique_ptr<World> world_;
  SystemClock clock_;
  PhaseTimer timer_{clock_};
  NoPublisher publisher_;
  double time_s_ = 0;
};

constexpr const char* kBox = "<Box size='0.2 0.2 0.2'/>";

TEST(PlainX3dWorld, FallsSlowsDownAndIsDriven) {
  PlainWorld world(
      "<RigidBodyCollection>" + box_body("FALLS", "position='0 500 0'", kBox) +
      box_body("SLOWS",
               "position='2 0 0' useGlobalGravity='false' linearVelocity='0 0 3' autoDamp='true' "
               "linearDampingFactor='0.4'",
               kBox) +
      box_body("PUSHED", "position='4 0 0' useGlobalGravity='false' mass='2' forces='0 0 3 0 0 1'", kBox) +
      box_body("SPUN", "position='6 0 0' useGlobalGravity='false' inertia='0.5 0 0 0 0.5 0 0 0 0.5' torques='1 0 0'",
               kBox) +
      "</RigidBodyCollection>");
  world.run(10);
  EXPECT_NEAR(500 - world.body("FALLS").X_WB.p.y(), 0.5 * 9.8 * 100, 4.9);
  const double way_m = 3 * (std::pow(0.6, 10) - 1) / std::log(0.6);
  EXPECT_NEAR(world.body("SLOWS").X_WB.p.z(), way_m, 0.01 * way_m);
  EXPECT_NEAR(world.body("PUSHED").X_WB.p.z(), 0.5 * 2 * 100, 1);
  EXPECT_NEAR(world.body("SPUN").V_WB.w.x(), 20, 0.2);
}

TEST(PlainX3dWorld, APendulumSwingsInItsTime) {
  PlainWorld world(
      "<RigidBodyCollection>" + box_body("BOB", "position='1 0 0'", "<Sphere radius='0.1'/>") +
      "<BallJoint containerField='joints' anchorPoint='0 0 0'><RigidBody USE='BOB' containerField='body1'/>"
      "</BallJoint></RigidBodyCollection>");
  double crossed_s = 0, before = 1;
  int crossings = 0;
  world.run(10, [&] {
    const double x = world.body("BOB").X_WB.p.x();
    if ((before > 0) != (x > 0)) {
      ++crossings;
      crossed_s = world.time_s();
    }
    before = x;
  });
  // From a right angle: four times the quarter 1.8540747 sqrt(I / (m g L)), and its solid turns with it.
  const double period_s = 4 * 1.8540747 * std::sqrt((1 + 0.4 * 0.01) / 9.8);
  ASSERT_EQ(crossings, 8);
  EXPECT_NEAR(crossed_s, (0.25 + 0.5 * 7) * period_s, 0.01 * crossed_s);
}

TEST(PlainX3dWorld, ABlockSlidesDownASlopeAgainstFriction) {
  const double slope = 0.5, friction = 0.3;
  const std::string turned = fmt::format("orientation='0 0 1 {}'", -slope);
  const Vec3 up(std::sin(slope), std::cos(slope), 0);
  const Vec3 start = 0.6 * up;
  PlainWorld world(
      "<RigidBodyCollection><CollisionCollection containerField='collider' frictionCoefficients='0.3 0.3' "
      "appliedParameters='\"FRICTION_COEFFICIENT-2\"'><CollidableShape USE='C_SLOPE' "
      "containerField='collidables'/><CollidableShape USE='C_BLOCK' containerField='collidables'/>"
      "</CollisionCollection>" +
      box_body("SLOPE", "fixed='true' " + turned, "<Box size='12 1 2'/>") +
      box_body("BLOCK", fmt::format("position='{} {} 0' {}", start.x(), start.y(), turned), kBox) +
      "</RigidBodyCollection>");
  world.run(2);
  const Vec3 way = world.body("BLOCK").X_WB.p - start;
  const double expected_m = 0.5 * 9.8 * (std::sin(slope) - friction * std::cos(slope)) * 4;
  EXPECT_NEAR(way.norm(), expected_m, 0.01 * expected_m);
  EXPECT_NEAR(way.dot(up), 0, 0.002);
}

TEST(PlainX3dWorld, TheManualsExampleRuns) {
  const std::string page = test::text_of(test::source_folder() / "scenarios/REFERENCE.md");
  const std::size_t begin = page.find("<Scene>", page.find("## Shapes without a modelling program")) + 7;
  PlainWorld world(page.substr(begin, page.find("</Scene>", begin) - begin));
  world.run(2);
  EXPECT_NEAR(world.body("BALL").X_WB.p.y(), 0.75 + 0.06, 0.001);
}

TEST(PlainX3dWorld, WithoutAViewpointOneSeesWhatCanMove) {
  const PlainWorld world("<RigidBodyCollection>" + box_body("GROUND", "fixed='true'", "<Box size='80 1 80'/>") +
                         box_body("LEFT", "position='3 2 -5'", kBox) + box_body("RIGHT", "position='4 2 -5'", kBox) +
                         "</RigidBodyCollection>");
  const state::Viewpoint& view = world.description().viewpoints.at(0);
  EXPECT_GT(view.X_WV.p.y(), 2);
  double widest = 0;
  for (const double x : {2.9, 4.1}) {
    const Vec3 p_V = view.X_WV.inverse() * Vec3(x, 2, -5);
    ASSERT_LT(p_V.z(), 0);
    const double edge = -p_V.z() * std::tan(view.field_of_view_rad / 2);
    widest = std::max({widest, std::abs(p_V.x()) / edge, std::abs(p_V.y()) / edge});
  }
  EXPECT_GT(widest, 0.3);
  EXPECT_LT(widest, 0.7);
}

TEST(PlainX3dWorld, WithoutAViewpointOneSeesWhereThingsSwing) {
  const PlainWorld world("<RigidBodyCollection>" + box_body("BOB", "position='1 0 0'", kBox) +
                         "<BallJoint containerField='joints'><RigidBody USE='BOB' containerField='body1'/></BallJoint>"
                         "</RigidBodyCollection>");
  const state::Viewpoint& view = world.description().viewpoints.at(0);
  for (const Vec3& p_W : {Vec3(0, -1, 0), Vec3(-1, 0, 0)}) {
    const Vec3 p_V = view.X_WV.inverse() * p_W;
    const double edge = -p_V.z() * std::tan(view.field_of_view_rad / 2);
    EXPECT_LT(p_V.head<2>().norm(), 0.8 * edge);
  }
}

TEST(PlainX3dWorld, ThingsRestOnEachOtherAndWheelsRoll) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it builds many shapes; shorter tests go the same ways");
  std::string car = box_body("GROUND", "fixed='true' position='0 -0.5 0'", "<Box size='8 1 40'/>") +
                    box_body("BLOCK", "position='3 0.5 0'", "<Box size='0.4 0.4 0.4'/>") +
                    box_body("CHASSIS", "mass='5' position='0 0.5 0'", "<Box size='1 0.4 2'/>");
  for (const auto& [name, x, z] :
       {std::tuple("FL", -0.6, 0.8), {"FR", 0.6, 0.8}, {"RL", -0.6, -0.8}, {"RR", 0.6, -0.8}}) {
    car += box_body(
        name, fmt::format("position='{} 0.4 {}' orientation='0 0 1 -1.5708' torques='{} 0 0'", x, z, z < 0 ? 1 : 0),
        "<Cylinder radius='0.4' height='0.2'/>");
    car += fmt::format(
        "<SingleAxisHingeJoint containerField='joints' axis='1 0 0' anchorPoint='{} 0.4 {}'><RigidBody USE='{}' "
        "containerField='body1'/><RigidBody USE='CHASSIS' containerField='body2'/></SingleAxisHingeJoint>",
        x, z, name);
  }
  PlainWorld world("<RigidBodyCollection>" + car + "</RigidBodyCollection>");
  world.run(4);
  EXPECT_NEAR(world.body("BLOCK").X_WB.p.y(), 0.2, 0.002);
  // Two torques of 1 N m; four wheels of 1 kg, each of which counts half more because it turns.
  const double expected_m = 0.5 * (2 / 0.4) / (5 + 4 * 1.5) * 16;
  const Vec3 car_at = world.body("CHASSIS").X_WB.p;
  EXPECT_NEAR(car_at.z(), expected_m, 0.07 * expected_m) << "wheels lose a twentieth: deploy/LIMITS.md";
  EXPECT_NEAR(car_at.y(), 0.5, 0.01);
  EXPECT_NEAR(car_at.x(), 0, 0.02 * expected_m);
}

// A box that falls 2 m, and bounces a little; when it first hits, a clock starts that moves a flag.
TEST(PlainX3dWorld, ACollisionStartsAClock) {
  PlainWorld world("<RigidBodyCollection>" + box_body("FLOOR", "fixed='true'", "<Box size='10 1 10'/>") +
                   box_body("FALLER", "position='0 3 0'", "<Box size='1 1 1'/>") +
                   "</RigidBodyCollection><CollisionSensor DEF='HIT'><CollisionCollection containerField='collider' "
                   "bounce='0.2'><CollidableShape USE='C_FLOOR' containerField='collidables'/><CollidableShape "
                   "USE='C_FALLER' containerField='collidables'/></CollisionCollection></CollisionSensor>"
                   "<BooleanFilter DEF='IF'/><TimeTrigger DEF='WHEN'/><TimeSensor DEF='CLOCK' cycleInterval='20'/>"
                   "<PositionInterpolator DEF='WAY' key='0 1' keyValue='0 0 0 20 0 0'/>"
                   "<Transform DEF='FLAG'><Shape><Box size='0.1 0.1 0.1'/></Shape></Transform>"
                   "<ROUTE fromNode='HIT' fromField='isActive' toNode='IF' toField='set_boolean'/>"
                   "<ROUTE fromNode='IF' fromField='inputTrue' toNode='WHEN' toField='set_boolean'/>"
                   "<ROUTE fromNode='WHEN' fromField='triggerTime' toNode='CLOCK' toField='startTime'/>"
                   "<ROUTE fromNode='CLOCK' fromField='fraction_changed' toNode='WAY' toField='set_fraction'/>"
                   "<ROUTE fromNode='WAY' fromField='value_changed' toNode='FLAG' toField='translation'/>");
  const double hit_s = std::sqrt(2 * 2 / 9.8);
  double first_s = 0;
  world.run(10, [&] {
    if (first_s == 0 && world.value("HIT.isActive") == 1) first_s = world.time_s();
  });
  EXPECT_NEAR(first_s, hit_s, 0.01 * hit_s);
  EXPECT_NEAR(world.body("FLAG").X_WB.p.x(), 10 - hit_s, 0.01 * (10 - hit_s));
  EXPECT_EQ(world.value("HIT.isActive"), 1) << "it rests on the floor";
  EXPECT_NEAR(world.body("FALLER").X_WB.p.y(), 1, 0.002);
}

TEST(PlainX3dWorld, WhatEventsMovePushesBodies) {
  PlainWorld world("<RigidBodyCollection>" +
                   box_body("GROUND", "fixed='true' position='0 -0.5 0'", "<Box size='9 1 4'/>") +
                   box_body("PUSHER", "fixed='true' position='-2 0.3 0'", "<Box size='0.4 0.4 0.4'/>") +
                   box_body("BLOCK", "position='-1 0.2 0'", "<Box size='0.4 0.4 0.4'/>") +
                   "</RigidBodyCollection><PositionDamper DEF='D' order='2' tau='1' initialValue='-2 0.3 0' "
                   "initialDestination='1 0.3 0'/>"
                   "<ROUTE fromNode='D' fromField='value_changed' toNode='PUSHER' toField='position'/>");
  world.run(10);
  const double x = world.body("PUSHER").X_WB.p.x();
  EXPECT_NEAR(x, 1 - 3 * 11 * std::exp(-10.0), 1e-6);
  EXPECT_NEAR(world.body("BLOCK").X_WB.p.x(), x + 0.4, 0.05);
  EXPECT_NEAR(world.body("BLOCK").X_WB.p.y(), 0.2, 0.002);
}

std::filesystem::path shared_file(const std::string& name) {
  return test::shared_folder() / "x3d/rigid_body" / name;
}

// Each is simulated for 10 s, and where its closed form ends, to there. The tests above have twins of all, which need no file.
TEST(PlainX3dWorld, TheSharedFilesMoveAsTheyShould) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it builds many shapes; shorter tests go the same ways");
  if (!std::filesystem::exists(shared_file(""))) GTEST_SKIP() << "no sample files beside the project";
  PlainWorld fall(shared_file("sim-physics.x3d"));
  fall.run(10);
  EXPECT_NEAR(10 - fall.body("Body").X_WB.p.y(), 490, 4.9);
  PlainWorld damper(shared_file("sim-damper.x3d"));
  damper.run(1);
  const double expected_m = 5 * (1 - std::exp(-2.5) * (1 + 2.5 + 2.5 * 2.5 / 2));
  EXPECT_NEAR(damper.body("Mover").X_WB.p.x(), expected_m, 0.01 * expected_m);
  damper.run(9);
  EXPECT_NEAR(damper.body("Mover").X_WB.p.x(), 5, 0.001);
  PlainWorld collision(shared_file("sim-collision.x3d"));
  double hit_s = 0;
  collision.run(10, [&] {
    if (hit_s == 0 && collision.value("Sensor.isActive") == 1) hit_s = collision.time_s();
  });
  EXPECT_NEAR(hit_s, std::sqrt(4 / 9.8), 0.01);
  EXPECT_NEAR(collision.body("Faller").X_WB.p.y(), 1, 0.002);
  PlainWorld pendulum(shared_file("sim-joints.x3d"));
  int crossings = 0;
  double before_m = 1, longest_m = 0;
  pendulum.run(10, [&] {
    const Vec3 p = pendulum.body("Body").X_WB.p;
    crossings += (before_m > 0) != (p.x() > 0) ? 1 : 0;
    before_m = p.x();
    longest_m = std::max(longest_m, std::abs(p.norm() - 1));
  });
  EXPECT_EQ(crossings, 8);
  EXPECT_LT(longest_m, 0.001);
  PlainWorld car(shared_file("sim-vehicle.x3d"));
  car.run(5);
  const double way_m = 0.5 * (6 / 0.4) / (5 + 4 * 1.5) * 25;
  EXPECT_NEAR(car.body("Chassis").X_WB.p.z(), way_m, 0.07 * way_m) << "wheels lose a twentieth: deploy/LIMITS.md";
  car.run(5);
  EXPECT_GT(car.body("Chassis").X_WB.p.z(), 25) << "it has left its ground";
}

}  // namespace
}  // namespace mechane::world
