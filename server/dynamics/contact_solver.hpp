// Bullet's solver of contacts between bodies, and how it works with a mechanism's own rows.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "server/dynamics/mechanism.hpp"

class btCollisionObject;
class btPersistentManifold;

namespace mechane::dynamics {

/// Bullet makes the rows of all contacts. Those between bodies of the mechanism and what does not move become rows of the mechanism. Where
/// a body of the mechanism touches one that is free, Bullet's rows and the mechanism's are solved in turn. One thread; a step allocates
/// nothing after reserve() and a first solve() with all contacts.
class ContactSolver {
 public:
  static constexpr std::size_t kMostOwnRows =
      48;  ///< that become the mechanism's in a step; further ones are solved in turn

  /// `frames` and `free` by body, at the start of the step and without all rows. All are kept.
  ContactSolver(Mechanism& mechanism, const std::vector<Frame>& frames, const std::vector<Twist>& free);
  ~ContactSolver();
  ContactSolver(const ContactSolver&) = delete;
  ContactSolver& operator=(const ContactSolver&) = delete;

  void reserve(std::size_t bodies);
  /// Forgets the bodies of the last step.
  void clear() noexcept;
  /// A body of the mechanism that has contacts in this step. Its user index is its index in the world.
  void add(const btCollisionObject& body) noexcept;
  /// Then solve() solves the mechanism, too, whose rows must be factored by then.
  [[nodiscard]] bool has_bodies() const noexcept;

  /// Gives all bodies that have contacts and can move (`bodies`) their velocities after the step.
  void solve(std::span<btCollisionObject*> bodies, std::span<btPersistentManifold*> manifolds, double dt_s);

 private:
  class Rows;
  std::unique_ptr<Rows> rows_;
};

}  // namespace mechane::dynamics
