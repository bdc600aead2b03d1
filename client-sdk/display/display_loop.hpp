// The display's loop: hears of a kiosk's world, draws it, lets it be heard, and does what visitors and technicians wish.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client-sdk/display/caption_room.hpp"
#include "client-sdk/display/display_app.hpp"
#include "client-sdk/display/head_view.hpp"
#include "client-sdk/display/kiosk_setup.hpp"
#include "client-sdk/display/window.hpp"
#include "client-sdk/pointer/pointer_input.hpp"
#include "client-sdk/scene/shown_world.hpp"
#include "client-sdk/sound/sound_captions.hpp"
#include "client-sdk/visit/subtitles.hpp"
#include "server/base/clock.hpp"

namespace mechane::display {

/// Two frames of a world that sends sixty a second: so late the picture is, and so smooth.
inline constexpr Duration kInterpolationDelay = std::chrono::milliseconds(33);

/// One display's life. Made and run on one thread.
class DisplayLoop {
 public:
  DisplayLoop(const DisplayOptions& options, DisplayRequests& requests, draw::GlContext& context, Window* window,
              std::unique_ptr<draw::Renderer> renderer, DisplaySource& source, const content::Catalogue* catalogue,
              std::unique_ptr<AttractLoop> attract)
      : options_(options),
        requests_(requests),
        context_(context),
        window_(window),
        renderer_(std::move(renderer)),
        source_(source),
        client_(*source.client),
        world_(open_assets(options, catalogue), options.language),
        head_(options.screen),
        attract_(std::move(attract)),
        desk_(client_, identity_of(options, context), settings_at_start(options), clock_.now()),
        panel_(panel_settings(desk_.settings())),
        spoken_(options.language) {
    forces_shown_ = options.forces;
    world_.show_forces(forces_shown_);
    if (options.touch && window != nullptr && source_.recorded == nullptr)
      pointer_.emplace(options.kiosk, options.domain);
  }

  Expected<DisplaySummary> run();

 private:
  [[nodiscard]] TimePoint now();
  [[nodiscard]] bool stop_wanted(TimePoint now) const;
  [[nodiscard]] bool finished() const;
  void take_news(TimePoint now);
  void tend_head(TimePoint now);
  void record(TimePoint now);
  void say_refusal();
  void say_stray();
  void say_unknown(TimePoint now);
  void make_room(picture::RenderScene& scene, TimePoint now);
  [[nodiscard]] bool is_there() const;
  Expected<void> draw(TimePoint now);
  Expected<void> survive(const Error& error);
  Expected<void> recover();
  Expected<std::unique_ptr<draw::Renderer>> begin_drawing();
  void let_hear(const picture::Camera& ears, TimePoint now);
  [[nodiscard]] picture::RenderScene build(TimePoint now) const;
  [[nodiscard]] std::string heard_in_writing(TimePoint now) const;
  void take_wishes(TimePoint now);
  void tend_kiosk(TimePoint now);
  void tend_attract(TimePoint now);
  void upload();
  void take_pointer(TimePoint now);
  void name_what_is_meant(picture::RenderScene& scene) const;
  [[nodiscard]] pointer::PointerScene under_pointer(const picture::RenderScene& scene) const;
  void tell_language();
  void take_key(DisplayKey key, TimePoint now);
  void take_click(picture::PixelPlace place, TimePoint now);
  [[nodiscard]] std::optional<picture::OverlayAction> pressed(picture::PixelPlace place) const;
  void click_object(picture::PixelPlace place, TimePoint now);
  [[nodiscard]] std::string picture_path(const std::string& name) const;
  Expected<void> write_picture(const std::string& name);
  void write_requested();
  void write_last();
  void wait_for_next(TimePoint began);

  const DisplayOptions& options_;
  DisplayRequests& requests_;
  draw::GlContext& context_;
  Window* window_;                            ///< the context's; null: offscreen
  std::unique_ptr<draw::Renderer> renderer_;  ///< of the context as it is now
  DisplaySource& source_;
  client::Client& client_;
  SystemClock clock_;
  scene::ShownWorld world_;
  bool forces_shown_ = false;
  HeadView head_;
  bool told_head_ = false;
  client::Frame frame_;
  bool have_frame_ = false;
  std::optional<DisplaySound> sound_;
  std::unique_ptr<AttractLoop> attract_;  ///< null: none
  bool attracts_ = false;
  KioskDesk desk_;
  std::optional<pointer::PointerInput> pointer_;
  visit::VisitorPanel panel_;
  std::string spoken_;  ///< the language that all others know of
  std::string told_language_;
  std::shared_ptr<const client::WorldPresentation> told_presentation_;  ///< of the world that was told it
  bool panel_shown_ = false;                                            ///< in the last picture
  CaptionRoom caption_room_;
  visit::Subtitles subtitles_;
  sound::WorldSounds sounds_;
  sound::SoundCaptions sound_captions_;
  std::string told_refusal_;
  std::string told_stray_;
  std::optional<TimePoint> unknown_since_;
  std::optional<std::uint32_t> told_unknown_;
  std::string told_draw_;
  PictureSchedule schedule_;
  std::optional<std::string> due_;
  bool last_picture_taken_ = false;
  std::uint32_t requested_pictures_ = 0;
  TimePoint started_;
  TimePoint next_;
  std::vector<double> frame_ms_;
  DisplaySummary summary_;
};

}  // namespace mechane::display
