// While files are read and trees grow, pictures go on; then the scene is the one that a display without a worker has at once.
#include <gtest/gtest.h>

#include "client-sdk/recording/recorded_client.hpp"
#include "client-sdk/scene/shown_world.hpp"
#include "tests/support/held_worker.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_folder.hpp"
#include "tests/unit/recording/recording_samples.hpp"

namespace mechane::scene {
namespace {

using std::chrono::milliseconds;

constexpr TimePoint kHeardFirst(std::chrono::hours(7));

/// A world with a model that stands on earth, about which trees grow.
recording::FrameRecording screw_on_earth() {
  recording::RecordingWriter writer;
  const Duration now{0};
  writer.add(recording::RecordKind::status, now, recording::encode(recording::status_of_visit("world-1", "turn")));
  client::SceneObject barrel;
  barrel.mesh_uri = "archimedes-screw.glb";
  barrel.mesh_node = "OUTER";
  barrel.title = {{"en", "The barrel"}};
  writer.add(recording::RecordKind::manifest, now, recording::encode(std::vector{barrel}));
  writer.add(recording::RecordKind::presentation, now, recording::encode(recording::presentation_of_visit("world-1")));
  writer.add(recording::RecordKind::frame, now, recording::encode(recording::frame_of_visit(1, now, {})));
  writer.add(recording::RecordKind::end, now, {});
  return recording::FrameRecording::open_bytes(writer.take_bytes(), "screw").value();
}

std::string models() {
  return mechane::test::source_folder().string() + "/scenarios/models";
}

TEST(BesideDrawing, PicturesGoOnUntilTheFilesAreReadAndTheTreesHaveGrown) {
  recording::RecordedClient client(screw_on_earth(), {});
  client.advance(kHeardFirst);
  ShownWorld at_once(AssetSource{models(), nullptr}, "en");
  ASSERT_TRUE(at_once.hear(client).whole);
  const picture::RenderScene wanted = at_once.build(nullptr, client::LinkState::joined);
  ASSERT_FALSE(wanted.named.empty());

  test::HeldWorker held;
  ShownWorld world(AssetSource{models(), nullptr, nullptr, held.get()}, "en");
  EXPECT_TRUE(world.hear(client).another_world);
  for (int picture = 0; picture < 20; ++picture) {
    const ShownWorld::News news = world.hear(client);
    EXPECT_FALSE(news.another_world || news.assets || news.whole);
    const picture::RenderScene scene = world.build(nullptr, client::LinkState::joined);
    EXPECT_TRUE(scene.instances.empty() && scene.named.empty());
    EXPECT_TRUE(scene.ground_height_m) << "one stands on something";
    EXPECT_FALSE(scene.overlay.note.empty()) << "and reads why there is nothing";
    EXPECT_EQ(scene.overlay.title, picture % 2 == 0 ? "The well" : "Το πηγάδι") << "what a visitor does counts";
    EXPECT_EQ(scene.camera.p_WC, wanted.camera.p_WC);
    world.set_language(picture % 2 == 0 ? "el" : "en");
  }
  EXPECT_TRUE(world.missing()->empty()) << "what is on its way is not missing";

  held.let_go_and_wait();
  EXPECT_TRUE(world.hear(client).assets);
  EXPECT_FALSE(world.build(nullptr, client::LinkState::joined).named.empty()) << "the model is there";
  held.let_go_and_wait();
  (void)world.hear(client);
  const ShownWorld::News last = world.hear(client);
  EXPECT_TRUE(last.whole && !last.assets);
  const picture::RenderScene scene = world.build(nullptr, client::LinkState::joined);
  EXPECT_EQ(scene.instances.size(), wanted.instances.size()) << "with the trees";
  EXPECT_EQ(world.assets().meshes.size(), at_once.assets().meshes.size());
  ASSERT_EQ(world.assets().images.size(), at_once.assets().images.size());
  for (std::size_t i = 0; i < world.assets().images.size(); ++i)
    EXPECT_EQ(world.assets().images[i].rgba, at_once.assets().images[i].rgba) << i;
  EXPECT_TRUE(scene.overlay.note.empty());
}

TEST(BesideDrawing, WhatIsMissingIsABoxAndIsTold) {
  const test::ScratchFolder empty;
  recording::RecordedClient client(recording::played({0, 40}), {});
  client.advance(kHeardFirst);
  test::HeldWorker held;
  ShownWorld world(AssetSource{empty.path().string(), nullptr, nullptr, held.get()}, "en");
  EXPECT_FALSE(world.hear(client).whole);
  client::Frame frame;
  ASSERT_TRUE(client.interpolated_frame(kHeardFirst, Duration{0}, frame));
  (void)world.build(&frame, client::LinkState::joined);
  EXPECT_FALSE(world.unknown()) << "its bodies are known, and not yet seen";
  held.let_go_and_wait();
  EXPECT_TRUE(world.hear(client).whole);
  EXPECT_TRUE(world.missing()->contains("machine.glb"));
  EXPECT_GE(world.build(&frame, client::LinkState::joined).instances.size(), 2U);
}

TEST(BesideDrawing, AnotherWorldDoesNotWaitForTheFilesOfTheOneBefore) {
  const test::ScratchFolder empty;
  recording::RecordedClient client(recording::played({0, 40, 80, 120, 160}, 100), {});
  client.advance(kHeardFirst);
  test::HeldWorker held;
  {
    ShownWorld world(AssetSource{empty.path().string(), nullptr, nullptr, held.get()}, "en");
    EXPECT_FALSE(world.hear(client).whole);
    client.advance(kHeardFirst + milliseconds(130));
    EXPECT_TRUE(world.hear(client).another_world);
    held.let_go_and_wait();
    EXPECT_TRUE(world.hear(client).whole);
    EXPECT_EQ(world.status()->world, "world-2");
    EXPECT_EQ(*world.missing(), (std::set<std::string>{"machine.glb"}));
  }
  test::HeldWorker held_to_the_end;
  {
    ShownWorld world(AssetSource{empty.path().string(), nullptr, nullptr, held_to_the_end.get()}, "en");
    EXPECT_FALSE(world.hear(client).whole);
  }
  held_to_the_end.let_go_and_wait();  // nothing uses the world that has gone
}

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n";

TEST(MeshImporter, ReadsAFileAgainThatWasMissing) {
  const test::ScratchFolder folder;
  test::HeldWorker held;
  MeshImporter importer(assets::MeshFiles(folder.path(), nullptr), held.get());
  EXPECT_FALSE(importer.busy());
  importer.want("late.obj", "");
  importer.want("late.obj", "");
  importer.want_again("another.obj");  // which nobody wanted
  EXPECT_TRUE(importer.busy());
  held.let_go_and_wait();
  EXPECT_FALSE(importer.busy());
  EXPECT_FALSE(importer.take("late.obj"));
  folder.write("late.obj", kTriangle);
  importer.want_again("late.obj");
  held.let_go_and_wait();
  const auto file = importer.take("late.obj");
  ASSERT_TRUE(file) << file.error().to_string();
  EXPECT_EQ(file->scene.meshes.size(), 1U);
  EXPECT_FALSE(importer.busy());
}

TEST(MeshImporter, WithoutAWorkerItReadsWhenAFileIsTaken) {
  const test::ScratchFolder folder;
  folder.write("here.obj", kTriangle);
  MeshImporter importer(assets::MeshFiles(folder.path(), nullptr), nullptr);
  importer.want("here.obj", "00000000000000000000000000000000");
  EXPECT_FALSE(importer.busy());
  EXPECT_TRUE(importer.take("here.obj"));
  EXPECT_TRUE(importer.differing().contains("here.obj"));
}

}  // namespace
}  // namespace mechane::scene
