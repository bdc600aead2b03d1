// The volume of a mesh, and the inertia of a uniform solid of that shape; where it is open, of a thin shell.
#pragma once

#include <cstddef>
#include <span>

#include "server/base/math.hpp"
#include "server/geometry/mesh.hpp"

namespace mechane::scenario {

/// All parts together, in their common frame. Where parts overlap, the overlap counts once for each part.
struct Solid {
  std::size_t open_edges = 0;  ///< of all parts. Only where it is 0 is the volume meaningful
  double box_m3 = 0;           ///< of the box around all parts; also for open ones
  double volume_m3 = 0;
  Vec3 p_OC = Vec3::Zero();  ///< the middle of the mass
  Mat3 inertia_per_kg_m2 =
      Mat3::Zero();  ///< about that middle; times the mass it is the inertia. Zero: there is no area

  [[nodiscard]] bool is_closed() const { return open_edges == 0 && volume_m3 > 0; }
};

/// The solid of welded parts, as content::collision_parts() gives them.
[[nodiscard]] Solid solid_of(std::span<const geometry::NamedMesh> parts);

}  // namespace mechane::scenario
