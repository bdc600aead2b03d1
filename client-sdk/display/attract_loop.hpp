// What a display shows while nobody is there: a recorded visit, over and over, and an invitation. Only seen: nobody is asked anything, no hand
// feels anything, and the kiosk's own world goes on behind it.
#pragma once

#include <memory>
#include <string>

#include "client-sdk/recording/recorded_client.hpp"
#include "client-sdk/scene/shown_world.hpp"

namespace mechane::display {

/// On the display's thread. The renderer has room for one set of assets: who shows this uploads assets() whenever advance() says so.
class AttractLoop {
 public:
  /// Errors: those of FrameRecording.
  [[nodiscard]] static Expected<std::unique_ptr<AttractLoop>> open(const std::string& file, scene::AssetSource assets);
  AttractLoop(const AttractLoop&) = delete;
  AttractLoop& operator=(const AttractLoop&) = delete;

  /// From its beginning.
  void rewind() { recorded_.rewind(); }
  /// To what is seen at `now`. True where other assets are needed than before: all that was uploaded is to be forgotten.
  [[nodiscard]] bool advance(TimePoint now);
  /// Once advance() has said that there are any.
  [[nodiscard]] const picture::SceneAssets& assets() const { return world_.assets(); }
  /// With the invitation, first in `language`.
  [[nodiscard]] picture::RenderScene build(TimePoint now, const std::string& language,
                                           const picture::OverlayStyle& style);

 private:
  AttractLoop(recording::FrameRecording recording, scene::AssetSource assets);

  recording::RecordedClient recorded_;
  scene::ShownWorld world_;
};

}  // namespace mechane::display
