// The display's loop: one picture after another. It calls the classes for news, visitor and drawing in order, and
// decides when a picture is written and when the display ends.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "client-sdk/display/display_app.hpp"
#include "client-sdk/display/kiosk_desk.hpp"
#include "client-sdk/display/news.hpp"
#include "client-sdk/display/phone_code.hpp"
#include "client-sdk/display/picture_folder.hpp"
#include "client-sdk/display/presenter.hpp"
#include "client-sdk/display/visitor.hpp"
#include "server/base/clock.hpp"

namespace mechane::display {

/// One display. Made and run on one thread. The constructor's arguments must outlive it.
class DisplayLoop {
 public:
  /// `window` is the context's, null offscreen. `catalogue`, `worker` and `attract` may be null. The worker loads
  /// models; without one, drawing waits for them.
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
  [[nodiscard]] Expected<void> tend_kiosk(TimePoint now);
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
  PhoneCode phone_code_;
  Presenter presenter_;
  KioskDesk desk_;
  PictureSchedule schedule_;
  std::optional<std::string> due_;  ///< name of this step's picture, if it is due
  bool last_picture_taken_ = false;
  bool whole_ = true;        ///< no part of the scene is still being loaded
  Duration waited_{0};       ///< how long such parts were awaited
  std::uint64_t turns_ = 0;  ///< turns of the loop, while the steps of a recording are drawn
  PictureFolder folder_;
  TimePoint started_;
  TimePoint next_;
  DisplaySummary summary_;
};

}  // namespace mechane::display
