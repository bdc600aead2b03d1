// Moves a one-point hand by a pointer (a mouse, a finger on glass, keys). A press on a thing makes the hand go there
// and close; dragging carries the thing along; lifting the finger opens the hand. Pure: no network, no window, no clock
// of its own.
#pragma once

#include <cstdint>
#include <optional>

#include "client-sdk/picture/render_scene.hpp"
#include "client-sdk/picture/sight.hpp"
#include "client-sdk/pointer/pointer_affordances.hpp"
#include <mechane/client/types.hpp>

namespace mechane::pointer {

/// What the hand knows of the touched object.
struct PointerSenses {
  Pose X_WB;  ///< the touched object's
  Leeway leeway;
  bool holding = false;  ///< the hand holds it, according to the server
  std::optional<Quat>
      R_WB_rest{};  ///< its rotation in the exhibit's initial layout; a knocked thing is turned back to this
};

/// What a client knows of the world. Borrowed for the call.
struct PointerWorld {
  const client::Frame* frame = nullptr;  ///< null until the first one has come
  std::span<const client::SceneObject> objects;
  const client::WorldPresentation* presentation = nullptr;
  std::span<const std::string> enabled;  ///< agents of the present step
};
/// What it means for a hand at this object; none: the object or the presentation is not known yet.
[[nodiscard]] std::optional<PointerSenses> senses_of(const PointerWorld& world, std::uint32_t object, bool holding);

/// For the picture.
struct PointerView {
  enum class Phase : std::uint8_t { resting, reaching, holding, leaving };
  /// How dragging moves the held thing.
  enum class Drag : std::uint8_t { carry, turn, slide };
  Phase phase = Phase::resting;
  Drag drag = Drag::carry;
  std::uint32_t object = 0;
  Vec3 p_WH = Vec3::Zero();
  picture::PixelPlace pointer;  ///< in the eye's picture
  std::optional<Vec3> p_WG{};   ///< carry: the hand's position with the thing at its nearest goal
  AffordanceLine axle;          ///< turn: the axis through the middle of the hand's circle
  double radius_m = 0;          ///< turn: of the hand's circle
};

/// All on one thread. Values that are not finite, and pixels outside the screen, are ignored.
class PointerHand {
 public:
  using Phase = PointerView::Phase;
  using Drag = PointerView::Drag;

  /// Begins to reach. A thing that is still held is released.
  void press(const picture::Sight& sight, picture::PixelPlace place, const picture::Touched& touched);
  void move(picture::PixelPlace place);
  /// Moves the carried thing away from the viewer: its distance grows by a factor of exp(amount); below 0: nearer.
  void deepen(double amount);
  /// Turns the held thing about its axle, or a carried thing about the line of sight; positive is clockwise for the
  /// viewer.
  void turn(double angle_rad);
  void release();

  /// Advances by dt_s; returns the hand to send, none while nobody touches. `senses` is of view().object.
  [[nodiscard]] std::optional<client::HandSample> advance(double dt_s, const PointerSenses& senses);

  [[nodiscard]] PointerView view() const;

 private:
  void reach(double dt_s, const PointerSenses& senses);
  void go_with(const Vec3& p_WT, double dt_s);
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
  int fetched_ = 0;             // how often the hand went back for a lost thing in this touch
  double empty_s_ = 0;          // holding: time since the hand last held something
  Vec3 away_W_ = Vec3::Zero();  // unit, along the pressed pixel's ray
  std::optional<Vec3> p_BT_;    // the pressed point, in the object's frame
  double near_s_ = 0;           // reaching: how long it has been before the thing
  std::optional<Vec3> p_WT_;    // where a hand that is before it saw it last
  Vec3 owed_W_ = Vec3::Zero();  // how far it has moved since, as far as the hand has not gone with it
  Pose X_BH_;                   // of the hand in the held thing, at the grip
  double depth_m_ = 0;          // carry: depth of the plane in which the pointer drags
  double gripped_depth_m_ = 0;
  std::optional<Vec3> p_WG_goal_;
  Quat R_WH_wanted_ = Quat::Identity();  // carry
  Quat R_WH_gripped_ = Quat::Identity();
  Quat turned_W_ = Quat::Identity();  // carry: the visitor's rotation since the grip
  bool twisted_ = false;              // carry: the visitor has turned it
  bool knocked_ = false;              // carry: it was tilted from its initial layout, or has turned in the grip
  /// Carry: passes an obstacle on the viewer's side.
  struct Obstacle {
    Vec3 rests_W = Vec3::Zero();  // where the thing has been resting
    double rests_s = 0;           // and for how long
    bool passing = false;
    bool stays = false;  // it cannot be passed
    Vec3 from_W = Vec3::Zero(), aside_W = Vec3::Zero();
  };
  Obstacle obstacle_;
  AffordanceLine line_;         // axle or track; its point is the hand's start, or the middle of the hand's circle
  double slid_from_m_ = 0;      // slide: the pointer's place along the track at the grip
  Vec3 from_W_ = Vec3::Zero();  // turn: from the axle to the hand at the grip
  double angle_rad_ = 0;        // turn: the hand's angle since then
  double wanted_rad_ = 0;       // turn: the pointer's angle since then
  double seen_rad_ = 0;         // turn: the pointer's last angle in the picture
  // turn: from the picture to the circle, with flat ellipses made rounder
  Eigen::Matrix2d circle_ = Eigen::Matrix2d::Identity();
  picture::PixelPlace middle_;  // turn: the circle's middle in the picture
};

}  // namespace mechane::pointer
