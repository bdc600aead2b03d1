// Where two bodies touch: the collision query, reduced to the few points that hold them apart. Free of any engine.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "server/collision/object.hpp"

namespace mechane::dynamics {

/// As many as a manifold of Bullet holds.
inline constexpr std::size_t kManifoldPoints = 4;

/// Finds the contacts of a pair of bodies, one pair after the other. Keeps its buffer from pair to pair. One thread at a time.
class PairContacts {
 public:
  PairContacts();

  /// The best contacts of A and B: one of the deepest, and those that span the largest area with it; fewer where fewer are needed. The
  /// order and the choice follow from the arguments alone. Where two faces lie on each other, a point of one that is closer to a side of
  /// the other body than to its face is not a contact, because it would stop a body that slides. Allocates nothing. The result is valid
  /// until the next call.
  std::span<const collision::PointContact> find(const collision::Object& a, const Pose& X_WA,
                                                const collision::Object& b, const Pose& X_WB) noexcept;

 private:
  std::vector<collision::PointContact> found_;
  std::array<collision::PointContact, kManifoldPoints> best_;
};

}  // namespace mechane::dynamics
