// Plays a scenario's scripted visit: computes what a person's hand would intend at each moment.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client-sdk/haptic/virtual_hand.hpp"
#include "client-sdk/visitor/grasp_reason.hpp"
#include "server/state/description.hpp"

namespace mechane::haptic {
class HapticLoop;
}

namespace mechane::visitor {

using HandJoints = std::array<double, client::kHandJoints>;

/// The result of one move.
struct MoveResult {
  std::string name;  ///< "reach INNER"
  double seconds = 0;
  bool ok = true;  ///< false: a grasp that caught nothing, a carry with an empty hand
  std::optional<FailedGrasp> failed_grasp{};
  std::string reason{};  ///< why a grasp failed; filled in by code that knows the world's status
};

struct PlayerConfig {
  Pose X_WH_rest{Vec3(0, 1.2, 1.5), Quat::Identity()};  ///< where the hand waits
  Vec3 offset_W = Vec3::Zero();  ///< added to each goal of the hand, to imitate a visitor who misses
  client::HandKind kind = client::HandKind::one_point;
  client::HandSide side = client::HandSide::right;
  /// A whole hand turns towards its goal and bends its fingers; false: the wrist keeps its rotation.
  bool shapes_hand = true;
  double grasp_patience_s = 2;  ///< how long a grasp is tried before the visit continues without it
  /// The hand waits, like one that only sees, for a thing that it holds and that lags by more than this. None: it pulls on.
  std::optional<double> waits_for_lag_m{};
  int fetch_again = 4;  ///< how often the hand goes back for a thing that it lost while carrying or working it
};

/// What a person knows of the own hand without looking.
struct HandSense {
  bool holding = false;      ///< it holds something, according to the server
  double felt_n = 0;         ///< how strong its touch is
  Vec3 f_W = Vec3::Zero();   ///< the force on it, N; zero where a device renders none
  Vec3 p_WH = Vec3::Zero();  ///< where it is: not where it is intended, once something resists it
  std::optional<Vec3>
      p_HG{};  ///< where in the hand it holds a handle, in the hand's frame; none where it holds nothing, or no handle
};

/// One visit, from rest to rest. Deterministic for given inputs. One thread; advance() allocates only when a move ends.
class VisitPlayer {
 public:
  /// Both must outlive the player.
  VisitPlayer(const state::WorldDescription& description, const state::VisitDescription& visit,
              const PlayerConfig& config);

  /// Advances by dt_s. `X_WB`: the bodies' poses as last seen, in the order of the description. Like a person's, the hand closes
  /// as soon as it feels its goal, follows the goal by sight until it has caught it, and then presses against it no more than its
  /// work asks: a handle that goes round keeps the hand on its circle.
  void advance(double dt_s, std::span<const Pose> X_WB, const HandSense& hand);

  /// The visitor is shown another step of the activity: what is to be tried again begins with the present move.
  void note_step() { step_move_ = index_; }
  /// After the last move, where the step is still not done: the hand opens, and makes the step's moves again from the reach before them.
  void try_step_again();

  [[nodiscard]] const haptic::HandIntent& intent() const { return intent_; }
  [[nodiscard]] bool finished() const { return index_ >= visit_.moves.size(); }
  [[nodiscard]] std::span<const MoveResult> results() const { return results_; }

 private:
  void begin_move(std::span<const Pose> X_WB, const HandSense& hand);
  /// Where the hand has to be to take what this move reaches for, or grasps.
  [[nodiscard]] Vec3 grip_W(std::span<const Pose> X_WB) const;
  [[nodiscard]] double to_grip_m(std::span<const Pose> X_WB) const;
  [[nodiscard]] bool waits(std::span<const Pose> X_WB, bool holding, double dt_s);
  /// Returns whether it stops beside the thing, and goes the rest of the way slowly, closing.
  bool shape_hand(std::span<const Pose> X_WB);
  [[nodiscard]] bool taken_from_side(std::span<const Pose> X_WB) const;
  void bend_fingers(bool holding);
  /// True when the move is over.
  bool continue_move(std::span<const Pose> X_WB, const HandSense& hand);
  [[nodiscard]] bool touched_what_it_reaches_for(std::span<const Pose> X_WB, double felt_n) const;
  void follow_grip(std::span<const Pose> X_WB);
  [[nodiscard]] bool presses(const HandSense& hand) const;
  void stay_at(const Vec3& p_WH, const HandSense& hand);
  [[nodiscard]] bool reaches_again(std::span<const Pose> X_WB);
  [[nodiscard]] bool grasps_next() const;
  void move_hand_towards_goal();
  bool turn(const state::VisitMove& move, const HandSense& hand);
  bool swing(const state::VisitMove& move, const HandSense& hand);
  /// Advances a motion of `whole` radians at up to `rate` by one tick, with acceleration and deceleration; returns its
  /// angle.
  double go_through(double whole_rad, double rate_rad_per_s);
  [[nodiscard]] Pose frame_of(const state::JointDescription& joint) const;
  void go_round(JointId joint, double angle_rad, const HandSense& hand);
  void end_move(bool again);
  [[nodiscard]] bool slipped(std::span<const Pose> X_WB, bool holding) const;
  void note_grasp(std::span<const Pose> X_WB, double felt_n);
  void note_grip(std::span<const Pose> X_WB, const HandSense& hand);
  [[nodiscard]] bool lost_its_handle() const;
  void fetch_again();

