#include "client-sdk/scene/shown_world.hpp"

#include <gtest/gtest.h>

#include "client-sdk/recording/recorded_client.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_folder.hpp"
#include "tests/unit/recording/recording_samples.hpp"

namespace mechane::scene {
namespace {

using std::chrono::milliseconds;

TEST(ShownWorld, BeforeAnythingIsKnownACalmNoteStandsInThePicture) {
  ShownWorld world(AssetSource{}, "en");
  EXPECT_FALSE(world.known());
  world.add_missing({"wall.glb"});
  EXPECT_EQ(world.status(), nullptr);
  EXPECT_EQ(world.missing(), nullptr);
  const picture::RenderScene scene = world.build(nullptr, client::LinkState::searching);
  EXPECT_FALSE(scene.overlay.note.empty());
  EXPECT_TRUE(scene.instances.empty());
}

TEST(ShownWorld, AnotherWorldBeginsAnewAndTheSameOneDoesNot) {
  const test::ScratchFolder empty;
  recording::RecordedClient client(recording::played({0, 40, 80, 120, 160}, 100), {});
  ShownWorld world(AssetSource{empty.path().string(), nullptr, nullptr}, "en");
  const TimePoint began(std::chrono::hours(7));
  client.advance(began);
  const ShownWorld::News first = world.hear(client);
  EXPECT_TRUE(first.another_world && first.assets && first.whole);
  ASSERT_TRUE(world.known());
  EXPECT_EQ(world.status()->world, "world-1");
  EXPECT_EQ(world.objects().size(), 2U);
  EXPECT_TRUE(world.missing()->contains("machine.glb")) << "boxes stand for what is not there";
  world.add_missing({"wall.glb, texture plaster"});
  EXPECT_TRUE(world.missing()->contains("wall.glb, texture plaster")) << "the graphics card had no room for it";
  client::Frame frame;
  ASSERT_TRUE(client.interpolated_frame(began, Duration{0}, frame));
  const picture::RenderScene scene = world.build(&frame, client::LinkState::joined);
  EXPECT_GE(scene.instances.size(), 2U);
  EXPECT_EQ(scene.overlay.title, "The well");
  world.set_language("el");
  EXPECT_EQ(world.build(&frame, client::LinkState::joined).overlay.title, "Το πηγάδι");

  client.advance(began + milliseconds(50));
  const ShownWorld::News same = world.hear(client);
  EXPECT_FALSE(same.another_world || same.assets);

  client.advance(began + milliseconds(130));
  const ShownWorld::News other = world.hear(client);
  EXPECT_TRUE(other.another_world && other.assets);
  EXPECT_EQ(world.status()->world, "world-2");
  EXPECT_EQ(world.presentation()->world, "world-2");
  EXPECT_EQ(world.build(nullptr, client::LinkState::joined).overlay.title, "Το πηγάδι") << "the language stays";
}

TEST(ShownWorld, APresentationThatComesAfterTheManifestMayBringMeshes) {
  recording::RecordingWriter writer;
  const auto at = [](int ms) { return Duration(milliseconds(ms)); };
  writer.add(recording::RecordKind::status, at(0), recording::encode(recording::status_of_visit("world-1", "turn")));
  client::SceneObject barrel;
  barrel.mesh_uri = "archimedes-screw.glb";
  barrel.mesh_node = "OUTER";
  writer.add(recording::RecordKind::manifest, at(0), recording::encode(std::vector{barrel}));
  writer.add(recording::RecordKind::frame, at(0), recording::encode(recording::frame_of_visit(1, at(0), {})));
  writer.add(recording::RecordKind::presentation, at(40),
             recording::encode(recording::presentation_of_visit("world-1")));
  writer.add(recording::RecordKind::frame, at(80), recording::encode(recording::frame_of_visit(2, at(80), {})));
  writer.add(recording::RecordKind::end, at(0), {});
  recording::RecordedClient client(recording::FrameRecording::open_bytes(writer.take_bytes(), "late").value(), {});
  ShownWorld world(AssetSource{mechane::test::source_folder().string() + "/scenarios/models", nullptr, nullptr}, "en");
  const TimePoint began(std::chrono::hours(7));
  client.advance(began);
  ASSERT_TRUE(world.hear(client).assets);
  ASSERT_TRUE(world.missing()->empty());
  ASSERT_EQ(world.presentation(), nullptr);
  EXPECT_FALSE(world.hear(client).assets);
  client.advance(began + milliseconds(60));
  EXPECT_TRUE(world.hear(client).assets) << "trees grow: what is drawn next must have been uploaded";
  EXPECT_NE(world.presentation(), nullptr);
  EXPECT_FALSE(world.hear(client).assets);
  client.rewind();
  client.advance(began + milliseconds(200));
  (void)world.hear(client);
  client.advance(began + milliseconds(300));
  const ShownWorld::News again = world.hear(client);
  EXPECT_FALSE(again.another_world || again.assets) << "an attract loop's second round brings nothing new";
}

TEST(ShownWorld, ForcesAreShownWhereTheyAreAskedForInEveryWorld) {
  const test::ScratchFolder empty;
  recording::RecordedClient client(recording::played({0, 40, 80, 120, 160}, 100), {});
  ShownWorld world(AssetSource{empty.path().string(), nullptr, nullptr}, "en");
  const TimePoint began(std::chrono::hours(7));
  const auto parts = [&](milliseconds at, bool shown) {
    client.advance(began + at);
    (void)world.hear(client);
    world.show_forces(shown);
    client::Frame frame;
    EXPECT_TRUE(client.interpolated_frame(began + at, Duration{0}, frame));
    return world.build(&frame, client::LinkState::joined).instances.size();
  };
  const std::size_t without = parts(milliseconds(0), false);
  EXPECT_EQ(parts(milliseconds(20), true), without + 2);
  EXPECT_EQ(parts(milliseconds(130), true), without + 2) << "the next world too";
  EXPECT_EQ(parts(milliseconds(140), false), without);
}

}  // namespace
}  // namespace mechane::scene
