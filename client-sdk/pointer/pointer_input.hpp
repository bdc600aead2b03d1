// From a window's events to the display's own hands, and their hints in the picture: a ring on a thing that can be taken,
// dots along its path, a few words. Input is a mouse, fingers, or keys: Tab goes to the next thing that can be taken,
// Space takes and releases it, arrows move it.
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
#include "client-sdk/pointer/pointer_hands.hpp"

namespace mechane::pointer {

/// The scene in which the pointer acts. Borrowed for the call.
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
  /// Whether hands can take it now, as far as a client knows.
  [[nodiscard]] bool takeable(std::uint32_t object) const;
};

/// What a pixel shows, and what a finger on it takes: the thing at the pixel, or else one within a fingertip's breadth.
struct UnderFinger {
  std::optional<picture::Touched> seen{};  ///< none: scenery, sky or ground
  std::optional<picture::Touched> takeable{};
};
[[nodiscard]] UnderFinger under_finger(const PointerScene& scene, const picture::Sight& sight,
                                       picture::PixelPlace place);

/// For each visible thing that can be taken, a pixel to take it by; from left to right. Slow; for key presses.
[[nodiscard]] std::vector<picture::PixelPlace> places_to_take(const PointerScene& scene, const picture::Sight& sight);

/// On the display's thread.
class PointerInput {
 public:
  explicit PointerInput(MakeHand make) : hands_(std::move(make)) {}
  PointerInput(const std::string& kiosk, std::uint32_t domain)
      : PointerInput([kiosk, domain] { return std::make_unique<PointerLink>(kiosk, domain); }) {}
  /// Moves this hand and no other.
  explicit PointerInput(std::unique_ptr<PointerTouch> hand);

  /// `covered`: a button or a panel lies there.
  void take(const PointerEvent& event, const PointerScene& scene, bool covered);
  /// Call it once a picture: applies keys that are held, and finds what lies under a pointer that moved.
  void update(const PointerScene& scene, TimePoint now);
  /// Whether this picture needs no update(): nothing is held or pressed, and the pointer has not moved.
  [[nodiscard]] bool rests(TimePoint now);
  /// Whether all hands are at rest: none reaches for or holds anything.
  [[nodiscard]] bool is_away() const { return hands_.all_rest(); }
  /// The object that the pointer would take, or else is on; none while one is taken.
  [[nodiscard]] std::optional<picture::Touched> pointed_at() const;
  /// Where a mouse that holds nothing is, in pixels of the whole picture.
  [[nodiscard]] std::optional<picture::PixelPlace> hovers_at() const {
    return is_away() && !focus_ ? hover_ : std::nullopt;
  }
  /// Another world is shown: forgets what the keys pointed at.
  void forget_world();
  /// Adds the hints to the overlay.
  void write(picture::OverlayContent& content, const PointerScene& scene, const std::string& language) const;
  /// Whether somebody moved a hand since the last call.
  [[nodiscard]] bool take_stirred() { return std::exchange(stirred_, false); }

 private:
  /// What a press takes, and from where it is seen.
  struct Target {
    picture::Sight sight;
    picture::PixelPlace place;  ///< in the eye's picture
    picture::Touched touched;
  };
  void take_fingers(const PointerEvent& event, const PointerScene& scene);
  void follow(const std::vector<HandOrder>& orders, const PointerScene& scene, const std::optional<Target>& target);
  [[nodiscard]] static std::optional<Target> target_at(const PointerScene& scene, picture::PixelPlace whole);
  [[nodiscard]] bool press(std::size_t hand, const std::optional<Target>& target);
  void go_on_with_keys(const PointerScene& scene, double dt_s);
  void take_key(PointerKey key, const PointerScene& scene);
  void focus_next(const PointerScene& scene, int step);
  [[nodiscard]] bool held(PointerKey key) const { return held_[static_cast<std::size_t>(key)]; }

  [[nodiscard]] PointerTouch* meant(FingerId finger) const {
    return keys_hand_ ? hands_.at(*keys_hand_) : hands_.meant(finger);
  }

  PointerHands hands_;
  std::optional<picture::PixelPlace> hover_;  ///< of the whole picture
  bool hover_moved_ = false;
  UnderFinger under_hover_;
  TimePoint looked_;
  TimePoint updated_;
  std::array<bool, kPointerKeys> held_{};     ///< by PointerKey
  std::optional<picture::PixelPlace> focus_;  ///< where the keys point, in the whole picture
  std::optional<std::size_t> keys_hand_;      ///< the hand that keys took something with
  PointerMeans means_ = PointerMeans::mouse;  ///< what was used last
  bool stirred_ = false;
};

}  // namespace mechane::pointer
