// Plays a scenario's scripted visit as a person with a mouse before a display's picture: presses on what the visit reaches for, drags it,
// rolls the wheel, goes round what turns. What is under a pixel, what can be taken and how the hand then moves are the display's own code.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "client-sdk/pointer/pointer_input.hpp"
#include "client-sdk/visitor/shown_exhibit.hpp"
#include "client-sdk/visitor/visit_player.hpp"

namespace mechane::visitor {

/// What the person sees of the world at a moment. Borrowed for the call.
struct PointerSight {
  const client::Frame& frame;
  const client::WorldStatus& status;  ///< of it, `enabled_agents` counts
  std::span<const Pose> X_WB;         ///< of that frame, in the order of the description
  bool holding = false;               ///< the display shows that the person's hand holds something
};

/// One visit. One thread.
class PointerPlayer {
 public:
  /// Between two pictures, s and milliseconds: the person looks as often.
  static constexpr int kTicksPerPicture = 16;
  static constexpr double kPicture_s = kTicksPerPicture * kTickSeconds;

  /// All but `hand`, which the mouse moves, must outlive the player.
  PointerPlayer(ShownExhibit& shown, const state::WorldDescription& description, const state::VisitDescription& visit,
                std::unique_ptr<pointer::PointerTouch> hand);
  PointerPlayer(const PointerPlayer&) = delete;
  PointerPlayer& operator=(const PointerPlayer&) = delete;

  /// Looks at the next picture, and moves the mouse.
  void look(const PointerSight& seen);
  /// As of VisitPlayer.
  void note_step() { step_move_ = index_; }
  void try_step_again();
  /// The object that was clicked, as a sign is, since the last call: its number in the manifest.
  [[nodiscard]] std::optional<std::uint32_t> take_click() { return std::exchange(click_, std::nullopt); }

  [[nodiscard]] bool finished() const { return index_ >= visit_.moves.size(); }
  [[nodiscard]] std::span<const MoveResult> results() const { return results_; }

 private:
  /// The way round an axle in the picture.
  struct Round {
    picture::PixelPlace middle;
    Eigen::Matrix2d from_circle = Eigen::Matrix2d::Zero();
    [[nodiscard]] picture::PixelPlace at(double angle_rad) const;
  };

  [[nodiscard]] const state::VisitMove& move() const { return visit_.moves[index_]; }
  [[nodiscard]] const state::JointDescription& joint() const { return description_.joints[move().joint.index()]; }
  [[nodiscard]] const Pose& pose_of(BodyId body) const { return seen_->X_WB[body.index()]; }
  [[nodiscard]] bool resting() { return hand_.view().phase == pointer::PointerView::Phase::resting; }
  [[nodiscard]] bool holds();
  void begin();
  /// True when the move is over.
  [[nodiscard]] bool go_on();
  /// Whether this reach is for a grasp.
  [[nodiscard]] bool takes() const;
  [[nodiscard]] Vec3 grip_W() const;
  void touch();
  bool take();
  [[nodiscard]] std::optional<picture::PixelPlace> place_to_press(std::size_t which);
  bool carry();
  bool arrives();
  bool work();
  [[nodiscard]] std::optional<Round> way_round();
  [[nodiscard]] static std::optional<Round> round_of(const picture::Sight& sight, const pointer::AffordanceLine& axle,
                                                     const Vec3& p_WH, double least_round);
  bool turn();
  bool swing();
  [[nodiscard]] bool lacks();
  [[nodiscard]] bool lost();
  [[nodiscard]] const picture::Sight& sight();
  [[nodiscard]] pointer::PointerScene under_mouse(const picture::RenderScene& scene) const;
  void say(pointer::PointerEvent::Kind kind, double amount = 0);
  void go_to(picture::PixelPlace place);
  void roll(double deeper);

  ShownExhibit& shown_;
  const state::WorldDescription& description_;
  const state::VisitDescription& visit_;
  pointer::PointerTouch& hand_;  // of input_
  pointer::PointerInput input_;
  const PointerSight* seen_ = nullptr;  // within look()
  std::optional<picture::Sight> sight_;
  picture::RenderScene scene_;  // of the last press
  std::optional<std::uint32_t> click_;
  // The visit.
  std::vector<MoveResult> results_;
  std::vector<double> done_rad_;  // of each turn, over all tries
  std::size_t index_ = 0;
  std::size_t last_reach_ = 0;
  std::size_t step_move_ = 0;
  int fetched_ = 0;
  picture::PixelPlace at_;  // the mouse
  // This move.
  bool begun_ = false, ok_ = true, pressed_ = false;
  std::size_t presses_ = 0;
  double time_s_ = 0, since_s_ = 0, still_s_ = 0;
  Vec3 p_WH_seen_ = Vec3::Zero();
  picture::PixelPlace from_, to_;
  Vec3 p_WG_goal_ = Vec3::Zero();
  double from_depth_m_ = 0, rolled_ = 0;
  std::optional<Round> round_;
  double seen_rad_ = 0, seen_at_rad_ = 0;  // of the joint: since the move began, and now
  double swing_from_rad_ = 0, gone_rad_ = 0, finger_rad_ = 0;
};

}  // namespace mechane::visitor
