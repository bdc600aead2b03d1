// What a display hears from its client: the world, its newest frame, the visitor's head. It also records this, and
// logs what a technician must know.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client-sdk/display/display_app.hpp"
#include "client-sdk/display/head_view.hpp"
#include "client-sdk/scene/shown_world.hpp"
#include "client-sdk/visit/calibration_guide.hpp"
#include "client-sdk/visit/device_notice.hpp"

namespace mechane::display {

/// The picture's delay: two frames at 60 frames per second, for smooth interpolation.
inline constexpr Duration kInterpolationDelay = std::chrono::milliseconds(33);

/// On the display's thread. `options` and `source` must outlive it.
class News {
 public:
  News(const DisplayOptions& options, DisplaySource& source, scene::AssetSource assets)
      : source_(source),
        client_(*source.client),
        knows_screen_(options.screen.known()),
        world_(std::move(assets), options.language),
        head_(options.screen) {}

  /// Takes the current status, manifest, frame and head, and the state of the haptic devices;
  /// records all but the head and the devices. Call it once a picture.
  [[nodiscard]] scene::ShownWorld::News take(TimePoint now);
  /// What happened since the last call; recorded too.
  [[nodiscard]] std::vector<client::WorldEvent> take_events(TimePoint now);
  /// After a scene was built: logs what it had to leave out.
  void tell_what_is_not_drawn(TimePoint now);

  [[nodiscard]] scene::ShownWorld& world() { return world_; }
  [[nodiscard]] const scene::ShownWorld& world() const { return world_; }
  /// Null before this world's first frame. While the link is down, the last frame stays.
  [[nodiscard]] const client::Frame* frame() const { return frame_ ? &*frame_ : nullptr; }
  /// See HeadView::place().
  [[nodiscard]] const picture::HeadPlace* head() const { return head_.place(); }
  /// What the visitor is told of the kiosk's haptic device; none: all is well.
  [[nodiscard]] std::optional<picture::OverlayNotice> device_notice(TimePoint now, const std::string& language) const {
    return devices_.at(now, language);
  }
  /// What the visitor is shown while a glove is fitted to the hand.
  [[nodiscard]] const visit::CalibrationGuide& calibration() const { return calibration_; }
  /// Whether the server is sending this world at the moment.
  [[nodiscard]] bool live() const { return frame_ && client_.state() == client::LinkState::joined; }
  /// Whether the world's last activity is done.
  [[nodiscard]] bool finished() const;
  /// Whether a recording was played to its end.
  [[nodiscard]] bool over() const { return source_.recorded != nullptr && source_.recorded->over(); }
  [[nodiscard]] client::Client& client() const { return client_; }

 private:
  void take_head(TimePoint now);
  void record(TimePoint now);
  void tell_refusal();

  DisplaySource& source_;
  client::Client& client_;
  bool knows_screen_;
  scene::ShownWorld world_;
  HeadView head_;
  visit::DeviceNotice devices_;
  visit::CalibrationGuide calibration_;
  std::optional<client::Frame> frame_;
  // What has been logged.
  bool told_head_ = false;
  std::string told_refusal_;
  std::string told_stray_;
  std::optional<TimePoint> unknown_since_;
  std::optional<std::uint32_t> told_unknown_;
};

}  // namespace mechane::display
