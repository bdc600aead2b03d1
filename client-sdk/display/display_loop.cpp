#include "client-sdk/display/display_loop.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "client-sdk/display/kiosk_setup.hpp"
#include "server/log/log.hpp"

namespace mechane::display {

DisplayLoop::DisplayLoop(const DisplayOptions& options, DisplaySignals& signals, draw::GlContext& context,
                         Window* window, std::unique_ptr<draw::Renderer> renderer, DisplaySource& source,
                         const content::Catalogue* catalogue, Worker* worker, std::unique_ptr<AttractLoop> attract)
    : options_(options),
      signals_(signals),
      context_(context),
      window_(window),
      news_(options, source, open_assets(options, catalogue, worker)),
      visitor_(options, window, news_, std::move(attract)),
      phone_code_(options.kiosk),
      presenter_(options, signals, context, window, std::move(renderer), news_, visitor_, phone_code_),
      desk_(*source.client, identity_of(options, context), settings_at_start(options), clock_.now()),
      folder_(options.out, options.stereo) {}

Expected<DisplaySummary> DisplayLoop::run() {
  if (auto ok = presenter_.set_quality(options_.quality); !ok) return tl::unexpected(ok.error());
  started_ = next_ = clock_.now();
  while (!stop_wanted(now())) {
    const TimePoint now = this->now();
    take_news(now);
    take_visitor(now);
    if (auto ok = tend_kiosk(now); !ok) return tl::unexpected(ok.error());
    if (auto ok = show(now); !ok) return tl::unexpected(ok.error());
    if (auto ok = answer(folder_.take_written()); !ok) return tl::unexpected(ok.error());
    wait_for_next(now);
  }
  return sum_up();
}

/// Whether only the steps of a recording are drawn.
bool DisplayLoop::draws_recorded_steps() const {
  return !options_.source.play.empty() && options_.offscreen && options_.every_step && options_.film_fps <= 0;
}

/// The time of a film, or of a recording whose steps are drawn, is counted in turns of the loop, so that a slow machine
/// misses nothing.
TimePoint DisplayLoop::now() {
  const auto after = [this](double seconds) {
    return started_ + std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
  };
  if (options_.film_fps > 0) return after(static_cast<double>(presenter_.frames()) / options_.film_fps);
  if (draws_recorded_steps()) return after(static_cast<double>(turns_) / options_.fps);
  return clock_.now();
}

bool DisplayLoop::stop_wanted(TimePoint now) const {
  if (signals_.stop || desk_.restart_wanted() || (window_ != nullptr && window_->close_wanted())) return true;
  if (options_.seconds > 0 && now - started_ >= std::chrono::duration<double>(options_.seconds)) return true;
  if (options_.frames > 0 && presenter_.frames() >= options_.frames) return true;
  if (news_.over()) return true;
  const bool owes_picture = options_.every_step && !last_picture_taken_;
  return options_.until_done && news_.finished() && !owes_picture;
}

void DisplayLoop::take_news(TimePoint now) {
  const scene::ShownWorld::News news = news_.take(now);
  if (news.another_world) visitor_.forget_world();
  if (options_.every_step && news_.world().known() && !due_)
    due_ = schedule_.due(now, *news_.world().status(), news.whole);
  whole_ = news.whole;
  if (visitor_.invitation() != nullptr) return;  // the world behind the invitation is uploaded when it is shown again
  if (news.another_world) {
    presenter_.replace_assets();
  } else if (news.assets) {
    presenter_.upload();
  }
}

void DisplayLoop::take_visitor(TimePoint now) {
  visitor_.take(
      presenter_.last_picture(), [this] { return presenter_.world_scene(); }, now);
  if (visitor_.invite(desk_.settings(), now)) presenter_.replace_assets();
}

/// Handles requests from other machines, and sends the display's status.
Expected<void> DisplayLoop::tend_kiosk(TimePoint now) {
  if (desk_.take_requests(visitor_.style())) {
    const client::DisplaySettings& requested = desk_.settings();
    visitor_.change(visit::panel_settings(requested));
    visitor_.show_hands(requested.hand);
    presenter_.soundtrack().set_levels(requested.volume, requested.silent());
    if (auto ok = presenter_.set_quality(requested.quality); !ok) return ok;
  }
  phone_code_.hear(desk_.settings(), desk_.codes_told(), now);
  if (!desk_.report_due(now)) return {};
  const scene::ShownWorld& world = news_.world();
  desk_.report({context_.size(), world.status(), world.missing(), presenter_.soundtrack().state(),
                visitor_.invitation() != nullptr},
               now);
  return {};
}

/// Draws, and takes the pictures that are due or requested.
Expected<void> DisplayLoop::show(TimePoint now) {
  const bool asked = signals_.picture.exchange(false);
  const bool requested = (window_ != nullptr && window_->take_picture_wanted()) || asked || desk_.picture_wanted();
  const bool only_pictures = options_.offscreen && options_.every_step && options_.film_fps <= 0;
  if (!only_pictures || due_ || requested) {
    const auto took = presenter_.draw(now);
    if (!took) return tl::unexpected(took.error());
    if (*took) desk_.drawn(**took, clock_.now());
  }
  take_pictures(requested);
  return {};
}

void DisplayLoop::take_pictures(bool requested) {
  std::vector<std::string> names;
  if (due_) names.push_back(*std::exchange(due_, std::nullopt));
  if (options_.frames > 0 && presenter_.frames() == options_.frames) names.emplace_back("frame");
  if (options_.film_fps > 0) names.push_back(fmt::format("film-{:05}", presenter_.frames()));
  if (requested && folder_.wanted()) folder_.write_requested(presenter_.read_picture(), desk_.take_picture_requests());
  for (const std::string& name : names) {
    if (folder_.wanted()) folder_.write(presenter_.read_picture(), name);
    if (news_.finished() && name.ends_with("-done")) last_picture_taken_ = true;
  }
}

/// If a picture cannot be written: one that was requested by a person is only reported, one that an option asked for
/// ends the display.
Expected<void> DisplayLoop::answer(const std::vector<PictureFolder::Written>& pictures) {
  for (const PictureFolder::Written& picture : pictures) {
    if (picture.result) {
      log::info("wrote " + picture.path);
      summary_.pictures.push_back(picture.path);
      if (picture.requested) desk_.picture_taken(picture.requests, picture.path);
    } else if (picture.requested) {
      log::warning(picture.result.error().to_string());
      desk_.picture_failed(picture.requests, picture.result.error());
    } else {
      return tl::unexpected(picture.result.error());
    }
  }
  return {};
}

void DisplayLoop::wait_for_next(TimePoint began) {
  if (options_.film_fps > 0) return;
  const auto period = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(1.0 / options_.fps));
  const TimePoint now = clock_.now();
  if (draws_recorded_steps()) {
    // A recording waits for models that are being loaded, as long as a picture would.
    waited_ = whole_ ? Duration(0) : waited_ + period;
    if (whole_ || waited_ > PictureSchedule::kPatience) {
      ++turns_;
      return;
    }
  }
  next_ = std::max(next_ + period, now);
  // When drawing on the processor, a display leaves at least half of the time to other programs. With one picture per
  // step it leaves more anyway, and must not miss a short step.
  if (options_.offscreen && !options_.every_step)
    next_ = std::max(next_, now + std::min<Duration>(now - began, std::chrono::seconds(1)));
  clock_.sleep_until(next_);
}

