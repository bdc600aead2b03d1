#include "client-sdk/display/display_loop.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "client-sdk/display/spare_memory.hpp"
#include "client-sdk/draw/overlay_layout.hpp"
#include "client-sdk/picture/image_file.hpp"
#include "client-sdk/picture/picking.hpp"
#include "client-sdk/pointer/pointer_aid.hpp"
#include "client-sdk/scene/thing_names.hpp"
#include "server/log/log.hpp"

namespace mechane::display {
namespace {

using client::LinkState;

constexpr std::size_t kFrameTimesKept = 20'000;
/// After so long without being named, an object has no manifest.
constexpr Duration kManifestComes = std::chrono::seconds(5);
/// After so long without a graphics card, who started the display shall try.
constexpr Duration kCardComesBack = std::chrono::seconds(60);
}  // namespace

bool DisplayLoop::finished() const {
  const client::WorldStatus* status = world_.status();
  if (status == nullptr || !status->done) return false;
  return status->activities.empty() || status->activities.back() == status->activity;
}

/// A film's time goes by its pictures, not by how long they take.
TimePoint DisplayLoop::now() {
  if (options_.film_fps <= 0) return clock_.now();
  const double seconds = static_cast<double>(summary_.frames) / options_.film_fps;
  return started_ + std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
}

bool DisplayLoop::stop_wanted(TimePoint now) const {
  if (requests_.stop || (window_ != nullptr && window_->close_wanted())) return true;
  if (options_.seconds > 0 && now - started_ >= std::chrono::duration<double>(options_.seconds)) return true;
  if (options_.frames > 0 && summary_.frames >= options_.frames) return true;
  if (source_.recorded != nullptr && source_.recorded->over()) return true;
  const bool owes_picture = options_.every_step && !last_picture_taken_;
  return options_.until_done && finished() && !owes_picture;
}

/// Visitors see a calm picture; whoever looks after the kiosk needs the reason.
void DisplayLoop::say_refusal() {
  const std::string refusal = client_.state() == LinkState::refused ? client_.refusal() : std::string();
  if (refusal == told_refusal_) return;
  told_refusal_ = refusal;
  if (!refusal.empty()) log::warning("no exhibit yet: " + refusal);
}

/// What came loose from its world is not drawn; once is enough.
void DisplayLoop::say_stray() {
  const std::string stray = world_.stray();
  if (stray.empty() || stray == told_stray_) return;
  told_stray_ = stray;
  log::warning(told_stray_ + " is kilometres away and not drawn: its world has come apart; begin the activity anew");
}

/// For a moment it is a manifest that is still on its way.
void DisplayLoop::say_unknown(TimePoint now) {
  const auto unknown = world_.unknown();
  if (!unknown) return unknown_since_.reset();
  if (!unknown_since_) unknown_since_ = now;
  if (now - *unknown_since_ < kManifestComes || std::exchange(told_unknown_, unknown) == unknown) return;
  log::warning(fmt::format(
      "object {} moves, and no manifest names it: it is not drawn; is the server of this display's version?",
      *unknown));
}

/// Status, manifest and frame as they are now.
void DisplayLoop::take_news(TimePoint now) {
  if (source_.recorded != nullptr) source_.recorded->advance(now);
  const scene::ShownWorld::News news = world_.hear(client_);
  if (news.another_world) {
    if (!attracts_) renderer_->forget_assets();
    have_frame_ = false;  // of the world before
    if (pointer_) pointer_->forget_world();
  }
  if (news.assets) upload();
  if (options_.every_step && world_.known() && !due_) due_ = schedule_.due(now, *world_.status(), news.whole);
  record(now);
  say_refusal();
  // While the link is down the last frame stays.
  client::Frame newer;
  if (client_.state() == LinkState::joined && client_.interpolated_frame(now, kInterpolationDelay, newer)) {
    frame_ = std::move(newer);
    have_frame_ = true;
  }
}

/// Many or large words cover what they speak of. A picture in true proportions is a window, which stays where it is; and what a pointer drags must stay
/// under it.
void DisplayLoop::make_room(picture::RenderScene& scene, TimePoint now) {
  if (options_.screen.known()) return;
  const bool may_move = !scene.overlay.panel && (!pointer_ || pointer_->is_away());
  if (may_move) caption_room_.see(renderer_->lay_out(scene, options_.stereo, context_.size()).covered_below, now);
  scene.camera.room_below = caption_room_.room_below();
}

/// The visitor's head, where the museum has a tracker.
void DisplayLoop::tend_head(TimePoint now) {
  const bool before = head_.tracked();
  head_.advance(client_.viewer_head(), now);
  if (head_.tracked() == before) return;
  if (!before && !std::exchange(told_head_, true) && !options_.screen.known())
    log::warning(
        "a tracker tells where the visitor's head is, and this display does not know its screen: give --screen-width "
        "and --viewer-distance");
}

void DisplayLoop::record(TimePoint now) {
  if (!source_.recorder || !world_.known() || client_.state() != LinkState::joined) return;
  client::Frame newest;
  const bool any = client_.newest_frame(newest);
  source_.recorder->hear(now, *world_.status(), world_.presentation().get(), world_.objects(), any ? &newest : nullptr);
}

picture::RenderScene DisplayLoop::build(TimePoint now) const {
  picture::RenderScene scene = attracts_ ? attract_->build(now, spoken_, panel_.settings().style)
                                         : world_.build(have_frame_ ? &frame_ : nullptr, client_.state());
  if (!attracts_) panel_.write(scene.overlay, now);
  if (scene.overlay.panel) scene.inset.reset();  // it would lie before the questions
  if (!options_.screen.known()) scene.camera.room_below = caption_room_.room_below();  // as it was seen last
  const picture::PixelSize eye = picture::seen_size(options_.stereo, context_.size());
  if (eye.width > 0 && eye.height > 0)
    scene.camera = picture::for_screen(scene.camera, options_.screen, head_.place(), picture::aspect_of(eye));
  if (pointer_ && world_.known() && !attracts_) {
    pointer_->write(scene.overlay, under_pointer(scene), spoken_);
    if (const auto button = pointer::go_on_button(world_.status(), spoken_); button && !scene.overlay.panel)
      scene.overlay.corner.insert(scene.overlay.corner.begin(), *button);
    if (const auto at = pointer_->hovers_at()) scene.overlay.meant = pressed(*at);
  }
  if (!attracts_) name_what_is_meant(scene);
  // What the pointer, or the link, has to say is more urgent.
  if (scene.overlay.note.empty() && !scene.overlay.panel && is_there()) scene.overlay.note = heard_in_writing(now);
  return scene;
}

std::string DisplayLoop::heard_in_writing(TimePoint now) const {
  std::string said = subtitles_.at(now);
  const std::string sounds = sound_captions_.at(now, spoken_);
  if (!said.empty() && !sounds.empty()) said += ' ';
  return said + sounds;
}

/// By the display's own pointer, or else by a hand. Words lie in the screen, for both eyes alike.
void DisplayLoop::name_what_is_meant(picture::RenderScene& scene) const {
  const picture::PixelSize eye = picture::seen_size(options_.stereo, context_.size());
  const auto seen = picture::seen_place(scene.camera, picture::Stereo::mono, eye, {});
  if (!seen) return;
  for (const auto& meant : {pointer_ ? pointer_->pointed_at() : std::nullopt, scene.near_hand}) {
    if (meant && !scene.overlay.label) scene.overlay.label = scene::label_of(scene.named, *meant, seen->sight);
  }
}

pointer::PointerScene DisplayLoop::under_pointer(const picture::RenderScene& scene) const {
  return {scene,
          world_.assets(),
          options_.stereo,
          context_.size(),
          have_frame_ ? &frame_ : nullptr,
          world_.objects(),
          world_.status(),
          world_.presentation().get()};
}

/// The display's own hand hears of everything that no button hears.
void DisplayLoop::take_pointer(TimePoint now) {
  const std::vector<pointer::PointerEvent> events = window_->take_pointer_events();
  if (!pointer_ || !world_.known()) return;
  if (attracts_) {  // whoever comes ends the invitation, and takes nothing yet
    if (std::ranges::any_of(events,
                            [](const pointer::PointerEvent& e) { return e.kind != pointer::PointerEvent::Kind::gone; }))
      panel_.touch(now);
    return;
  }
  if (events.empty() && pointer_->rests(now)) return;  // a scene is not built for nothing
  const picture::RenderScene scene = build(now);
  const pointer::PointerScene under = under_pointer(scene);
  for (const pointer::PointerEvent& event : events) {
    const bool covered =
        event.kind == pointer::PointerEvent::Kind::press && (panel_shown_ || pressed({event.x, event.y}).has_value());
    pointer_->take(event, under, covered);
  }
  pointer_->update(under, now);
  if (pointer_->take_stirred()) panel_.touch(now);
}

void DisplayLoop::take_wishes(TimePoint now) {
  if (window_ != nullptr) {
    for (const DisplayKey key : window_->take_keys())
      take_key(key, now);
    for (const picture::PixelPlace place : window_->take_clicks())
      take_click(place, now);
    take_pointer(now);
  }
  const auto server = client_.server_status();
  const std::string home = server && !server->scenarios.empty() ? server->scenarios.front() : std::string();
  panel_.update({world_.status(), world_.presentation(), have_frame_ ? &frame_ : nullptr, home}, now);
  const visit::VisitorWishes wishes = panel_.take_wishes();
  if (wishes.home) (void)client_.open_exhibit("");
  for (const visit::VisitorAnswer& given : wishes.answers) {
    if (client_.answer(given.when, given.activity, given.question, given.answer) == 0)
      log::warning("an answer to '" + given.question + "' was not sent: there is no world");
  }
  tell_language();
  if (panel_.language() == spoken_) return;
  spoken_ = panel_.language();
  world_.set_language(spoken_);
  if (sound_) sound_->set_language(spoken_);
}

/// The visit's sheet says in which language the visitor was shown the exhibit: told once a world, and when it changes.
void DisplayLoop::tell_language() {
  const auto& presentation = world_.presentation();
  if (!presentation || presentation->languages.empty() || client_.state() != LinkState::joined) return;
  const auto& known = presentation->languages;
  const bool speaks_it = std::ranges::count(known, panel_.language()) > 0;
  const std::string& shown = speaks_it ? panel_.language() : known.front();
  if (told_presentation_ == presentation && told_language_ == shown) return;
  if (client_.tell_language(shown) == 0) return;
  told_presentation_ = presentation;
  told_language_ = shown;
}

/// The world's; an invitation's own assets go before.
void DisplayLoop::upload() {
  if (attracts_ || !world_.known()) return;
  renderer_->upload(world_.assets());
  world_.add_missing(renderer_->refused());
  give_spare_memory_back();
}

/// Nobody is there: a recorded visit invites. The world goes on behind it, so that whoever comes is in it at once.
void DisplayLoop::tend_attract(TimePoint now) {
  if (attract_ == nullptr) return;
  const client::DisplaySettings& settings = desk_.settings();
  const std::chrono::duration<double> alone = panel_.alone_for(now);
  const bool before = std::exchange(attracts_, settings.attract && alone.count() >= settings.attract_after_s);
  if (attracts_ && !before) attract_->rewind();
  if (attracts_ ? attract_->advance(now) || !before : before) {
    renderer_->forget_assets();
    if (attracts_) renderer_->upload(attract_->assets());
    upload();
  }
}

/// What is wished from afar, and how the display is.
void DisplayLoop::tend_kiosk(TimePoint now) {
  if (desk_.take_wishes(panel_.settings().style)) {
    const client::DisplaySettings& wished = desk_.settings();
    panel_.change(panel_settings(wished));
    if (!sound_ && !wished.muted && !options_.offscreen) sound_.emplace(options_.sound, spoken_);
    if (sound_) sound_->set_levels({wished.volume, wished.muted});
  }
  if (!desk_.report_due(now)) return;
  DisplayFacts facts;
  facts.size = context_.size();
  facts.world = world_.status();
  facts.missing = world_.missing();
  if (sound_) facts.sound = sound_->state();
  facts.attracts = attracts_;
  desk_.report(facts, now);
}

void DisplayLoop::take_key(DisplayKey key, TimePoint now) {
  panel_.touch(now);
  switch (key) {
    case DisplayKey::home:
      (void)client_.open_exhibit("");
      return;
    case DisplayKey::language:
      return panel_.next_language(now);
    case DisplayKey::large_text:
      return panel_.toggle_large_text();
    case DisplayKey::high_contrast:
      return panel_.toggle_high_contrast();
    case DisplayKey::forces:
      forces_shown_ = !forces_shown_;
      return world_.show_forces(forces_shown_);
  }
}

/// Buttons come first; what lies behind a panel of questions is not meant.
void DisplayLoop::take_click(picture::PixelPlace place, TimePoint now) {
  const auto action = pressed(place);
  if (action && action->kind == picture::OverlayAction::Kind::activity) (void)client_.start_activity(action->value);
  if (action) return panel_.press(*action, now);
  panel_.touch(now);
  if (attracts_) return;  // it means what is behind the invitation as little as a panel's
  if (!panel_shown_) click_object(place, now);
}

std::optional<picture::OverlayAction> DisplayLoop::pressed(picture::PixelPlace place) const {
  const picture::PixelSize picture = context_.size();
  const picture::PixelSize eye = picture::seen_size(options_.stereo, picture);
  if (eye.width < 2 || eye.height < 2) return {};
  const picture::EyePlace seen = picture::eye_at(options_.stereo, picture, place);
  const draw::OverlayLayout& shown = renderer_->overlay();
  return draw::action_at(shown, (1 + seen.x) / 2 * shown.size.width, (1 - seen.y) / 2 * shown.size.height);
}

/// A click on a sign is as good as a finger.
void DisplayLoop::click_object(picture::PixelPlace place, TimePoint now) {
  if (!world_.known()) return;
  const auto clicked = picture::object_at(build(now), world_.assets(), place, options_.stereo, context_.size());
  if (!clicked) return;
  for (const client::SceneObject& object : world_.objects()) {
    if (object.index == *clicked) (void)client_.click(object.name);
  }
}

/// The visitor's world is seen and heard: no invitation before it, no link that was lost.
bool DisplayLoop::is_there() const {
  return have_frame_ && client_.state() == LinkState::joined && !attracts_;
}

Expected<void> DisplayLoop::draw(TimePoint now) {
  const TimePoint began = clock_.now();
  subtitles_.hear(is_there() ? world_.status() : nullptr, spoken_, now);
  picture::RenderScene scene = build(now);
  const picture::PixelSize size = context_.size();
  say_stray();
  say_unknown(now);
  if (context_.lost()) {
    if (auto ok = recover(); !ok) return ok;
  }
  // A window that is minimised has no pixels.
  if (size.width < 2 || size.height < 2) return {};
  make_room(scene, now);
  if (window_ != nullptr) renderer_->begin_at_row(window_->first_row());
  if (auto ok = renderer_->draw(scene, options_.stereo, size); !ok) return survive(ok.error());
  if (options_.offscreen) {
    draw::Renderer::finish();
  } else {
    renderer_->copy_to_window(size);
  }
  context_.present();
  panel_shown_ = scene.overlay.panel.has_value();
  let_hear(scene.camera, now);
  ++summary_.frames;
  desk_.drawn(clock_.now() - began, clock_.now());
  if (frame_ms_.size() < kFrameTimesKept) {
    frame_ms_.push_back(std::chrono::duration<double, std::milli>(clock_.now() - began).count());
  }
  return {};
}

/// A window may be drawn to a size that the driver has no memory for, and back: it waits for that. Offscreen the size stays wrong.
Expected<void> DisplayLoop::survive(const Error& error) {
  if (context_.lost()) return recover();
  if (options_.offscreen) return tl::unexpected(error);
  if (told_draw_ != error.what) log::error(error);
  told_draw_ = error.what;
  context_.present();  // takes the window's events
  return {};
}

Expected<std::unique_ptr<draw::Renderer>> DisplayLoop::begin_drawing() {
  if (auto ok = context_.renew(); !ok) return tl::unexpected(ok.error());
  if (context_.lost())
    return fail("the graphics card is not back yet", "display", "see the system's log for its driver");
  return draw::Renderer::create(options_.renderer);
}

/// What was uploaded is gone, and comes again. The world went on meanwhile.
Expected<void> DisplayLoop::recover() {
  log::warning(
      "the graphics card has lost all (its driver was reset, or the machine slept): the display begins to draw anew");
  renderer_.reset();
  const TimePoint lost = clock_.now();
  auto renderer = begin_drawing();
  while (!renderer && !requests_.stop && clock_.now() - lost < kCardComesBack) {
    clock_.sleep_until(clock_.now() + std::chrono::seconds(1));
    renderer = begin_drawing();
  }
  if (!renderer) return tl::unexpected(renderer.error());
  renderer_ = std::move(*renderer);
  if (attracts_) renderer_->upload(attract_->assets());
  upload();
  log::info("the graphics card is back");
  return {};
}

void DisplayLoop::let_hear(const picture::Camera& ears, TimePoint now) {
  const std::vector<client::WorldEvent> events = client_.take_events();
  if (source_.recorder) source_.recorder->hear(now, events);
  const bool here = is_there();
  std::vector<sound::SoundSource> sources =
      sounds_.hear(here ? &frame_ : nullptr, world_.presentation().get(), world_.objects(), events);
  sound_captions_.hear(sources, now);
  if (sound_) sound_->hear(ears, std::move(sources), here ? world_.status() : nullptr, world_.folder());
}

std::string DisplayLoop::picture_path(const std::string& name) const {
  return fmt::format("{}/{}-{}.png", options_.out, name, picture::stereo_name(options_.stereo));
}

Expected<void> DisplayLoop::write_picture(const std::string& name) {
  if (options_.out.empty()) return {};
  const std::string path = picture_path(name);
  if (auto ok = picture::write_png(renderer_->read_picture(), path); !ok) return ok;
  log::info("wrote " + path);
  summary_.pictures.push_back(path);
  return {};
}

/// For a person: a full disk costs the picture, and not the display. What is in the folder already, of the display before a restart or of one
/// beside it, stays.
void DisplayLoop::write_requested() {
  std::string name;
  std::error_code unreadable;
  do {
    name = fmt::format("request-{:03}", ++requested_pictures_);
  } while (std::filesystem::exists(picture_path(name), unreadable));
  const auto written = write_picture(name);
  if (written) return desk_.picture_taken(summary_.pictures.empty() ? "" : summary_.pictures.back());
  log::warning(written.error().to_string());
  desk_.picture_failed(written.error());
}

/// Who named a folder and no moment gets what was seen last.
void DisplayLoop::write_last() {
  if (!options_.offscreen || !summary_.pictures.empty() || summary_.frames == 0) return;
  if (const auto written = write_picture("last"); !written) log::warning(written.error().to_string());
}

void DisplayLoop::wait_for_next(TimePoint began) {
  if (options_.film_fps > 0) return;
  const auto period = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(1.0 / options_.fps));
  const TimePoint now = clock_.now();
  next_ = std::max(next_ + period, now);
  // Drawing on the processor, a display leaves at least half of the time to the others on the machine. One picture a step leaves more
  // than that, and must be back before a short step is over.
  if (options_.offscreen && !options_.every_step)
    next_ = std::max(next_, now + std::min<Duration>(now - began, std::chrono::seconds(1)));
  clock_.sleep_until(next_);
}

