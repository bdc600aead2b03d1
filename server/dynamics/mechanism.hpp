// The rows of all joints, couplings and grips of one step, solved together.
//
// Equalities are solved directly: their matrix J M^-1 J^T is factored within its profile, which is narrow, because joints of a machine
// form trees with short loops. What has limits (friction, stops, ropes, grips) is left as a small dense system with the equalities
// already eliminated. Contacts come in as rows with limits (see contact_solver.hpp).
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "server/dynamics/rows.hpp"

namespace mechane::dynamics {

inline constexpr std::size_t kGround = std::numeric_limits<std::size_t>::max();  ///< instead of a body: the world

/// How far a row's impulse may go.
enum class RowLimit {
  none,      ///< an equality
  range,     ///< from low to high
  friction,  ///< from -`high` to `high` times the size of the leader's impulse; the leader must not be an equality
  sheave,    ///< low to high times the tension before the sheave: the leader's (negative) impulse and those since
};

/// A row of a step.
struct MechanismRow {
  double target = 0;
  RowLimit limit = RowLimit::none;
  std::size_t leader = 0;
  double low = 0;
  double high = 0;
  double softness = 0;
};

/// Rows of one step. One thread; only reserve() allocates.
class Mechanism {
 public:
  /// Room for so many rows with so many terms in all, which move up to `tied` of the bodies; more are a bug.
  void reserve(std::size_t rows, std::size_t terms, std::size_t bodies, std::size_t tied);
  void clear() noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return rows_.size(); }

  /// A new row without terms, and its index.
  std::size_t add(const MechanismRow& row) noexcept;
  /// Adds to the last row's value n.v + a.w of a body. Does nothing for the ground and for bodies that do not move.
  void add_term(std::size_t body, const Vec3& n_W, const Vec3& a_W, std::span<const Frame> frames) noexcept;
  /// Adds `factor` times another row, of body1 and body2, without its target.
  void add_terms(const Row& row, std::size_t body1, std::size_t body2, double factor,
                 std::span<const Frame> frames) noexcept;
  /// A new row of body1 and body2, with its target and its limits, and its index.
  std::size_t add_row(const Row& row, std::size_t body1, std::size_t body2, std::span<const Frame> frames) noexcept;

  /// The bodies that the rows move, after factor().
  [[nodiscard]] std::span<const std::size_t> bodies() const noexcept { return bodies_; }

  /// Whether the rows move a body, after factor(); never the ground.
  [[nodiscard]] bool moves(std::size_t body) const noexcept { return body != kGround && seen_[body] != 0; }

  /// Prepares the rows for solve(). Equalities that repeat others, to a billionth of their response, are left out and get no impulse.
  /// Rows with limits, on bodies that are in bodies() already, may be added afterwards; then call this again.
  void factor() noexcept;
  /// Finds the impulses. `V`: by body, its velocity without them. May be called again for other velocities; it then begins with the
  /// impulses found.
  void solve(std::span<const Twist> V) noexcept;
  /// After solve(): makes respond() ready for these bodies (some of bodies()).
  void condense(std::span<const std::size_t> bodies, std::span<const Frame> frames) noexcept;
  /// Solves again, for velocities that differ from those of solve() by `pushes`, of the condensed bodies in order. Much cheaper than
  /// solve(), but finds only change() of these bodies.
  void respond(std::span<const Twist> pushes) noexcept;
  /// What the impulses do to a body's velocity; for those in bodies().
  [[nodiscard]] const Twist& change(std::size_t body) const noexcept { return change_[body]; }
  [[nodiscard]] double impulse_of(std::size_t row) const noexcept { return solved_[row].impulse; }

 private:
  struct Term {
    std::size_t body = 0;
    Vec3 n_W = Vec3::Zero();
    Vec3 a_W = Vec3::Zero();
    Vec3 v_per_impulse = Vec3::Zero();
    Vec3 w_per_impulse = Vec3::Zero();
  };
  /// What factor() and solve() find for a row.
  struct Solved {
    std::size_t first_term = 0;
    std::size_t end_term = 0;
    std::size_t group = kGround;  // the body that stands for those that rows tie to its own; kGround: it moves none
    std::size_t first = 0;        // equality in whose column its row of the factor begins, and
    std::size_t end = 0;          // before which it ends
    std::size_t place = 0;        // among the limited
    double response = 0;          // of the row's value to an impulse of 1
    double inverse = 0;           // of the factor's diagonal; 0: left out
    double wanted = 0;            // the part of the target that the velocities do not meet
    double impulse = 0;
  };

  [[nodiscard]] std::span<const Term> terms_of(std::size_t row) const noexcept {
    return {terms_.data() + solved_[row].first_term, terms_.data() + solved_[row].end_term};
  }
  [[nodiscard]] double* factor_of(std::size_t row) noexcept { return &factor_[row * rows_.capacity()]; }
  [[nodiscard]] double* matrix_of(std::size_t place) noexcept { return &matrix_[place * rows_.capacity()]; }
  [[nodiscard]] double shared(std::size_t a, std::size_t b) const noexcept;
  void collect(std::size_t from) noexcept;
  [[nodiscard]] std::size_t group_of(std::size_t body) noexcept;
  double eliminate(std::size_t row, std::size_t before) noexcept;
  void fill_matrix(std::size_t place) noexcept;
  void meet_equalities() noexcept;
  [[nodiscard]] double* column_of(std::size_t column) noexcept { return &columns_[column * rows_.capacity()]; }
  void make_column(std::size_t column) noexcept;
  void solve_limited() noexcept;
  double sweep() noexcept;
  void leap() noexcept;
  void solve_free() noexcept;
  bool go_as_far_as_limits() noexcept;
  void spread() noexcept;
  [[nodiscard]] std::pair<double, double> limits_of(std::size_t row) const noexcept;

  std::vector<MechanismRow> rows_;
  std::vector<Term> terms_;  // row by row
  std::vector<Solved> solved_;
  std::vector<std::size_t> equal_;    // the equalities
  std::vector<std::size_t> limited_;  // the others
  std::vector<std::size_t> bodies_;
  std::vector<std::size_t> first_of_;  // by body: the first equality that moves it
  std::vector<char> seen_;             // by body: it is in bodies_
  std::vector<std::size_t>
      next_;  // by body: another that rows tie it to, nearer to the one that stands for their group, or itself
  std::vector<std::size_t>
      end_of_;                  // by the body that stands for a group: behind the last equality that moves one of them
  std::vector<Twist> change_;   // by body
  std::vector<double> factor_;  // a row's coefficients over equal_
  std::vector<double> matrix_;  // over limited_, with the equalities eliminated
  std::vector<double> left_;    // by equality, in a solve
  std::vector<double> wanted_;  // by limited row, with the equalities eliminated
  std::vector<double> impulses_;   // likewise
  std::vector<std::size_t> free_;  // places of those that are within their limits
  std::vector<double> free_factor_;
  std::vector<double> step_;
  std::span<const std::size_t> condensed_;  // bodies
  std::span<const Frame> frames_;           // theirs
  // left_ and wanted_, one after the other: as solve() had them, then for a speed of 1 in each of a condensed body's six directions
  std::vector<double> columns_;
  std::vector<double> products_;  // of the columns' equalities with each other
  std::vector<double> pushes_;    // by column
  std::size_t factored_ = 0;      // rows
};

}  // namespace mechane::dynamics
