// What `mechane fit` made of one mesh file: all that its table and its report tell.
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
  double scale = 1;  ///< of the file's units: metres each
  std::string mesh_hash;
  std::filesystem::path part_file;
  std::size_t part_file_bytes = 0;
  std::vector<geometry::NamedMesh> meshes;  ///< as the builder got them, welded, in the object's frame O
  std::vector<std::string> turned;          ///< meshes that came inside out, by name
  collision_build::BuildConfig config;
  collision::Object object;
  collision_build::BuildReport report;
};

}  // namespace mechane::fit