Expected<DisplaySummary> DisplayLoop::sum_up() {
  if (auto ok = answer(folder_.finish()); !ok) return tl::unexpected(ok.error());
  // With a folder but no chosen moment, the last picture is written.
  if (options_.offscreen && summary_.pictures.empty() && presenter_.frames() > 0 && folder_.wanted()) {
    folder_.write(presenter_.read_picture(), "last");
    if (auto ok = answer(folder_.finish()); !ok) log::warning(ok.error().to_string());
  }
  const scene::ShownWorld& world = news_.world();
  summary_.frames = presenter_.frames();
  summary_.done = news_.finished();
  summary_.frame_ms_median = percentile(presenter_.frame_ms(), 0.5);
  summary_.frame_ms_p99 = percentile(presenter_.frame_ms(), 0.99);
  summary_.steps_missed.assign(schedule_.missed().begin(), schedule_.missed().end());
  if (const auto* differing = world.differing()) summary_.differing_assets.assign(differing->begin(), differing->end());
  if (const auto* missing = world.missing()) summary_.missing_assets.assign(missing->begin(), missing->end());
  summary_.renderer = context_.renderer_name();
  const auto heard = presenter_.soundtrack().state();
  summary_.sound = !heard ? "off" : heard->sounding ? heard->device : heard->problem;
  return std::move(summary_);
}

}  // namespace mechane::display