Expected<DisplaySummary> DisplayLoop::run() {
  started_ = next_ = clock_.now();
  if (options_.sound.on && !options_.offscreen) sound_.emplace(options_.sound, spoken_);
  while (!stop_wanted(now())) {
    const TimePoint now = this->now();
    take_news(now);
    tend_head(now);
    take_wishes(now);
    tend_attract(now);
    tend_kiosk(now);
    const bool asked = requests_.picture.exchange(false);
    const bool requested = (window_ != nullptr && window_->take_picture_wanted()) || asked || desk_.picture_wanted();
    const bool only_pictures = options_.offscreen && options_.every_step && options_.film_fps <= 0;
    if (!only_pictures || due_ || requested) {
      if (auto ok = draw(now); !ok) return tl::unexpected(ok.error());
    }
    std::vector<std::string> names;
    if (due_) names.push_back(*std::exchange(due_, std::nullopt));
    if (requested) write_requested();
    if (options_.frames > 0 && summary_.frames == options_.frames) names.emplace_back("frame");
    if (options_.film_fps > 0) names.push_back(fmt::format("film-{:05}", summary_.frames));
    for (const std::string& name : names) {
      if (auto ok = write_picture(name); !ok) return tl::unexpected(ok.error());
      if (finished() && name.ends_with("-done")) last_picture_taken_ = true;
    }
    wait_for_next(now);
  }
  write_last();
  summary_.done = finished();
  summary_.frame_ms_median = percentile(frame_ms_, 0.5);
  summary_.frame_ms_p99 = percentile(frame_ms_, 0.99);
  summary_.steps_missed.assign(schedule_.missed().begin(), schedule_.missed().end());
  if (const auto* differing = world_.differing())
    summary_.differing_assets.assign(differing->begin(), differing->end());
  if (const auto* missing = world_.missing()) summary_.missing_assets.assign(missing->begin(), missing->end());
  summary_.renderer = context_.renderer_name();
  if (sound_) {
    const sound::SoundState heard = sound_->state();
    summary_.sound = heard.sounding ? heard.device : heard.problem;
  } else {
    summary_.sound = "off";
  }
  return std::move(summary_);
}

}  // namespace mechane::display
