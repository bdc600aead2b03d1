#include "client-sdk/display/visitor.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "client-sdk/display/kiosk_setup.hpp"
#include "client-sdk/picture/picking.hpp"
#include "client-sdk/pointer/pointer_aid.hpp"

namespace mechane::display {
namespace {

bool lets_go(const pointer::PointerEvent& event) {
  using Kind = pointer::PointerEvent::Kind;
  return event.kind == Kind::release || event.kind == Kind::turn_release || event.kind == Kind::gone ||
         event.kind == Kind::key_up;
}

}  // namespace

Visitor::Visitor(const DisplayOptions& options, Window* window, News& news, std::unique_ptr<AttractLoop> attract,
                 std::unique_ptr<pointer::PointerTouch> hand)
    : window_(window),
      news_(news),
      client_(news.client()),
      panel_(visit::panel_settings(settings_at_start(options))),
      attract_(std::move(attract)),
      forces_shown_(options.forces),
      language_(options.language) {
  news_.world().show_forces(forces_shown_);
  show_hands(options.hand);
  // A recording cannot be touched.
  if (!options.touch || window_ == nullptr || !options.source.play.empty()) return;
  if (hand)
    pointer_.emplace(std::move(hand));
  else
    pointer_.emplace(options.kiosk, options.domain);
}

void Visitor::forget_world() {
  if (pointer_) pointer_->forget_world();
}

void Visitor::show_hands(const std::string& look) {
  const scene::HandLook shown = scene::hand_look_of(look).value_or(scene::HandLook::medium);
  news_.world().show_hands(shown);
  if (attract_ != nullptr) attract_->show_hands(shown);
}

void Visitor::take(const LastPicture& last, const SceneNow& scene, TimePoint now) {
  if (window_ != nullptr) {
    for (const DisplayKey key : window_->take_keys())
      take_key(key, now);
    for (const picture::PixelPlace place : window_->take_clicks())
      take_click(place, last, scene, now);
    take_pointer(last, scene, now);
  }
  if (news_.calibration().asks()) panel_.notice_visitor(now);
  const auto server = client_.server_status();
  home_ = server && !server->scenarios.empty() ? server->scenarios.front() : std::string();
  panel_.update({news_.world().status(), news_.world().presentation(), news_.frame(), home_}, now);
  decisions_.send(panel_, client_, news_.world().presentation());
  if (panel_.language() == language_) return;
  language_ = panel_.language();
  news_.world().set_language(language_);
}

bool Visitor::invite(const client::DisplaySettings& settings, TimePoint now) {
  if (attract_ == nullptr) return false;
  const std::chrono::duration<double> alone = panel_.alone_for(now);
  const bool waited = settings.attract && alone.count() >= settings.attract_after_s;
  const bool before = std::exchange(invites_, waited && !panel_.has_sign());
  if (!invites_) return before;
  if (!before) attract_->rewind();
  return attract_->advance(now) || !before;
}

void Visitor::write(picture::RenderScene& scene, const LastPicture& last, TimePoint now) const {
  panel_.write(scene.overlay, now);
  if (scene.overlay.pose) scene.overlay.panel.reset();  // the questions would cover the pose
  if (scene.overlay.panel || scene.overlay.pose) scene.inset.reset();
  if (!pointer_ || !news_.world().known()) return;
  pointer_->write(scene.overlay, under_pointer(scene, last), language_);
  if (const auto button = pointer::go_on_button(news_.world().status(), language_); button && !scene.overlay.panel)
    scene.overlay.corner.insert(scene.overlay.corner.begin(), *button);
  if (const auto at = pointer_->hovers_at()) scene.overlay.meant = last.button_at(*at);
}

void Visitor::take_key(DisplayKey key, TimePoint now) {
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
      return news_.world().show_forces(forces_shown_);
  }
}

/// Buttons have priority; clicks do not go through a panel of questions or an invitation.
void Visitor::take_click(picture::PixelPlace place, const LastPicture& last, const SceneNow& scene, TimePoint now) {
  const auto action = last.button_at(place);
  if (action && action->kind == picture::OverlayAction::Kind::activity) (void)client_.start_activity(action->value);
  if (action) return panel_.press(*action, now);
  panel_.touch(now);
  if (!invites_ && !last.has_panel && news_.world().known()) click_object(place, last, scene());
}

/// A click on a sign counts as a touch.
void Visitor::click_object(picture::PixelPlace place, const LastPicture& last, const picture::RenderScene& scene) {
  const auto clicked = picture::object_at(scene, news_.world().assets(), place, last.stereo, last.size);
  if (!clicked) return;
  for (const client::SceneObject& object : news_.world().objects()) {
    if (object.index == *clicked) (void)client_.click(object.name);
  }
}

pointer::PointerScene Visitor::under_pointer(const picture::RenderScene& scene, const LastPicture& last) const {
  const scene::ShownWorld& world = news_.world();
  return {scene,         world.assets(),  last.stereo,    last.size,
          news_.frame(), world.objects(), world.status(), world.presentation().get()};
}

/// The display's own hand gets all events, except presses on buttons.
void Visitor::take_pointer(const LastPicture& last, const SceneNow& scene, TimePoint now) {
  using Kind = pointer::PointerEvent::Kind;
  std::vector<pointer::PointerEvent> events = window_->take_pointer_events();
  if (!pointer_ || !news_.world().known()) return;
  if (invites_) {  // the first press only ends the invitation; but what was held before it may be released
    if (std::ranges::any_of(events, [](const pointer::PointerEvent& e) { return e.kind != Kind::gone; }))
      panel_.touch(now);
    std::erase_if(events, [](const pointer::PointerEvent& e) { return !lets_go(e); });
    if (events.empty()) return;
  }
  if (events.empty() && pointer_->rests(now)) return;  // no scene is needed
  const picture::RenderScene built = scene();
  const pointer::PointerScene under = under_pointer(built, last);
  for (const pointer::PointerEvent& event : events) {
    const bool covered =
        event.kind == Kind::press && (last.has_panel || last.button_at({event.x, event.y}).has_value());
    pointer_->take(event, under, covered);
  }
  pointer_->update(under, now);
  if (pointer_->take_stirred()) panel_.touch(now);
}

}  // namespace mechane::display
