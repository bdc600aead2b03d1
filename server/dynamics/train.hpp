// Constraint rows over any number of bodies, for couplings; solved together with Bullet's rows.
//
// Bullet's constraints act on two bodies. A gear between two joints moves up to four, a rope as many as it has sheaves; with two
// (btGearConstraint) the bearing's reaction is lost, a gear on a turning frame has the wrong ratio, and errors of position stay.
// So these rows are swept by our own code after each of Bullet's sweeps, over the same velocities.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "server/dynamics/rows.hpp"

namespace mechane::dynamics {

inline constexpr std::size_t kGround = std::numeric_limits<std::size_t>::max();  ///< instead of a body: the world

/// A body's share in a row's value: n.v + a.w, of its centre of mass.
struct TrainTerm {
  std::size_t body = 0;
  Vec3 n_W = Vec3::Zero();
  Vec3 a_W = Vec3::Zero();
  Vec3 v_per_impulse = Vec3::Zero();  ///< what an impulse of 1 along the row does to the body
  Vec3 w_per_impulse = Vec3::Zero();
};

/// How far a row's impulse may go.
enum class TrainLimit {
  none,      ///< an equality
  range,     ///< from low to high
  friction,  ///< up to `high` times the size of the leader's impulse, either way
  sheave,    ///< low to high times the tension before the sheave: the leader's (negative) impulse and those since
};

struct TrainRow {
  std::vector<TrainTerm> terms;  ///< capacity for every body
  double target = 0;
  TrainLimit limit = TrainLimit::none;
  std::size_t leader = 0;
  double low = 0;
  double high = 0;
  double impulse = 0;  ///< found by the solver
  double wanted = 0;   ///< the part of the target that the bodies' velocities do not meet yet
  double response =
      0;  ///< of the value to an impulse of 1; 0: nothing can move it, or it repeats others; it is left out
};

/// Rows of one step. One thread; only reserve() allocates.
class Train {
 public:
  void reserve(std::size_t rows, std::size_t bodies);
  void clear() noexcept { count_ = 0; }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] std::span<const TrainRow> rows() const noexcept { return {rows_.data(), count_}; }

  /// A new row without terms, and its index. reserve() must have left room.
  std::size_t add(double target, TrainLimit limit = TrainLimit::none, double low = 0, double high = 0,
                  std::size_t leader = 0) noexcept;
  /// Adds to the last row's value n.v + a.w of a body. Does nothing for the ground and for bodies that do not move.
  void add_term(std::size_t body, const Vec3& n_W, const Vec3& a_W, std::span<const Frame> frames) noexcept;
  /// Adds `factor` times another row, of body1 and body2, with its target.
  void add_row(const Row& row, std::size_t body1, std::size_t body2, double factor,
               std::span<const Frame> frames) noexcept;

  /// The bodies that the rows move, after combine(): others need no velocities.
  [[nodiscard]] std::span<const std::size_t> bodies() const noexcept { return bodies_; }

  /// Combines the rows so that equalities do not disturb each other, nor the others them (see decouple() in rows.hpp). Rows that
  /// repeat others are left out.
  void combine(std::span<const Frame> frames) noexcept;
  /// The bodies' velocities before any impulse.
  void begin(std::span<const Twist> V) noexcept;
  /// Goes once over all rows; adds to what impulses have done to the bodies' velocities. Returns the square of the greatest change.
  double sweep(std::span<Twist> delta) noexcept;
  /// The impulse along the row as it was added.
  [[nodiscard]] double impulse_of(std::size_t row) const noexcept;

 private:
  [[nodiscard]] double mixed(std::size_t i, std::size_t k) const noexcept { return mix_[i * rows_.size() + k]; }
  [[nodiscard]] static double response(const TrainRow& a, const TrainRow& b) noexcept;
  static void respond(TrainRow& row, std::span<const Frame> frames) noexcept;
  void subtract(std::size_t from, std::size_t row, double share) noexcept;
  void scale(std::size_t row, double factor) noexcept;
  [[nodiscard]] std::pair<double, double> limits_of(std::size_t i) const noexcept;

  std::vector<TrainRow> rows_;
  std::size_t count_ = 0;
  std::vector<std::size_t> bodies_;
  std::vector<char> seen_;   // by body: it is in bodies_
  std::vector<double> mix_;  // row i as combined is the sum of mixed(i, k) times row k as added
};

}  // namespace mechane::dynamics
