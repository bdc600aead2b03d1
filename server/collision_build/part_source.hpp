// What a part is made from: a node that the author named, or a piece of one.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "server/collision_build/cast_map.hpp"
#include "server/collision_build/object_builder.hpp"
#include "server/collision_build/solid.hpp"
#include "server/geometry/mesh.hpp"
#include "server/geometry/pieces/decompose.hpp"

namespace mechane::collision_build {

struct PartSource {
  std::string name;
  std::size_t node = 0;                   ///< the solid's part that it belongs to
  std::vector<geometry::HalfSpace> cell;  ///< of a piece
  std::vector<SurfacePlace> places;       ///< of its surface where that borders on air, evenly
  std::vector<Vec3> bound_points_O;       ///< its superquadric and its map hold them
  std::vector<Vec3> samples_O;            ///< for contacts
  double spacing_m = 0;                   ///< of the samples

  /// If false, it is a piece, which its bound points describe.
  [[nodiscard]] bool is_whole_node() const { return cell.empty(); }
};

/// Triangles of all nodes that border on air somewhere: the solid's true surface, for the exact distance.
[[nodiscard]] geometry::Mesh air_side(std::span<const geometry::Mesh> nodes, const Solid& solid);

/// The same without what of these triangles lies in other parts: they are cut there, into pieces with edges of `finest_m`. Uses all cores.
[[nodiscard]] geometry::Mesh cut_air_side(std::span<const geometry::Mesh> nodes, const Solid& solid, double finest_m);

/// A node as one part, or as the pieces of `cut`. Pieces without a surface of their own (deep in the solid) are left out.
[[nodiscard]] std::vector<PartSource> sources_of_node(const std::string& name, const geometry::Mesh& mesh,
                                                      std::size_t node, const geometry::Decomposition& cut,
                                                      const Solid& solid, const BuildConfig& config);

/// The whole object as one source, named "whole".
[[nodiscard]] PartSource unite(std::span<const geometry::Mesh> nodes, std::span<const PartSource> sources);

}  // namespace mechane::collision_build