  const state::WorldDescription& description_;
  const state::VisitDescription& visit_;
  PlayerConfig config_;
  haptic::HandIntent intent_;
  std::vector<MoveResult> results_;
  // Angle of each turn and swing so far, over all tries; the rest is done when the handle is caught again.
  std::vector<double> done_rad_;
  std::size_t index_ = 0;
  std::size_t last_reach_ = 0;  // the move in which the hand reached for what it carries
  std::size_t step_move_ = 0;   // the move in which the present step began
  int fetched_again_ = 0;       // since the visit first made that reach
  int reached_again_ = 0;       // the same, for a thing that was no longer there
  bool begun_ = false;
  bool ok_ = true;
  double time_s_ = 0;  // in this move
  double duration_s_ = 0;
  double last_dt_s_ = 0;
  bool held_ = false;     // the hand held something at some moment of this move
  double held_rad_ = 0;   // the angle at which the hand last held something in this move
  FailedGrasp grasp_;     // this move, as long as it has caught nothing
  double waited_s_ = 0;   // for the thing, since it last did not lag
  double to_grip_m_ = 0;  // from the hand to what it holds, when this move began
  double empty_s_ = 0;    // time since the hand last held something in this move
  Pose X_WH_start_;
  Pose X_WH_goal_;
  Vec3 p_WG_reached_ = Vec3::Zero();  // where the grip was when this reach began
  Vec3 p_WH_caught_ = Vec3::Zero();   // where the hand was when it first held something in this move
  Vec3 arm_J_ = Vec3::Zero();         // from the joint of a turn or swing to the grip, where this move begins
  Vec3 p_HG_W_ = Vec3::Zero();        // from the hand to its grip, in this turn or swing
  double turned_rad_ = 0;             // angle of a turn, or phase of a swing
  double swing_from_rad_ = 0;         // the joint's angle at the start of the swing
  Vec3 p_BG_ = Vec3::Zero();          // the grip of the last reach, in the body
  Vec3 p_HG_ = Vec3::Zero();          // the same in the hand
  double seen_rad_ = 0;               // how far the joint of this move has turned, by sight
  double seen_at_rad_ = 0;            // its angle when it was last seen
  double over_m_ = 0;                 // how far above its goal the hand is before it goes down
  HandJoints joints_goal_{};
};

/// For a hand with such a device: its kind, and that one before a camera waits.
[[nodiscard]] PlayerConfig fitted(PlayerConfig config, const haptic::VirtualChoice& device);

/// The hand in the device, after a tick of its loop. Without force feedback it feels what it overlaps, because displays highlight that.
[[nodiscard]] HandSense sense_hand(const haptic::SimulatedDevice& device, const haptic::HapticLoop& loop);

/// The reach with which a visitor begins who tries to do move `from` again, and what follows it: the last one up to there.
[[nodiscard]] std::size_t reach_before(const state::VisitDescription& visit, std::size_t from);
/// For reports: "reach INNER".
[[nodiscard]] std::string name_of(const state::WorldDescription& description, const state::VisitMove& move);
/// A hinge's angle within half a turn, from the poses of the bodies.
[[nodiscard]] double joint_angle(const state::JointDescription& joint, std::span<const Pose> X_WB);
/// The minimum-jerk course of a hand from 0 to 1 over s in 0..1 (Flash and Hogan 1985).
[[nodiscard]] double minimum_jerk(double s);

}  // namespace mechane::visitor
