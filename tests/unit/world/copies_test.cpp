// Many bodies of one RigidBody run as the same bodies written out by hand: to the bit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "server/content/object_store.hpp"
#include "server/scenario/compiler.hpp"
#include "server/world/step.hpp"
#include "tests/support/crank_world.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::world {
namespace {

class ShapeLoader final : public scenario::ObjectLoader {
 public:
  explicit ShapeLoader(const std::filesystem::path& cache) : store_(cache) {}
  Expected<std::shared_ptr<const collision::Object>> load(const std::filesystem::path& file, const std::string& node,
                                                          const geometry::SolidChoice& solid) override {
    ++loaded;
    collision_build::BuildConfig config;
    config.solid = solid;
    return store_.load(file, node, config);
  }
  Expected<std::string> content_hash(const std::filesystem::path& file) override { return scenario::hash_file(file); }

  int loaded = 0;

 private:
  content::ObjectStore store_;
};

std::string coin(const std::string& name, const Vec3& p_W, const std::string& copies) {
  return fmt::format(
      "<RigidBody DEF='{}' containerField='bodies' mass='0.02' inertia='2e-6 0 0 0 3e-6 0 0 0 2e-6' position='{} {} "
      "{}' "
      "linearVelocity='0.1 0 0' angularVelocity='0 2 1' centerOfMass='0 0.001 0'>"
      "<MetadataSet containerField='metadata' name='mechane'><MetadataSet containerField='value' name='mechane:body'>"
      "<MetadataDouble containerField='value' name='restitution' value='0.3'/>{}</MetadataSet>"
      "<MetadataSet containerField='value' name='mechane:haptic'>"
      "<MetadataBoolean containerField='value' name='graspable' value='true'/></MetadataSet></MetadataSet>"
      "<CollidableShape containerField='geometry'><Shape containerField='shape'>"
      "<Cylinder radius='0.03' height='0.012'/></Shape></CollidableShape></RigidBody>\n",
      name, p_W.x(), p_W.y(), p_W.z(), copies);
}

/// Coins that hang still at first, and then fall onto a table and onto each other.
std::string exhibit(const std::string& coins, const std::string& names, const std::string& changes_still,
                    const std::string& changes_free) {
  return "<X3D version='4.0' profile='Full'><Scene><WorldInfo><MetadataSet containerField='metadata' "
         "name='mechane:scenario'><MetadataInteger containerField='value' name='format' value='1'/>"
         "<MetadataString containerField='value' name='id' value='\"coins\"'/>"
         "<MetadataString containerField='value' name='languages' value='\"en\"'/>"
         "<MetadataSet containerField='value' name='agents'><MetadataSet containerField='value' name='HOLD'>"
         "<MetadataString containerField='value' name='type' value='\"simulation.grasp\"'/>"
         "<MetadataString containerField='value' name='bodies' value='" +
         names +
         "'/></MetadataSet></MetadataSet>"
         "<MetadataSet containerField='value' name='quantities'>"
         "<MetadataString containerField='value' name='third' value='\"COIN-3.speed\"'/>"
         "<MetadataString containerField='value' name='last' value='\"COIN-6.position.y\"'/></MetadataSet>"
         "<MetadataSet containerField='value' name='activities'><MetadataSet containerField='value' name='fall'>"
         "<MetadataSet containerField='value' name='steps'><MetadataSet containerField='value' name='hang'>" +
         changes_still +
         "<MetadataDouble containerField='value' name='timeoutSeconds' value='0.3'/>"
         "<MetadataString containerField='value' name='timeoutNext' value='\"drop\"'/></MetadataSet>"
         "<MetadataSet containerField='value' name='drop'>" +
         changes_free +
         "</MetadataSet></MetadataSet></MetadataSet></MetadataSet></MetadataSet></WorldInfo>"
         "<RigidBodyCollection gravity='0 -9.81 0'>"
         "<RigidBody DEF='TABLE' containerField='bodies' fixed='true' position='0 0.7 0'>"
         "<CollidableShape containerField='geometry'><Shape containerField='shape'><Box size='1 0.1 0.6'/></Shape>"
         "</CollidableShape></RigidBody>\n" +
         coins + "</RigidBodyCollection></Scene></X3D>";
}

std::string movable(const std::string& body, bool value) {
  return fmt::format(
      "<MetadataSet containerField='value' name='object:{}'>"
      "<MetadataBoolean containerField='value' name='movable' value='{}'/></MetadataSet>",
      body, value);
}

std::string number(const std::string& key, const std::string& value) {
  return "<MetadataDouble containerField='value' name='" + key + "' value='" + value + "'/>";
}

class Coins {
 public:
  explicit Coins(const std::string& text) : loader_(folder_.path() / "cache") {
    x3d::Problems problems("coins.x3d");
    auto description = scenario::read_scenario(folder_.write("coins.x3d", text), loader_, problems);
    if (!description) throw std::runtime_error(description.error().to_string());
    WorldConfig config;
    config.hand = test::shared_hand();
    world_ = World::create(std::make_shared<const state::WorldDescription>(std::move(*description)), config).value();
  }
  void tick() { world::step(*world_, {}, publisher_, timer_); }
  [[nodiscard]] const state::WorldState& state() const { return world_->state; }
  [[nodiscard]] const state::WorldDescription& description() const { return *world_->description; }
  [[nodiscard]] int loaded() const { return loader_.loaded; }

