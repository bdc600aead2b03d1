#include "client-sdk/display/presenter.hpp"

#include <utility>

#include <fmt/format.h>

#include "client-sdk/display/spare_memory.hpp"
#include "client-sdk/scene/thing_names.hpp"
#include "server/log/log.hpp"

namespace mechane::display {
namespace {

constexpr std::size_t kFrameTimesKept = 20'000;
/// After this time without a graphics card the display ends; systemd may start it again.
constexpr Duration kCardComesBack = std::chrono::seconds(60);

}  // namespace

Presenter::Presenter(const DisplayOptions& options, const DisplaySignals& signals, draw::GlContext& context,
                     Window* window, std::unique_ptr<draw::Renderer> renderer, News& news, const Visitor& visitor,
                     const PhoneCode& code)
    : options_(options),
      signals_(signals),
      context_(context),
      window_(window),
      renderer_(std::move(renderer)),
      news_(news),
      visitor_(visitor),
      code_(code),
      soundtrack_(options.sound, !options.offscreen, options.language) {}

LastPicture Presenter::last_picture() const {
  return {context_.size(), options_.stereo, &renderer_->overlay(), panel_shown_};
}

void Presenter::replace_assets() {
  renderer_->forget_assets();
  upload();
}

/// The assets to upload: the renderer holds one set.
void Presenter::upload() {
  if (const AttractLoop* invitation = visitor_.invitation()) return renderer_->upload(invitation->assets());
  if (!news_.world().known()) return;
  renderer_->upload(news_.world().assets());
  news_.world().add_missing(renderer_->refused());
  give_spare_memory_back();
}

/// Whether the visitor's world is shown: there is no invitation in front of it, and its link is not lost.
bool Presenter::shows_live_world() const {
  return news_.live() && visitor_.invitation() == nullptr;
}

/// Not for a picture in true proportions, whose view must stay like a window's.
void Presenter::follow_work(const picture::RenderScene& scene, TimePoint now) {
  const picture::PixelSize eye = picture::seen_size(options_.stereo, context_.size());
  if (!options_.follow_step || options_.screen.known() || eye.width == 0 || eye.height == 0) return;
  if (visitor_.drags()) return step_view_.hold(now);
  step_view_.follow(scene.work_W, scene.camera, picture::aspect_of(eye), now);
}

/// As of the last call of follow_work() and make_room().
void Presenter::place_camera(picture::RenderScene& scene) const {
  const picture::PixelSize eye = picture::seen_size(options_.stereo, context_.size());
  if (eye.width == 0 || eye.height == 0) return;
  const double aspect = picture::aspect_of(eye);
  if (!options_.screen.known()) {
    scene.camera = step_view_.shown(scene.camera, aspect);
    scene.camera.room_below = caption_room_.room_below();
  }
  scene.camera = picture::for_screen(scene.camera, options_.screen, news_.head(), aspect);
}

picture::RenderScene Presenter::world_scene() const {
  picture::RenderScene scene = news_.world().build(news_.frame(), news_.client().state());
  place_camera(scene);
  return scene;
}

picture::RenderScene Presenter::compose(TimePoint now) {
  AttractLoop* invitation = visitor_.invitation();
  picture::RenderScene scene = invitation ? invitation->build(now, visitor_.language(), visitor_.style())
                                          : news_.world().build(news_.frame(), news_.client().state());
  follow_work(scene, now);
  if (step_view_.is_narrow() && !scene.inset && invitation == nullptr)
    scene.inset = picture::Inset{scene.camera, visitor_.language() == "el" ? "Ολόκληρη η μηχανή" : "The whole machine"};
  place_camera(scene);
  if (invitation != nullptr || (shows_live_world() && visitor_.at_home()))
    scene.overlay.code = code_.at(now, visitor_.language());
  if (invitation != nullptr) {
    scene.overlay.message = visitor_.message();
    return scene;
  }
  if (shows_live_world()) scene.overlay.pose = news_.calibration().at(now, visitor_.language());
  visitor_.write(scene, last_picture(), now);
  name_what_is_meant(scene);
  if (scene.overlay.panel || scene.overlay.pose || !shows_live_world()) return scene;
  if (scene.overlay.note.empty()) {  // notes about the pointer or the link are more urgent
    scene.overlay.notice = news_.device_notice(now, visitor_.language());
    if (!scene.overlay.notice) scene.overlay.note = soundtrack_.in_writing(visitor_.language(), now);
  }
  return scene;
}

/// Adds the name of the thing at the display's own pointer, or else at a hand. Words lie in the screen's plane, the
/// same for both eyes.
void Presenter::name_what_is_meant(picture::RenderScene& scene) const {
  const picture::PixelSize eye = picture::seen_size(options_.stereo, context_.size());
  const auto seen = picture::seen_place(scene.camera, picture::Stereo::mono, eye, {});
  if (!seen) return;
  for (const auto& meant : {visitor_.pointed_at(), scene.near_hand}) {
    if (meant && !scene.overlay.label) scene.overlay.label = scene::label_of(scene.named, *meant, seen->sight);
  }
}

/// Makes room for long or large captions. Not for a picture in true proportions, whose view must stay like a window's,
/// and not while a pointer drags something, which must stay under it.
void Presenter::make_room(picture::RenderScene& scene, TimePoint now) {
  if (options_.screen.known()) return;
  if (!scene.overlay.panel && !scene.overlay.pose && !visitor_.drags())
    caption_room_.see(renderer_->lay_out(scene, options_.stereo, context_.size()).covered_below, now);
  scene.camera.room_below = caption_room_.room_below();
}

/// Words of both eyes' pictures are in the same place, and a thing is not: they keep off both of its places.
void Presenter::keep_words_off(picture::RenderScene& scene, TimePoint now) {
  const picture::PixelSize eye = picture::seen_size(options_.stereo, context_.size());
  scene.overlay.keep_off = picture::boxes_of(scene, options_.stereo, eye);
  caption_history_.tell(scene.overlay, eye, now);
}

Expected<std::optional<Duration>> Presenter::draw(TimePoint now) {
  const auto nothing = [] { return std::optional<Duration>(); };
  const TimePoint began = clock_.now();
  soundtrack_.read(shows_live_world() ? news_.world().status() : nullptr, visitor_.language(), now);
  picture::RenderScene scene = compose(now);
  const picture::PixelSize size = context_.size();
  news_.tell_what_is_not_drawn(now);
  if (context_.lost()) {
    if (auto ok = recover(); !ok) return tl::unexpected(ok.error());
  }
  // A minimised window has no pixels, but must process events, or it would never notice that it is restored or closed.
  if (size.width < 2 || size.height < 2) {
    context_.present();
    return nothing();
  }
  make_room(scene, now);
  keep_words_off(scene, now);
  if (window_ != nullptr) renderer_->begin_at_row(window_->first_row());
  if (auto drawn = draw_measured(scene, size, now); !drawn) return survive(drawn.error()).map(nothing);
  if (options_.offscreen) {
    draw::Renderer::finish();
  } else {
    renderer_->copy_to_window(size);
  }
  context_.present();
  caption_history_.see(renderer_->overlay());
  panel_shown_ = scene.overlay.panel.has_value();
  hear(scene.camera, now);
  ++frames_;
  const Duration took = clock_.now() - began;
  if (frame_ms_.size() < kFrameTimesKept) frame_ms_.push_back(1e3 * to_seconds(took));
  return took;
}

Expected<void> Presenter::set_quality(const std::string& name) {
  if (name == quality_) return {};
  quality_ = name;
  governor_.reset();
  timer_.reset();
  if (const auto chosen = draw::quality_of(name)) {
    renderer_->set_quality(*chosen);
  } else if (options_.offscreen) {
    renderer_->set_quality(draw::Quality::high);  // pictures are the same on every machine
  } else {
    const Expected<draw::DrawingSpeed> speed = draw::measure_drawing_speed();
    if (!speed) return tl::unexpected(speed.error());
    governor_.emplace(draw::quality_for(*speed), 1e3 / options_.fps);
    timer_.emplace(speed->by_processor);
    renderer_->set_quality(governor_->quality());
    log::info(fmt::format("a million pixels of sky take {:.1f} ms: pictures in the quality {}", speed->megapixel_ms,
                          draw::quality_name(governor_->quality())));
  }
  return {};
}

/// Draws, and lets the time that it takes decide on the quality of the next picture.
Expected<void> Presenter::draw_measured(const picture::RenderScene& scene, picture::PixelSize size, TimePoint now) {
  if (!governor_) return renderer_->draw(scene, options_.stereo, size);
  timer_->begin();
  const Expected<void> drawn = renderer_->draw(scene, options_.stereo, size);
  timer_->end();
  const std::optional<double> ms = timer_->take();
  if (!drawn || !ms) return drawn;
  const draw::Quality before = governor_->quality();
  const draw::Quality next = governor_->drawn(*ms, now);
  if (next != before) {
    log::info(
        fmt::format("a picture takes {:.1f} ms to draw: from now on in the quality {}", *ms, draw::quality_name(next)));
    renderer_->set_quality(next);
  }
  return drawn;
}

void Presenter::hear(const picture::Camera& ears, TimePoint now) {
  const std::vector<client::WorldEvent> events = news_.take_events(now);
  const scene::ShownWorld& world = news_.world();
  const bool live = shows_live_world();
  soundtrack_.hear({live ? world.status() : nullptr, live ? news_.frame() : nullptr, world.presentation().get(),
                    world.objects(), events, world.folder()},
                   ears, visitor_.language(), now);
}

/// A window may be enlarged beyond the driver's memory, and made smaller again: it waits for that. Offscreen, this is
/// an error.
Expected<void> Presenter::survive(const Error& error) {
  if (context_.lost()) return recover();
  if (options_.offscreen) return tl::unexpected(error);
  if (told_draw_ != error.what) log::error(error);
  told_draw_ = error.what;
  context_.present();  // processes the window's events
  return {};
}

Expected<std::unique_ptr<draw::Renderer>> Presenter::begin_drawing() {
  if (auto ok = context_.renew(); !ok) return tl::unexpected(ok.error());
  if (context_.lost())
    return fail(ErrorCode::busy, "the graphics card is not back yet", "display",
                "look for its driver's messages in the system's log");
  return draw::Renderer::create(options_.renderer);
}

/// Uploads everything again after the graphics card has lost it. The world has continued meanwhile.
Expected<void> Presenter::recover() {
  log::warning(
      "the graphics card was reset (by its driver, or because the machine slept) and has lost everything: the display "
      "uploads it again");
  renderer_.reset();
  governor_.reset();
  timer_.reset();
  const TimePoint lost = clock_.now();
  auto renderer = begin_drawing();
  while (!renderer && !signals_.stop && clock_.now() - lost < kCardComesBack) {
    clock_.sleep_until(clock_.now() + std::chrono::seconds(1));
    renderer = begin_drawing();
  }
  if (!renderer) return tl::unexpected(renderer.error());
  renderer_ = std::move(*renderer);
  upload();
  log::info("the graphics card is back");
  return set_quality(std::exchange(quality_, {}));
}

}  // namespace mechane::display
