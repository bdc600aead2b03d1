// Objects as `mechane fit` makes them, of the shapes in tests/support.
#pragma once

#include <cstdlib>
#include <utility>

#include "client-sdk/fit/fitted_object.hpp"
#include "server/geometry/solid/mesh_orient.hpp"
#include "tests/support/shapes.hpp"

namespace mechane::fit {

inline FittedObject fitted(std::vector<geometry::NamedMesh> meshes, bool bricks = true) {
  FittedObject out;
  out.mesh_file = "thing.glb";
  out.part_file = "thing.part";
  out.mesh_hash = "00";
  out.meshes = std::move(meshes);
  for (geometry::NamedMesh& part : out.meshes) {
    if (geometry::turn_outwards(part.mesh) > 0) out.turned.push_back(part.name);
  }
  out.config.map_resolution = 16;
  out.config.bricks = bricks;
  auto object = collision_build::build_object(out.meshes, out.config, &out.report);
  if (!object) std::abort();
  out.object = std::move(*object);
  return out;
}

// Made once in a program, for a sanitizer makes it slow.

/// With a radial map, which has a box exactly.
inline const FittedObject& fitted_box() {
  static const FittedObject kBox = fitted({{"block", test::box({0.05, 0.04, 0.03})}}, false);
  return kBox;
}

inline const FittedObject& fitted_crank() {
  static const FittedObject kCrank = fitted(test::crank());
  return kCrank;
}

}  // namespace mechane::fit
