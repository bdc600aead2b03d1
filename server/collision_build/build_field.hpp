// The DistanceField of a part or of a whole object, measured on the exact mesh.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "server/collision/distance_field.hpp"
#include "server/collision_build/build_brick.hpp"
#include "server/collision_build/solid.hpp"
#include "server/geometry/mesh.hpp"
#include "server/geometry/mesh_query.hpp"

namespace mechane::collision_build {

/// What a field is made of. `solid` must be closed; `skin` asks `skin_mesh`, its surface where it borders on air. All outlive the build.
struct FieldSource {
  const Solid& solid;
  const geometry::MeshQuery& skin;
  const geometry::Mesh& skin_mesh;
  Pose X_OQ;
};

/// Fits each block that the surface or the solid reaches: smooth, by sheets, or halved and each eighth fitted again, until no depth that
/// is tried in it errs by more than needs.tolerance_m, or by more than needs.share of itself. Tried are places all over the block and the
/// `witnesses` in it. Empty where it would hold more than `at_most` bytes if equal leaves were stored each time. Uses all cores; same
/// arguments, same bits.
[[nodiscard]] std::optional<collision::DistanceField> build_field(const FieldSource& source,
                                                                  const collision::DistanceField::Grid& grid,
                                                                  const BrickNeeds& needs,
                                                                  std::span<const Probe> witnesses,
                                                                  std::size_t at_most);

}  // namespace mechane::collision_build
