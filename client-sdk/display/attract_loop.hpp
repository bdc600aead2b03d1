// What a display shows while nobody is there: a recorded visit in a loop, and an invitation. It is only shown: no
// questions, no forces; the kiosk's own world continues behind it.
#pragma once

#include <memory>
#include <string>

#include "client-sdk/recording/recorded_client.hpp"
#include "client-sdk/scene/shown_world.hpp"

namespace mechane::display {

/// On the display's thread. The renderer holds one set of assets: upload assets() whenever advance() says so.
class AttractLoop {
 public:
  /// Errors: those of FrameRecording.
  [[nodiscard]] static Expected<std::unique_ptr<AttractLoop>> open(const std::string& file, scene::AssetSource assets);
  AttractLoop(const AttractLoop&) = delete;
  AttractLoop& operator=(const AttractLoop&) = delete;

  /// Starts from the beginning.
  void rewind() { recorded_.rewind(); }
  void show_hands(scene::HandLook look) { world_.show_hands(look); }
  /// Advances to `now`. True when other assets are needed than before: everything that was uploaded is to be replaced.
  [[nodiscard]] bool advance(TimePoint now);
  /// Only after advance() has returned true.
  [[nodiscard]] const picture::SceneAssets& assets() const { return world_.assets(); }
  /// The scene with the invitation, first in `language`.
  [[nodiscard]] picture::RenderScene build(TimePoint now, const std::string& language,
                                           const picture::OverlayStyle& style);

 private:
  AttractLoop(recording::FrameRecording recording, scene::AssetSource assets);

  recording::RecordedClient recorded_;
  scene::ShownWorld world_;
};

}  // namespace mechane::display
