// From a window's events to the display's own hand, and what a person sees of it: a ring on what can be taken, the way that it goes, a word
// on how. A mouse, one finger, or keys: Tab goes to what can be taken, Space takes it and lets it go, arrows move it.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client-sdk/picture/picking.hpp"
#include "client-sdk/pointer/pointer_aid.hpp"
#include "client-sdk/pointer/pointer_event.hpp"
#include "client-sdk/pointer/pointer_fingers.hpp"
#include "client-sdk/pointer/pointer_link.hpp"

namespace mechane::pointer {

/// What lies under the pointer. Borrowed for the call.
struct PointerScene {
  const picture::RenderScene& scene;
  const picture::SceneAssets& assets;
  picture::Stereo stereo = picture::Stereo::mono;
  picture::PixelSize picture;
  const client::Frame* frame = nullptr;
  std::span<const client::SceneObject> objects;
  const client::WorldStatus* status = nullptr;
  const client::WorldPresentation* presentation = nullptr;

  [[nodiscard]] std::optional<Pose> pose_of(std::uint32_t object) const;
  [[nodiscard]] Leeway leeway(std::uint32_t object) const;
  /// Hands may take it now, as far as a client knows.
  [[nodiscard]] bool takeable(std::uint32_t object) const;
};

/// What a pixel is of, and what a finger on it means to take: what is seen there, or else within a fingertip's breadth.
struct UnderFinger {
  std::optional<picture::Touched> seen{};  ///< none: scenery, sky or ground
  std::optional<picture::Touched> takeable{};
};
[[nodiscard]] UnderFinger under_finger(const PointerScene& scene, const picture::Sight& sight,
                                       picture::PixelPlace place);

/// One for each thing that can be taken and is seen: a pixel to take it by, from left to right. Slow; for a key.
[[nodiscard]] std::vector<picture::PixelPlace> places_to_take(const PointerScene& scene, const picture::Sight& sight);

/// On the display's thread.
class PointerInput {
 public:
  PointerInput(const std::string& kiosk, std::uint32_t domain)
      : PointerInput(std::make_unique<PointerLink>(kiosk, domain)) {}
  /// Moves another hand than a kiosk's; a test its own.
  explicit PointerInput(std::unique_ptr<PointerTouch> hand) : link_(std::move(hand)) {}

  /// `covered`: a button or a panel lies there.
  void take(const PointerEvent& event, const PointerScene& scene, bool covered);
  /// Once a picture: goes on with keys that are held, and looks what lies under a pointer that moved.
  void update(const PointerScene& scene, TimePoint now);
  /// Nothing is held, pressed, or to be looked for: this picture needs no update().
  [[nodiscard]] bool rests(TimePoint now);
  /// The hand is nowhere: it reaches for nothing and holds nothing.
  [[nodiscard]] bool is_away() const { return link_->view().phase == PointerView::Phase::resting; }
  /// The object that the pointer would take, or else is on; none while it takes one.
  [[nodiscard]] std::optional<picture::Touched> pointed_at() const;
  /// Where a mouse rests that holds nothing, in pixels of the whole picture.
  [[nodiscard]] std::optional<picture::PixelPlace> hovers_at() const {
    return is_away() && !focus_ ? hover_ : std::nullopt;
  }
  /// Another world is shown: what the keys pointed at is gone.
  void forget_world();
  /// Adds what helps to find the way.
  void write(picture::OverlayContent& content, const PointerScene& scene, const std::string& language) const;
  /// Somebody moved the hand since the last call.
  [[nodiscard]] bool take_stirred() { return std::exchange(stirred_, false); }

 private:
  void take_fingers(const PointerEvent& event, const PointerScene& scene);
  void follow(const std::vector<HandRequest>& requests, const PointerScene& scene);
  [[nodiscard]] bool press(const PointerScene& scene, picture::PixelPlace whole);
  void go_on_with_keys(const PointerScene& scene, double dt_s);
  void take_key(PointerKey key, const PointerScene& scene);
  void focus_next(const PointerScene& scene, int step);
  [[nodiscard]] bool held(PointerKey key) const { return held_[static_cast<std::size_t>(key)]; }

  std::unique_ptr<PointerTouch> link_;
  PointerFingers fingers_;
  std::optional<picture::PixelPlace> hover_;  ///< of the whole picture
  bool hover_moved_ = false;
  UnderFinger under_hover_;
  TimePoint looked_;
  TimePoint updated_;
  std::array<bool, kPointerKeys> held_{};     ///< by PointerKey
  std::optional<picture::PixelPlace> focus_;  ///< of the keys, whole picture
  bool by_keys_ = false;                      ///< what is held is held by keys
  PointerMeans means_ = PointerMeans::mouse;  ///< what was used last
  bool stirred_ = false;
};

}  // namespace mechane::pointer
