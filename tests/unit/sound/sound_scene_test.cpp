#include "client-sdk/sound/sound_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::sound {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

/// A crank and a basin, two frames 20 ms apart.
class SoundSceneTest : public testing::Test {
 protected:
  SoundSceneTest() {
    objects_.resize(2);
    objects_[0].index = 0;
    objects_[0].name = "crank";
    objects_[0].movable = true;
    objects_[1].index = 1;
    objects_[1].name = "basin";
    objects_[1].X_WB.p = Vec3(2, 0, 0);
    before_.tick = 1000;
    now_.tick = 1020;
    now_.bodies = {{0, {Vec3(0, 1, 0), Quat::Identity()}}};
    before_.bodies = now_.bodies;
    now_.visible = {1, 1};
    now_.quantities = {0.5};
  }
  std::vector<SoundSource> sources() { return sound_sources({&before_, &now_, events_, objects_, effects_}); }
  static SoundEffect effect(const char* kind, std::int32_t object, std::int32_t quantity, double full) {
    SoundEffect effect;
    effect.name = kind;
    effect.kind = kind;
    effect.object = object;
    effect.quantity = quantity;
    effect.full = full;
    return effect;
  }

  std::vector<client::SceneObject> objects_;
  client::Frame before_;
  client::Frame now_;
  std::vector<client::WorldEvent> events_;
  std::vector<SoundEffect> effects_;
};

TEST_F(SoundSceneTest, nothing_has_come_yet) {
  EXPECT_THAT(sound_sources({}), IsEmpty());
  EXPECT_THAT(sources(), IsEmpty());
}

TEST_F(SoundSceneTest, an_effect_sounds_at_its_object_as_loud_as_its_quantity) {
  effects_ = {effect("sound.water", 1, 0, 2)};
  effects_[0].p_B = Vec3(0, 0.5, 0);
  auto heard = sources();
  ASSERT_THAT(heard, SizeIs(1));
  EXPECT_EQ(heard[0].id, "effect sound.water");
  EXPECT_EQ(heard[0].kind, SoundKind::water);
  EXPECT_TRUE(heard[0].looped);
  EXPECT_DOUBLE_EQ(heard[0].gain, 0.25);
  EXPECT_LT((heard[0].p_W - Vec3(2, 0.5, 0)).norm(), 1e-12);
  now_.quantities = {9};
  EXPECT_DOUBLE_EQ(sources()[0].gain, 1);
  EXPECT_GT(sources()[0].pitch, heard[0].pitch);
  now_.quantities = {-1};
  EXPECT_DOUBLE_EQ(sources()[0].gain, 0.5) << "turned backwards";
  now_.quantities = {0};
  EXPECT_THAT(sources(), IsEmpty());
  now_.quantities = {std::nan("")};
  EXPECT_THAT(sources(), IsEmpty());
}

TEST_F(SoundSceneTest, each_effect_sounds_as_what_it_is_and_higher_the_more_there_is_of_it) {
  for (const auto& [kind, sound] :
       {std::pair("sound.water", SoundKind::water), std::pair("sound.wood", SoundKind::creak),
        std::pair("sound.rope", SoundKind::rope), std::pair("sound.stone", SoundKind::scrape),
        std::pair("sound.fire", SoundKind::fire), std::pair("sound.steam", SoundKind::steam),
        std::pair("sound.ratchet", SoundKind::ratchet)}) {
    effects_ = {effect(kind, 1, 0, 1)};
    now_.quantities = {0.1};
    ASSERT_THAT(sources(), SizeIs(1)) << kind;
    const SoundSource little = sources()[0];
    EXPECT_EQ(little.kind, sound) << kind;
    now_.quantities = {1};
    EXPECT_GT(sources()[0].pitch, 1.05 * little.pitch) << kind;
  }
  effects_ = {effect("sound.bow", 1, 0, 1), effect("sound.of-a-later-server", 1, 0, 1)};
  EXPECT_THAT(sources(), IsEmpty()) << "a string sounds when it is let go";
}

TEST_F(SoundSceneTest, an_effect_of_what_is_hidden_or_not_there_is_silent) {
  effects_ = {effect("sound.fire", 1, 0, 1), effect("sound.fire", 7, 0, 1), effect("sound.fire", 0, 4, 1),
              effect("smoke", 0, 0, 1), effect("sound.fire", 0, 0, 0)};
  now_.visible = {1, 0};
  EXPECT_THAT(sources(), IsEmpty());
  effects_[0].object = -1;
  EXPECT_THAT(sources(), SizeIs(1)) << "of no object: at its place in the world";
}

