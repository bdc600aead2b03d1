// What a display shows while nobody is there: a recorded visit, over and over, and an invitation. Only seen: nobody is asked anything, no hand
// feels anything, and the kiosk's own world goes on behind it.
#pragma once

#include <memory>
#include <string>

#include "client-sdk/display/asset_store.hpp"
#include "client-sdk/display/mesh_files.hpp"
#include "client-sdk/display/recorded_client.hpp"
#include "client-sdk/display/scene_builder.hpp"

namespace mechane::display {

/// Where its mesh files are, as for a display's worlds.
struct AttractAssets {
  std::string folder;                             ///< empty: the scenario's folder, as the recording's server saw it
  std::unique_ptr<AssetStore> store;              ///< in its place; may be null
  const content::Catalogue* catalogue = nullptr;  ///< may be null; outlives the loop
};

/// On the display's thread. The renderer has room for one set of assets: who shows this uploads assets() whenever advance() says so.
class AttractLoop {
 public:
  /// Errors: those of FrameRecording.
  [[nodiscard]] static Expected<std::unique_ptr<AttractLoop>> open(const std::string& file, AttractAssets assets);
  AttractLoop(const AttractLoop&) = delete;
  AttractLoop& operator=(const AttractLoop&) = delete;

  /// From its beginning.
  void rewind() { recorded_.rewind(); }
  /// To what is seen at `now`. True where other assets are needed than before: all that was uploaded is to be forgotten.
  [[nodiscard]] bool advance(TimePoint now);
  [[nodiscard]] const SceneAssets& assets() const { return library_->assets(); }
  /// With the invitation, first in `language`.
  [[nodiscard]] RenderScene build(TimePoint now, const std::string& language, const OverlayStyle& style);

 private:
  AttractLoop(FrameRecording recording, AttractAssets assets);
  void begin_world(const client::WorldStatus& status);

  AttractAssets assets_;
  RecordedClient recorded_;
  std::unique_ptr<MeshFiles> mesh_files_;
  std::unique_ptr<AssetLibrary> library_;
  std::unique_ptr<SceneBuilder> builder_;
  std::string world_;
  std::shared_ptr<const client::WorldPresentation> presentation_;
  std::vector<client::SceneObject> objects_;
};

}  // namespace mechane::display