 private:
  test::ScratchFolder folder_;
  ShapeLoader loader_;
  std::unique_ptr<World> world_;
  SystemClock clock_;
  PhaseTimer timer_{clock_};
  NoPublisher publisher_;
};

TEST(Copies, RunAsTheSameBodiesWrittenOutByHandToTheBit) {
  const Vec3 first_W(-0.11, 0.9, 0.07), step_W(0.05, 0.013, 0), row_W(0.013, 0.021, -0.047);
  std::string by_hand, names, still, free;
  for (int i = 0; i < 6; ++i) {
    const std::string name = fmt::format("COIN-{}", i + 1);
    by_hand += coin(name, first_W + (double(i % 3) * step_W + double(i / 3) * row_W), "");
    names += '"' + name + "\" ";
    still += movable(name, false);
    free += movable(name, true);
  }
  const std::string copies = "<MetadataSet containerField='value' name='copies'>" + number("count", "6") +
                             number("step", "0.05 0.013 0") + number("columns", "3") +
                             number("rowStep", "0.013 0.021 -0.047") + "</MetadataSet>";
  Coins one(exhibit(coin("COIN", first_W, copies), "\"COIN-*\"", movable("COIN-*", false), movable("COIN-*", true)));
  Coins many(exhibit(by_hand, names, still, free));
  EXPECT_EQ(one.loaded(), 2) << "their shape is made once";
  EXPECT_EQ(many.loaded(), 7);
  ASSERT_EQ(one.description().bodies.size(), many.description().bodies.size());
  for (std::size_t i = 0; i < one.description().bodies.size(); ++i)
    EXPECT_EQ(one.description().bodies[i].name, many.description().bodies[i].name);
  for (int tick = 0; tick < 2000; ++tick) {
    one.tick();
    many.tick();
    ASSERT_EQ(state::state_hash(one.state()), state::state_hash(many.state())) << "after tick " << tick;
  }
  EXPECT_EQ(one.state().quantities, many.state().quantities);
  // They have fallen, met the table and each other, and none is where another is.
  for (std::size_t i = 1; i <= 6; ++i) {
    EXPECT_GT(one.state().bodies[i].X_WB.p.y(), 0.74);
    EXPECT_LT(one.state().bodies[i].X_WB.p.y(), 0.85);
    EXPECT_EQ(one.description().bodies[i].object, one.description().bodies[1].object);
  }
}

}  // namespace
}  // namespace mechane::world
