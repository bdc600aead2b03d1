// Plays a scenario's scripted visit: what a person's hand would mean to do, moment by moment.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client-sdk/haptic/virtual_device.hpp"
#include "client-sdk/visitor/grasp_reason.hpp"
#include "server/state/description.hpp"

namespace mechane::visitor {

using HandJoints = std::array<double, client::kHandJoints>;

/// What came of one move.
struct MoveResult {
  std::string name;  ///< "reach INNER"
  double seconds = 0;
  bool ok = true;  ///< a grasp that caught nothing, a carry with an empty hand: false
  std::optional<FailedGrasp> failed_grasp{};
  std::string reason{};  ///< why the grasp failed; the player leaves it to who sees the world's status
};

struct PlayerConfig {
  Pose X_WH_rest{Vec3(0, 1.2, 1.5), Quat::Identity()};  ///< where the hand waits
  Vec3 offset_W = Vec3::Zero();  ///< added to every place that the hand reaches for: a visitor who misses
  client::HandKind kind = client::HandKind::one_point;
  bool shapes_hand =
      true;  ///< a whole hand turns to what it reaches for, and bends its fingers; else the wrist goes there as it is
  double grasp_patience_s = 2;  ///< how long a grasp is tried before the visit goes on without it
  int fetch_again = 2;  ///< how often the hand goes back for what it lost: on its way, or a handle that it worked
};

/// One visit, from rest to rest. Deterministic in what it is told. One thread; advance() allocates only when a move ends.
class VisitPlayer {
 public:
  /// Both outlive the player.
  VisitPlayer(const state::WorldDescription& description, const state::VisitDescription& visit,
              const PlayerConfig& config);

  /// Goes on by dt_s. `X_WB` are the bodies' poses in the order of the description, as last seen; `holding` is the server's word;
  /// `felt_n` the force on the hand. As a person would, the hand closes as soon as it feels what it reaches for, and follows it with
  /// the eyes while it has not caught it.
  void advance(double dt_s, std::span<const Pose> X_WB, bool holding, double felt_n);

  [[nodiscard]] const haptic::HandIntent& intent() const { return intent_; }
  [[nodiscard]] bool finished() const { return index_ >= visit_.moves.size(); }
  [[nodiscard]] std::span<const MoveResult> results() const { return results_; }

 private:
  void begin_move(std::span<const Pose> X_WB);
  void shape_hand();
  void bend_fingers(bool holding);
  /// True when the move is over.
  bool continue_move(std::span<const Pose> X_WB, bool holding, double felt_n);
  [[nodiscard]] bool touched_what_it_reaches_for(double felt_n) const;
  void follow_grip(std::span<const Pose> X_WB);
  void move_hand_towards_goal(double duration_s);
  bool turn(const state::VisitMove& move);
  bool swing(const state::VisitMove& move);
  /// Goes on by a tick of a motion of `whole` radians at up to `rate`, speeding up and slowing down; returns how far it is.
  double go_through(double whole_rad, double rate_rad_per_s);
  void go_round(JointId joint, double angle_rad);
  void end_move(bool ok);
  [[nodiscard]] bool slipped(std::span<const Pose> X_WB, bool holding) const;
  void note_grasp(std::span<const Pose> X_WB, double felt_n);
  void note_grip(bool holding);
  [[nodiscard]] bool lost_its_handle() const;
  void fetch_again();

  const state::WorldDescription& description_;
  const state::VisitDescription& visit_;
  PlayerConfig config_;
  haptic::HandIntent intent_;
  std::vector<MoveResult> results_;
  std::vector<double>
      done_rad_;  // of each turn and swing, with the handle in the hand, over all tries: what is left is done when the handle is caught again
  std::size_t index_ = 0;
  std::size_t last_reach_ = 0;  // the move that the hand went for what it carries
  int fetched_again_ = 0;       // since the visit first came to that reach
  bool begun_ = false;
  bool ok_ = true;
  double time_s_ = 0;  // in this move
  double last_dt_s_ = 0;
  bool held_ = false;    // at some moment of this move
  double held_rad_ = 0;  // turned when the hand last held something in this move
  FailedGrasp grasp_;    // this move, while it is one that catches nothing
  double empty_s_ = 0;   // since the hand last held something in this move
  Pose X_WH_start_;
  Pose X_WH_goal_;
  double turned_rad_ = 0;      // of a turn, or of a swing's phase
  double swing_from_rad_ = 0;  // where the joint stood when the swing began
  Vec3 p_BG_ = Vec3::Zero();   // the grip that the last reach was for
  Vec3 p_HG_ = Vec3::Zero();   // where the hand has it
  double over_m_ = 0;          // how far over its goal the hand comes before it goes down on it
  HandJoints joints_goal_{};
};

/// The minimum-jerk course of a hand from 0 to 1 over s in 0..1 (Flash and Hogan 1985).
[[nodiscard]] double minimum_jerk(double s);

}  // namespace mechane::visitor
