// Free bodies against each other: the collision query as a collision algorithm of Bullet.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "server/base/error.hpp"
#include "server/state/world_state.hpp"

class btPersistentManifold;
class btRigidBody;
struct btContactSolverInfo;

namespace mechane::dynamics {

/// A body that collides. C is Bullet's frame of it: the centre of mass with the principal axes.
struct Collider {
  btRigidBody* bullet;
  Pose X_CB;
};

/// The contacts between the bodies of a world that opted in (BodyDescription::collides): a shape of our own for each, an algorithm and a
/// manifold for each pair that may ever meet, all made up front. Nothing is carried from step to step.
///
/// A pair may meet unless both bodies are fixed, a joint ties them (on or off), or they are mates. It is not tested while neither moves,
/// one is hidden, or both are in hands.
class BodyContacts {
 public:
  /// Null where no pair may ever meet. `bodies` are the description's, in its order; they get their shapes, and must outlive this.
  /// Errors: a body that collides has no object, more than kMaxColliders, a restitution or friction out of range.
  [[nodiscard]] static Expected<std::unique_ptr<BodyContacts>> create(const state::WorldDescription& description,
                                                                      std::span<const Collider> bodies);
  ~BodyContacts();
  BodyContacts(const BodyContacts&) = delete;
  BodyContacts& operator=(const BodyContacts&) = delete;

  /// The manifolds of the pairs that touch, in a fixed order, for the solver. The bodies must be where `state` has them, with velocities
  /// and masses. Allocates nothing. One thread at a time.
  [[nodiscard]] std::span<btPersistentManifold*> find(const state::WorldState& state, double dt_s) noexcept;

  /// After the solver: which of the touching bodies stay where they are, see rests().
  void note_rest() noexcept;

  /// Whether the body, and all that it touches, is slower than the solver's error: up to 2 mm/s at the outermost point. Its pose must
  /// then stay as it is, or it would creep; its velocity is kept, so that a body that really begins to move is not held back.
  [[nodiscard]] bool rests(std::size_t body) const noexcept;

  /// As many manifolds as find() can ever return, each full: one solve with them sizes the solver's tables.
  [[nodiscard]] std::span<btPersistentManifold*> fill();

 private:
  struct Impl;
  explicit BodyContacts(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

inline constexpr std::size_t kMaxColliders = 128;  ///< bodies of one world that collide

/// What the solver does with contacts. Changes nothing where there are none.
void set_contact_solver(btContactSolverInfo& info);

}  // namespace mechane::dynamics
