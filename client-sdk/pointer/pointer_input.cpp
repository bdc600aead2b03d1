#include "client-sdk/pointer/pointer_input.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "client-sdk/pointer/pointer_aid.hpp"

namespace mechane::pointer {
namespace {

// How often the thing under a hovering pointer is looked for: a ray is tested against all triangles.
constexpr Duration kLookUnderHover = std::chrono::milliseconds(100);
constexpr double kFocusSpeed = 0.3;         // shares of the picture's height per second
constexpr double kKeyTurn_rad_per_s = 2.1;  // 20 turns a minute
constexpr double kKeyTwist_rad_per_s = 1.2;
constexpr double kKeyNotches_per_s = 8;
constexpr double kLongestPicture_s = 0.25;

picture::PixelPlace middle_of(picture::PixelSize picture) {
  return {picture.width / 2.0, picture.height / 2.0};
}

}  // namespace

PointerInput::PointerInput(std::unique_ptr<PointerTouch> hand)
    : PointerInput(
          [hand = std::make_shared<std::unique_ptr<PointerTouch>>(std::move(hand))] { return std::move(*hand); }) {}

void PointerInput::take(const PointerEvent& event, const PointerScene& scene, bool covered) {
  using Kind = PointerEvent::Kind;
  stirred_ = stirred_ || (event.kind != Kind::left && event.kind != Kind::gone);
  switch (event.kind) {
    case Kind::press:
      focus_.reset();
      if (!covered) take_fingers(event, scene);
      return;
    case Kind::move:
      if (event.finger == kMouse) {
        hover_ = picture::PixelPlace{event.x, event.y};
        hover_moved_ = true;
        if (!keys_hand_) {  // moving the mouse ends the use of keys
          focus_.reset();
          means_ = PointerMeans::mouse;
        }
      }
      return take_fingers(event, scene);
    case Kind::release:
    case Kind::turn_press:
    case Kind::turn_release:
    case Kind::gone:
      return take_fingers(event, scene);
    case Kind::wheel:
      if (PointerTouch* hand = meant(event.finger)) hand->deepen(kNotch * event.amount);
      return;
    case Kind::turn_wheel:
      if (PointerTouch* hand = meant(event.finger)) hand->turn(kNotchTurn_rad * event.amount);
      return;
    case Kind::left:
      hover_.reset();
      under_hover_ = {};
      return;
    case Kind::key_down:
      held_[static_cast<std::size_t>(event.key)] = true;
      return take_key(event.key, scene);
    case Kind::key_up:
      held_[static_cast<std::size_t>(event.key)] = false;
      return;
  }
}

void PointerInput::forget_world() {
  focus_.reset();
  under_hover_ = {};
  hover_moved_ = true;
}

void PointerInput::take_fingers(const PointerEvent& event, const PointerScene& scene) {
  if (event.kind == PointerEvent::Kind::press) {
    means_ = event.finger == kMouse ? PointerMeans::mouse : PointerMeans::fingers;
    if (event.finger != kMouse) {  // fingers do not hover
      hover_.reset();
      under_hover_ = {};
    }
  }
  if (event.kind == PointerEvent::Kind::gone && keys_hand_) {
    if (PointerTouch* hand = hands_.at(*keys_hand_)) hand->release();
    keys_hand_.reset();
  }
  const bool presses = event.kind == PointerEvent::Kind::press && std::isfinite(event.x) && std::isfinite(event.y);
  const std::optional<Target> target = presses ? target_at(scene, {event.x, event.y}) : std::nullopt;
  const auto on = target ? std::optional(target->touched.object) : std::nullopt;
  follow(hands_.take(event, on, scene.picture, keys_hand_), scene, target);
}

void PointerInput::follow(const std::vector<HandOrder>& orders, const PointerScene& scene,
                          const std::optional<Target>& target) {
  for (auto [hand, request] : orders) {
    if (request.kind == HandRequest::Kind::take) {
      if (!press(hand, target)) hands_.missed(hand);
      continue;
    }
    if (hand == keys_hand_ || hands_.at(hand) == nullptr) continue;
    if (request.kind == HandRequest::Kind::move) {
      const auto seen = picture::seen_place(scene.scene.camera, scene.stereo, scene.picture, request.place);
      if (!seen) continue;
      request.place = seen->place;
    }
    fulfil(request, *hands_.at(hand));
  }
}

/// None: there is nothing to take.
std::optional<PointerInput::Target> PointerInput::target_at(const PointerScene& scene, picture::PixelPlace whole) {
  const auto seen = picture::seen_place(scene.scene.camera, scene.stereo, scene.picture, whole);
  if (!seen) return {};
  const auto touched = under_finger(scene, seen->sight, seen->place).takeable;
  if (!touched) return {};
  return Target{seen->sight, seen->place, *touched};
}

/// False: there is nothing to take, or no hand to take it with.
bool PointerInput::press(std::size_t hand, const std::optional<Target>& target) {
  PointerTouch* const touch = target ? hands_.made(hand) : nullptr;
  if (touch == nullptr) return false;
  if (keys_hand_ == hand) keys_hand_.reset();
  touch->press(target->sight, target->place, target->touched);
  return true;
}

void PointerInput::take_key(PointerKey key, const PointerScene& scene) {
  if (key == PointerKey::turn_left || key == PointerKey::turn_right) return;  // these turn anything that is held
  means_ = PointerMeans::keys;
  if (key == PointerKey::next || key == PointerKey::previous)
    return focus_next(scene, key == PointerKey::next ? 1 : -1);
  if (!focus_) focus_ = middle_of(scene.picture);
  if (key != PointerKey::take) return;
  const auto held = keys_hand_ ? keys_hand_ : hands_.hand_of(kMouse);
  if (held && state_of(hands_.view(*held), scene.picture).busy) return hands_.at(*held)->release();
  const auto hand = hands_.idle();
  keys_hand_ = hand && press(*hand, target_at(scene, *focus_)) ? hand : std::nullopt;
}

void PointerInput::focus_next(const PointerScene& scene, int step) {
  const auto seen = picture::seen_place(scene.scene.camera, scene.stereo, scene.picture, middle_of(scene.picture));
  if (!seen || keys_hand_) return;
  const std::vector<picture::PixelPlace> places = places_to_take(scene, seen->sight);
  if (places.empty()) return;
  const double from = focus_ ? focus_->x : (step > 0 ? -1.0 : 1e9);
  const auto after = std::ranges::find_if(places, [&](picture::PixelPlace p) { return p.x > from + 1; });
  const auto before =
      std::find_if(places.rbegin(), places.rend(), [&](picture::PixelPlace p) { return p.x < from - 1; });
  focus_ = step > 0 ? (after == places.end() ? places.front() : *after)
                    : (before == places.rend() ? places.back() : *before);
}

void PointerInput::go_on_with_keys(const PointerScene& scene, double dt_s) {
  using Key = PointerKey;
  const double across = (held(Key::right) ? 1 : 0) - (held(Key::left) ? 1 : 0);
  const double down = (held(Key::down) ? 1 : 0) - (held(Key::up) ? 1 : 0);
  const double far = (held(Key::farther) ? 1 : 0) - (held(Key::nearer) ? 1 : 0);
  const double round = (held(Key::turn_right) ? 1 : 0) - (held(Key::turn_left) ? 1 : 0);
  stirred_ = stirred_ || round != 0;
  PointerTouch* const turned = meant(kMouse);
  if (round != 0 && turned != nullptr) turned->turn(round * kKeyTwist_rad_per_s * dt_s);
  if (!focus_ || (across == 0 && down == 0 && far == 0)) return;
  stirred_ = true;
  PointerTouch* const hand = keys_hand_ ? hands_.at(*keys_hand_) : nullptr;
  const PointerView view = hand != nullptr ? hand->view() : PointerView();
  const bool holding = view.phase == PointerView::Phase::holding;
  if (holding && view.drag == PointerView::Drag::turn) return hand->turn((across + down) * kKeyTurn_rad_per_s * dt_s);
  if (holding && far != 0) hand->deepen(far * kNotch * kKeyNotches_per_s * dt_s);
  const double step = kFocusSpeed * scene.picture.height * dt_s;
  focus_->x = std::clamp(focus_->x + across * step, 0.0, scene.picture.width - 1.0);
  focus_->y = std::clamp(focus_->y + down * step, 0.0, scene.picture.height - 1.0);
  const auto seen = picture::seen_place(scene.scene.camera, scene.stereo, scene.picture, *focus_);
  if (seen && hand != nullptr) hand->move(seen->place);
}

void PointerInput::update(const PointerScene& scene, TimePoint now) {
  const double dt_s = std::max(to_seconds(now - updated_), 0.0);
  updated_ = now;
  follow(hands_.pass(dt_s), scene, {});
  go_on_with_keys(scene, std::min(dt_s, kLongestPicture_s));
  const bool idle = is_away();
  if (keys_hand_ && hands_.view(*keys_hand_).phase == PointerView::Phase::resting) keys_hand_.reset();
  const std::optional<picture::PixelPlace> looks_at = focus_ ? focus_ : hover_;
  if (!idle || !looks_at || now - looked_ < kLookUnderHover) return;
  if (!hover_moved_ && !focus_) return;
  hover_moved_ = false;
  looked_ = now;
  const auto seen = picture::seen_place(scene.scene.camera, scene.stereo, scene.picture, *looks_at);
  under_hover_ = seen ? under_finger(scene, seen->sight, seen->place) : UnderFinger{};
}

std::optional<picture::Touched> PointerInput::pointed_at() const {
  if (!is_away()) return {};
  return under_hover_.takeable ? under_hover_.takeable : under_hover_.seen;
}

bool PointerInput::rests(TimePoint now) {
  const bool stirs = keys_hand_ || hover_moved_ || focus_ || stirred_ || std::ranges::any_of(held_, std::identity());
  if (stirs || !is_away()) return false;
  updated_ = now;
  return true;
}

void PointerInput::write(picture::OverlayContent& content, const PointerScene& scene,
                         const std::string& language) const {
  const std::optional<picture::PixelPlace> at = focus_ ? focus_ : hover_;
  const auto seen =
      picture::seen_place(scene.scene.camera, scene.stereo, scene.picture, at.value_or(middle_of(scene.picture)));
  if (!seen || content.panel) return;
  PointerAid aid{seen->sight, {}, {}, {}, PointerLinkState::none, means_};
  if (is_away() && under_hover_.takeable) aid.p_WT = under_hover_.takeable->p_WT;
  if (focus_) aid.focus = seen->place;
  const std::vector<std::size_t> shown = hands_.shown();
  if (shown.empty()) add_pointer_aid(aid, language, content);
  for (const std::size_t hand : shown) {
    aid.view = hands_.view(hand);
    aid.link = hands_.state(hand);
    add_pointer_aid(aid, language, content);
    aid.p_WT.reset();
    aid.focus.reset();
  }
}

}  // namespace mechane::pointer
