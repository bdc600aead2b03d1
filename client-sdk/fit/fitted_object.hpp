// The result of `mechane fit` for one mesh file: all that its table and its report show.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "server/collision_build/object_builder.hpp"
#include "server/geometry/mesh.hpp"

namespace mechane::fit {

struct FittedObject {
  std::filesystem::path mesh_file;
  std::string node;  ///< of the file; empty: all of it
  double scale = 1;  ///< metres per unit of the file
  std::string mesh_hash;
  std::filesystem::path part_file;
  std::size_t part_file_bytes = 0;
  std::vector<geometry::NamedMesh> meshes;  ///< the builder's input, welded, in the object's frame O
  std::vector<std::string> turned;          ///< names of meshes that were inside out
  collision_build::BuildConfig config;
  collision::Object object;
  collision_build::BuildReport report;
};

}  // namespace mechane::fit
