// The display's loop: one picture after another. What is heard, what the visitor does, and what is drawn are three classes; here stands in
// which order they are called, when a picture is written, and when the display ends.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "client-sdk/display/display_app.hpp"
#include "client-sdk/display/kiosk_desk.hpp"
#include "client-sdk/display/news.hpp"
#include "client-sdk/display/picture_folder.hpp"
#include "client-sdk/display/presenter.hpp"
#include "client-sdk/display/visitor.hpp"
#include "server/base/clock.hpp"

namespace mechane::display {

/// One display's life. Made and run on one thread. What is given to the constructor outlives it.
class DisplayLoop {
 public:
  /// `window` is the context's, null offscreen. `catalogue`, `worker` and `attract` may be null. The worker brings what worlds look like; without
  /// one, drawing waits for that.
  DisplayLoop(const DisplayOptions& options, DisplaySignals& signals, draw::GlContext& context, Window* window,
              std::unique_ptr<draw::Renderer> renderer, DisplaySource& source, const content::Catalogue* catalogue,
              Worker* worker, std::unique_ptr<AttractLoop> attract);

  [[nodiscard]] Expected<DisplaySummary> run();

 private:
  [[nodiscard]] bool draws_recorded_steps() const;
  [[nodiscard]] TimePoint now();
  [[nodiscard]] bool stop_wanted(TimePoint now) const;
  void take_news(TimePoint now);
  void take_visitor(TimePoint now);
  void tend_kiosk(TimePoint now);
  [[nodiscard]] Expected<void> show(TimePoint now);
  void take_pictures(bool requested);
  [[nodiscard]] Expected<void> answer(const std::vector<PictureFolder::Written>& pictures);
  void wait_for_next(TimePoint began);
  [[nodiscard]] Expected<DisplaySummary> sum_up();

  const DisplayOptions& options_;
  DisplaySignals& signals_;
  draw::GlContext& context_;
  Window* window_;
  SystemClock clock_;
  News news_;
  Visitor visitor_;
  Presenter presenter_;
  KioskDesk desk_;
  PictureSchedule schedule_;
  std::optional<std::string> due_;  ///< name of a picture of this step
  bool last_picture_taken_ = false;
  bool whole_ = true;        ///< nothing of the scene is on its way here
  Duration waited_{0};       ///< for what is
  std::uint64_t turns_ = 0;  ///< of the loop, while the steps of a recording are drawn
  PictureFolder folder_;
  TimePoint started_;
  TimePoint next_;
  DisplaySummary summary_;
};

}  // namespace mechane::display
