// What a mesh says of a body's mass: its volume, and how the mass of a uniform solid of that shape is spread.
#pragma once

#include <cstddef>
#include <span>

#include "server/base/math.hpp"
#include "server/geometry/mesh.hpp"

namespace mechane::scenario {

/// All parts together, in their common frame. Parts that overlap count as often as they overlap.
struct Solid {
  std::size_t open_edges = 0;  ///< of all parts; 0: each is closed, and what follows holds but for the box
  double box_m3 = 0;           ///< of the box around all parts, which holds for open ones too
  double volume_m3 = 0;
  Vec3 p_OC = Vec3::Zero();               ///< the middle of the mass
  Mat3 inertia_per_kg_m2 = Mat3::Zero();  ///< about it: times the mass, the inertia

  [[nodiscard]] bool is_closed() const { return open_edges == 0 && volume_m3 > 0; }
};

/// Of welded parts, as content::collision_parts() gives them.
[[nodiscard]] Solid solid_of(std::span<const geometry::NamedMesh> parts);

}  // namespace mechane::scenario
