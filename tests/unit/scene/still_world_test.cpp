// Nothing is animated by the display: when the server falls silent in mid-motion, all that it draws stands still.
#include <bit>

#include <gtest/gtest.h>

#include "client-sdk/client/frame_history.hpp"
#include "client-sdk/picture/procedural_mesh.hpp"
#include "client-sdk/scene/scene_builder.hpp"
#include "tests/unit/recording/recording_samples.hpp"

namespace mechane::scene {
namespace {

using std::chrono::milliseconds;

/// Every number and word of a scene that a picture depends on.
struct SceneNumbers {
  std::vector<std::uint64_t> bits;
  std::vector<std::string> words;

  void add(double number) { bits.push_back(std::bit_cast<std::uint64_t>(number)); }
  template <class Matrix>
  void add_all(const Matrix& matrix) {
    for (Eigen::Index i = 0; i < matrix.size(); ++i)
      add(static_cast<double>(matrix.data()[i]));
  }
  bool operator==(const SceneNumbers&) const = default;
};

SceneNumbers numbers_of(const picture::RenderScene& scene) {
  SceneNumbers out;
  for (const picture::Instance& instance : scene.instances)
    out.add_all(instance.X_WM.matrix());
  for (const picture::WaterInstance& water : scene.waters)
    out.add_all(water.X_WM.matrix());
  for (const picture::WaterStream& stream : scene.streams) {
    out.add_all(stream.p_WS);
    out.add_all(stream.v_W);
    out.add(static_cast<double>(stream.width_m));
    out.add(static_cast<double>(stream.landing_height_m));
  }
  for (const picture::RenderRope& rope : scene.ropes) {
    for (const Vec3f& p_W : rope.points_W)
      out.add_all(p_W);
  }
  for (const picture::ParticleEffect& effect : scene.effects) {
    out.add_all(effect.p_W);
    out.add(static_cast<double>(effect.intensity));
  }
  for (const picture::Occluder& occluder : scene.occluders)
    out.add_all(occluder.p_WO);
  out.add_all(scene.camera.p_WC);
  out.add_all(scene.camera.p_WT);
  out.add(scene.time_s);
  for (const picture::Readout& readout : scene.overlay.readouts)
    out.words.insert(out.words.end(), {readout.label, readout.value, readout.unit, readout.end});
  return out;
}

AssetLibrary well_library() {
  return AssetLibrary([](const std::string&) -> Expected<content::ImportedScene> {
    content::ImportedScene scene;
    scene.materials.resize(1);
    for (const auto& [name, mesh] : {std::pair{"OUTER", picture::box_mesh(Vec3(0.1, 0.1, 1))},
                                     std::pair{"WATER_BASIN", picture::disc_mesh(0.3, 8)}}) {
      content::ImportedMesh imported;
      imported.positions = mesh.positions;
      imported.normals = mesh.normals;
      imported.indices = mesh.indices;
      scene.meshes.push_back(imported);
      content::ImportedNode node;
      node.name = name;
      node.meshes = {static_cast<std::uint32_t>(scene.meshes.size() - 1)};
      scene.nodes.push_back(node);
    }
    return scene;
  });
}

/// A display of a well whose server sends for a second, and then no more.
class StillWorld : public testing::Test {
 protected:
  StillWorld() : builder_(library_, "en") {
    builder_.set_manifest(recording::manifest_of_visit());
    auto presentation = std::make_shared<client::WorldPresentation>(recording::presentation_of_visit("w"));
    client::Effect spout;
    spout.kind = "stream";
    spout.object = 1;
    spout.quantity = 1;
    spout.speed_m_per_s = 0.5;
    presentation->effects.push_back(spout);
    builder_.set_presentation(presentation);
    for (int i = 0; i <= 60; ++i) {
      const Duration at = i * milliseconds(1000) / 60;
      history_.add(recording::frame_of_visit(static_cast<std::uint64_t>(i + 1), at, kBegan + at),
                   static_cast<std::uint64_t>(at.count()));
    }
  }
  picture::RenderScene seen(TimePoint now) {
    client::Frame frame;
    EXPECT_TRUE(history_.at(now - kDelay, frame));
    return builder_.build(&frame, &status_, client::LinkState::joined);
  }
  static constexpr TimePoint kBegan = TimePoint(std::chrono::hours(3));
  static constexpr TimePoint kSilent = kBegan + std::chrono::seconds(1);
  static constexpr Duration kDelay = milliseconds(33);
  AssetLibrary library_ = well_library();
  SceneBuilder builder_;
  client::FrameHistory history_;
  client::WorldStatus status_ = recording::status_of_visit("w", "turn");
};

TEST_F(StillWorld, crank_rope_and_water_move_while_frames_come) {
  const picture::RenderScene before = seen(kBegan + milliseconds(800));
  const picture::RenderScene after = seen(kBegan + milliseconds(816));
  ASSERT_EQ(before.waters.size(), 1U);
  ASSERT_EQ(before.ropes.size(), 1U);
  ASSERT_EQ(before.streams.size(), 1U);
  EXPECT_NE(before.instances[0].X_WM.matrix(), after.instances[0].X_WM.matrix()) << "the crank";
  EXPECT_NE(before.waters[0].X_WM.matrix(), after.waters[0].X_WM.matrix());
  EXPECT_NE(before.ropes[0].points_W, after.ropes[0].points_W);
  EXPECT_NE(before.streams[0].p_WS, after.streams[0].p_WS);
  EXPECT_NE(before.time_s, after.time_s);
}

TEST_F(StillWorld, all_stands_still_when_none_come_to_the_last_bit) {
  const TimePoint still = kSilent + kDelay + client::FrameHistory::kExtrapolateAtMost;
  const SceneNumbers first = numbers_of(seen(still));
  ASSERT_GT(first.bits.size(), 50U);
  EXPECT_NE(numbers_of(seen(still - milliseconds(10))), first) << "until then it went on as it was going";
  for (int picture = 0; picture < 600; ++picture)
    ASSERT_EQ(numbers_of(seen(still + picture * milliseconds(1000) / 60)), first) << picture;
  // No farther than fifty milliseconds of its speed beyond what the server last said: the bucket rises half a metre a second.
  const float said = 0.5F;
  EXPECT_LE(seen(still).instances[1].X_WM.translation().y(), said + 0.5F * 0.051F);
}

}  // namespace
}  // namespace mechane::scene
