#include "client-sdk/scene/coarser_mesh.hpp"

#include <meshoptimizer.h>

namespace mechane::scene {

CoarserMeshes coarser_meshes(const content::ImportedMesh& mesh) {
  CoarserMeshes out;
  if (mesh.indices.empty()) return out;
  const std::size_t vertices = mesh.positions.size();
  const float* positions = mesh.positions.front().data();
  const float extent_m = meshopt_simplifyScale(positions, vertices, sizeof(Vec3f));
  const std::vector<std::uint32_t>* finer = &mesh.indices;
  for (std::size_t level = 0; level < out.size(); ++level) {
    std::vector<std::uint32_t>& coarser = out[level];
    coarser.resize(finer->size());
    // Each level is made of the one before, so that together they take little more time than the first. What the errors
    // of all add up to is half as much again as the last.
    const float error = extent_m > 0 ? kLevelErrors_m[level] / 1.5F / extent_m : 0;
    coarser.resize(meshopt_simplify(coarser.data(), finer->data(), finer->size(), positions, vertices, sizeof(Vec3f), 0,
                                    error, meshopt_SimplifyLockBorder, nullptr));
    meshopt_optimizeVertexCache(coarser.data(), coarser.data(), coarser.size(), vertices);
    finer = &coarser;
  }
  return out;
}

}  // namespace mechane::scene
