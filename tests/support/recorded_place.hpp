// One of the nine places with its meshes, at the four moments of a visit that tests/golden/scenes keeps of it, a second apart.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "client-sdk/assets/mesh_files.hpp"
#include "client-sdk/recording/recorded_client.hpp"
#include "client-sdk/scene/asset_library.hpp"
#include "client-sdk/scene/scene_builder.hpp"
#include "server/content/mesh_import.hpp"
#include "tests/support/source_folder.hpp"

namespace mechane::test {

class RecordedPlace {
 public:
  explicit RecordedPlace(const std::string& name)
      : client_(
            recording::FrameRecording::open_file(source_folder() / "tests/golden/scenes" / (name + ".frames")).value(),
            {}),
        files_(source_folder() / "scenarios" / name, nullptr),
        library_([this](const std::string& uri) -> Expected<content::ImportedScene> {
          const auto file = files_.find(uri);
          if (!file) return tl::unexpected(file.error());
          return content::import_mesh(*file);
        }),
        builder_(library_, "en") {
    client_.advance(TimePoint{});
    builder_.set_presentation(client_.presentation());
    builder_.set_manifest(client_.objects());
    EXPECT_TRUE(library_.missing().empty()) << *library_.missing().begin();
  }
  RecordedPlace(const RecordedPlace&) = delete;  // the library asks this place for its files
  RecordedPlace& operator=(const RecordedPlace&) = delete;

  /// Seen at that shape of the picture. Moments rise, or begin again at 0.
  picture::RenderScene scene(int moment, double aspect) {
    if (moment == 0) client_.rewind();
    client_.advance(TimePoint{} + moment * std::chrono::seconds(1));
    EXPECT_TRUE(client_.newest_frame(frame_));  // nothing of the next moment's
    const auto status = client_.world_status();
    picture::RenderScene out = builder_.build(&frame_, &*status, client_.state());
    out.camera = picture::for_screen(out.camera, {}, nullptr, aspect);
    return out;
  }
  /// Of the last scene.
  [[nodiscard]] const client::Frame& frame() const { return frame_; }
  [[nodiscard]] const client::Client& client() const { return client_; }
  [[nodiscard]] scene::AssetLibrary& library() { return library_; }
  [[nodiscard]] const picture::SceneAssets& assets() const { return library_.assets(); }

 private:
  recording::RecordedClient client_;
  assets::MeshFiles files_;
  scene::AssetLibrary library_;
  scene::SceneBuilder builder_;
  client::Frame frame_;
};

}  // namespace mechane::test
