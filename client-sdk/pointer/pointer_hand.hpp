// What a pointer (a mouse, a finger on glass, keys) makes of a hand: pixels in, a one-point hand out. A press on a thing lets the hand go
// there and close; dragging takes it along; lifting the finger opens it. Pure: no network, no window, no clock of its own.
#pragma once

#include <cstdint>
#include <optional>

#include "client-sdk/picture/render_scene.hpp"
#include "client-sdk/picture/sight.hpp"
#include "client-sdk/pointer/pointer_affordances.hpp"
#include <mechane/client/types.hpp>

namespace mechane::pointer {

/// What the hand can see and feel of the touched object.
struct PointerSenses {
  Pose X_WB;  ///< the touched object's
  Leeway leeway;
  bool holding = false;             ///< the server says so
  std::optional<Quat> R_WB_rest{};  ///< as the exhibit laid it out; a wrist brings what was knocked back to this
};

/// For the picture.
struct PointerView {
  enum class Phase : std::uint8_t { resting, reaching, holding, leaving };
  /// How dragging moves what is held.
  enum class Drag : std::uint8_t { carry, turn, slide };
  Phase phase = Phase::resting;
  Drag drag = Drag::carry;
  std::uint32_t object = 0;
  Vec3 p_WH = Vec3::Zero();
  picture::PixelPlace pointer;  ///< in the eye's picture
  std::optional<Vec3> p_WG{};   ///< carry: where the hand would be, were the thing at the nearest of its goals
  AffordanceLine axle;          ///< turn: through the middle of the hand's circle
  double radius_m = 0;          ///< turn: of the hand's circle
};

/// All on one thread. Values that are not finite, and pixels outside the screen, are ignored.
class PointerHand {
 public:
  using Phase = PointerView::Phase;
  using Drag = PointerView::Drag;

  /// Begins to reach. What was held before is let go.
  void press(const picture::Sight& sight, picture::PixelPlace place, const picture::Touched& touched);
  void move(picture::PixelPlace place);
  /// Takes what is carried away from the viewer: its distance grows by a factor of exp(amount); below 0: nearer.
  void deepen(double amount);
  /// Turns what is held about its axle, or what is carried about the line of sight; positive as the viewer sees the hands of a clock go.
  void turn(double angle_rad);
  void release();

  /// Goes on by dt_s; returns the hand to send, none while nobody touches. `senses` is of view().object.
  [[nodiscard]] std::optional<client::HandSample> advance(double dt_s, const PointerSenses& senses);

  [[nodiscard]] PointerView view() const;

 private:
  void reach(double dt_s, const PointerSenses& senses);
  void grip(const PointerSenses& senses);
  void begin_turn(const AffordanceLine& axle);
  void hold(double dt_s, const PointerSenses& senses);
  void lose(const PointerSenses& senses);
  void leave(double dt_s);
  void let_go();
  [[nodiscard]] Vec3 carried_to(const PointerSenses& senses);
  [[nodiscard]] Vec3 past_obstacle(const Vec3& goal_W, const Vec3& held_W, double dt_s);
  void feel_grip(const PointerSenses& senses, double dt_s);
  [[nodiscard]] Vec3 slid_to() const;
  [[nodiscard]] Vec3 turned_to(const Vec3& p_WG, double dt_s);
  [[nodiscard]] double angle_seen(picture::PixelPlace place) const;
  [[nodiscard]] double angle_of(const Vec3& p_W) const;
  void go_towards(const Vec3& goal_W, double speed_m_per_s, double dt_s);
  void turn_towards(const Quat& goal_R_WH, double speed_rad_per_s, double dt_s);

  Phase phase_ = Phase::resting;
  Drag drag_ = Drag::carry;
  picture::Sight sight_;
  picture::PixelPlace pointer_;
  picture::Touched touched_;
  Pose X_WH_;
  double grasp_ = 0;
  double phase_s_ = 0;          // since the phase began
  int fetched_ = 0;             // in this touch: how often it went back for what it lost
  double empty_s_ = 0;          // holding: since the hand last held something
  Vec3 away_W_ = Vec3::Zero();  // unit, along the pressed pixel's ray
  std::optional<Vec3> p_BT_;    // what was pressed on, in the object's frame
  Pose X_BH_;                   // of the hand in what it holds, as it was gripped
  double depth_m_ = 0;          // carry: of the plane that the pointer drags in
  double gripped_depth_m_ = 0;
  std::optional<Vec3> p_WG_goal_;
  Quat R_WH_wanted_ = Quat::Identity();  // carry
  Quat R_WH_gripped_ = Quat::Identity();
  Quat turned_W_ = Quat::Identity();  // carry: by the visitor, since it was gripped
  bool twisted_ = false;              // carry: the visitor has
  bool knocked_ = false;              // carry: it lies otherwise than it was laid out, or has turned in the grip
  /// Carry: what keeps the thing from going on is passed on the viewer's side.
  struct Obstacle {
    Vec3 rests_W = Vec3::Zero();  // where the thing has been
    double rests_s = 0;           // for so long
    bool passing = false;
    bool stays = false;  // it cannot be passed
    Vec3 from_W = Vec3::Zero(), aside_W = Vec3::Zero();
  };
  Obstacle obstacle_;
  AffordanceLine line_;         // axle or track; its point is where the hand began, or the middle of its circle
  double slid_from_m_ = 0;      // slide: of the pointer along the track when the hand gripped
  Vec3 from_W_ = Vec3::Zero();  // turn: from the axle to the hand when it gripped
  double angle_rad_ = 0;        // turn: of the hand since then
  double wanted_rad_ = 0;       // turn: of the pointer since then
  double seen_rad_ = 0;         // turn: where the pointer stood last
  Eigen::Matrix2d circle_ =
      Eigen::Matrix2d::Identity();  // turn: from the picture to the circle, flattened circles made rounder
  picture::PixelPlace middle_;      // turn: of the circle, in the picture
};

}  // namespace mechane::pointer