TEST_F(SoundSceneTest, without_a_quantity_motion_is_heard) {
  effects_ = {effect("sound.wood", 0, -1, 0.5)};
  effects_[0].p_B = Vec3(0.1, 0, 0);
  EXPECT_THAT(sources(), IsEmpty()) << "at rest";
  now_.bodies[0].X_WB.R = Quat(Eigen::AngleAxisd(0.04, Vec3::UnitZ()));  // 2 rad/s on a radius of 0.1 m
  ASSERT_THAT(sources(), SizeIs(1));
  EXPECT_NEAR(sources()[0].gain, 0.2 / 0.5, 1e-3);
  effects_[0].p_B = Vec3::Zero();
  effects_[0].size_m = 0.2;
  EXPECT_NEAR(sources()[0].gain, 0.4 / 0.5, 1e-3) << "an axle's own place does not move; its rim does";
  before_.tick = 100;
  EXPECT_THAT(sources(), IsEmpty()) << "the display was held up: no speed is known";
}

TEST_F(SoundSceneTest, events_sound_once_where_their_object_is) {
  events_ = {{1020, "grasped", "kiosk-1/0", "crank", 0},
             {1020, "placed", "socket", "crank", 0},
             {1020, "step_started", "turn", "", 0}};
  const auto heard = sources();
  ASSERT_THAT(heard, SizeIs(2));
  EXPECT_FALSE(heard[0].looped);
  EXPECT_EQ(heard[0].p_W, Vec3(0, 1, 0));
  EXPECT_LT(heard[0].gain, heard[1].gain);
  EXPECT_NE(heard[0].id, heard[1].id);
  EXPECT_EQ(sources()[0].id, heard[0].id);
}

TEST_F(SoundSceneTest, a_shot_is_heard_where_the_string_is) {
  events_ = {{1020, "fired", "trigger", "crank", 0}};
  ASSERT_THAT(sources(), SizeIs(1));
  EXPECT_EQ(sources()[0].kind, SoundKind::bow);
  EXPECT_EQ(sources()[0].p_W, Vec3(0, 1, 0));
  effects_ = {effect("sound.bow", -1, -1, 1)};
  effects_[0].p_B = Vec3(5, 5, 5);
  ASSERT_THAT(sources(), SizeIs(1));
  EXPECT_EQ(sources()[0].p_W, Vec3(5, 5, 5));
}

TEST_F(SoundSceneTest, a_spill_splashes_by_its_amount_where_the_water_is) {
  effects_ = {effect("sound.water", 1, 0, 1e9)};
  events_ = {{1020, "spilled", "screw", "", 0.0005}};
  ASSERT_THAT(sources(), SizeIs(1));
  EXPECT_EQ(sources()[0].kind, SoundKind::splash);
  EXPECT_NEAR(sources()[0].gain, 0.5, 1e-9);
  EXPECT_EQ(sources()[0].p_W, Vec3(2, 0, 0));
  events_[0].value = 0;
  EXPECT_THAT(sources(), IsEmpty());
}

RC_GTEST_PROP(SoundScene, whatever_comes_is_within_bounds, ()) {
  client::Frame before;
  client::Frame now;
  const auto number = [] { return *rc::gen::arbitrary<double>(); };
  now.tick = *rc::gen::arbitrary<std::uint64_t>();
  before.tick = *rc::gen::arbitrary<std::uint64_t>();
  now.quantities = {number(), number()};
  std::vector<client::SceneObject> objects(1);
  objects[0].X_WB.p = Vec3(number(), number(), number());
  now.bodies = {{0, {Vec3(number(), 0, 0), Quat::Identity()}}};
  std::vector<SoundEffect> effects(3);
  for (SoundEffect& effect : effects) {
    effect.kind =
        *rc::gen::elementOf(std::vector<std::string>{"sound.water", "sound.bow", "sound.ratchet", "fire", ""});
    effect.object = *rc::gen::inRange(-2, 3);
    effect.quantity = *rc::gen::inRange(-2, 4);
    effect.full = number();
    effect.size_m = *rc::gen::inRange(0, 10);
    effect.p_B = Vec3(number(), 0, 0);
  }
  const std::vector<client::WorldEvent> events{
      {1, *rc::gen::element<std::string>("spilled", "fired", "placed"), "", "", number()}};
  for (const SoundSource& source : sound_sources({&before, &now, events, objects, effects})) {
    RC_ASSERT(source.gain >= 0 && source.gain <= 1);
    RC_ASSERT(source.pitch >= 0.5 && source.pitch <= 2);
    RC_ASSERT(source.p_W.allFinite());
  }
}

}  // namespace
}  // namespace mechane::sound
