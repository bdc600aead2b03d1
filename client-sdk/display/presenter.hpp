// Draws what a display shows: composes the scene with its words, draws it, and starts again after the graphics driver was reset
// and all that it held is lost.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client-sdk/display/caption_history.hpp"
#include "client-sdk/display/caption_room.hpp"
#include "client-sdk/display/display_app.hpp"
#include "client-sdk/display/last_picture.hpp"
#include "client-sdk/display/news.hpp"
#include "client-sdk/display/phone_code.hpp"
#include "client-sdk/display/soundtrack.hpp"
#include "client-sdk/display/visitor.hpp"
#include "client-sdk/display/window.hpp"
#include "client-sdk/draw/draw_timer.hpp"
#include "client-sdk/scene/step_view.hpp"
#include "server/base/clock.hpp"

namespace mechane::display {

/// On the display's thread, which is the context's. The constructor's arguments must outlive it.
class Presenter {
 public:
  /// `window` is the context's, null offscreen. `renderer` is made in the context as it is now.
  Presenter(const DisplayOptions& options, const DisplaySignals& signals, draw::GlContext& context, Window* window,
            std::unique_ptr<draw::Renderer> renderer, News& news, const Visitor& visitor, const PhoneCode& code);

  /// Frees everything that was uploaded, and uploads what is shown now.
  void replace_assets();
  /// Uploads what is new in what is shown now.
  void upload();

  /// The world's scene with its camera, without words.
  [[nodiscard]] picture::RenderScene world_scene() const;
  /// Draws and shows one picture, with its sound. Returns the time that it took; none: nothing was drawn, because the
  /// window has no pixels or the graphics card was lost. Errors: the graphics card does not come back; offscreen, no
  /// memory for this size.
  [[nodiscard]] Expected<std::optional<Duration>> draw(TimePoint now);

  [[nodiscard]] LastPicture last_picture() const;
  [[nodiscard]] picture::ImageData read_picture() const { return renderer_->read_picture(); }
  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  /// The times of the first 20 000 frames.
  [[nodiscard]] const std::vector<double>& frame_ms() const { return frame_ms_; }
  /// From the next picture on; a name as in DisplayOptions::quality. Errors: the driver rejects what measures.
  [[nodiscard]] Expected<void> set_quality(const std::string& name);
  [[nodiscard]] Soundtrack& soundtrack() { return soundtrack_; }

 private:
  void follow_work(const picture::RenderScene& scene, TimePoint now);
  void place_camera(picture::RenderScene& scene) const;
  [[nodiscard]] picture::RenderScene compose(TimePoint now);
  void name_what_is_meant(picture::RenderScene& scene) const;
  void make_room(picture::RenderScene& scene, TimePoint now);
  void keep_words_off(picture::RenderScene& scene, TimePoint now);
  [[nodiscard]] Expected<void> draw_measured(const picture::RenderScene& scene, picture::PixelSize size, TimePoint now);
  void hear(const picture::Camera& ears, TimePoint now);
  [[nodiscard]] bool shows_live_world() const;
  [[nodiscard]] Expected<void> survive(const Error& error);
  [[nodiscard]] Expected<void> recover();
  [[nodiscard]] Expected<std::unique_ptr<draw::Renderer>> begin_drawing();

  const DisplayOptions& options_;
  const DisplaySignals& signals_;
  draw::GlContext& context_;
  Window* window_;
  std::unique_ptr<draw::Renderer> renderer_;       ///< in the present context
  std::string quality_;                            ///< its name, or auto
  std::optional<draw::QualityGovernor> governor_;  ///< with auto, in a window
  std::optional<draw::DrawTimer> timer_;           ///< likewise
  News& news_;
  const Visitor& visitor_;
  const PhoneCode& code_;
  SystemClock clock_;
  Soundtrack soundtrack_;
  CaptionRoom caption_room_;
  CaptionHistory caption_history_;
  scene::StepView step_view_;
  bool panel_shown_ = false;  ///< in the last picture
  std::string told_draw_;
  std::uint64_t frames_ = 0;
  std::vector<double> frame_ms_;
};

}  // namespace mechane::display
