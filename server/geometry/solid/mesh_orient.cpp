#include "server/geometry/solid/mesh_orient.hpp"

#include <utility>
#include <vector>

#include "server/base/math.hpp"
#include "server/geometry/mesh_check.hpp"
#include "server/geometry/mesh_query.hpp"
#include "server/geometry/solid/shells.hpp"

namespace mechane::geometry {
namespace {

/// Six times; about a vertex of its own, so that a shell far from the origin is as exact as one that is near.
double volume_of(const Mesh& mesh, const Shell& shell) {
  const Vec3 from = mesh.vertices[mesh.triangles[shell.front()][0]];
  double volume = 0;
  for (const std::uint32_t i : shell) {
    const auto& t = mesh.triangles[i];
    volume += (mesh.vertices[t[0]] - from).dot((mesh.vertices[t[1]] - from).cross(mesh.vertices[t[2]] - from));
  }
  return volume;
}

bool is_closed(const Mesh& mesh, const Shell& shell) {
  Mesh alone;  // edges are told from indices
  for (const std::uint32_t i : shell)
    alone.triangles.push_back(mesh.triangles[i]);
  return open_edges(alone) == 0;
}

void turn(Mesh& mesh, const Shell& shell) {
  for (const std::uint32_t i : shell)
    std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
}

}  // namespace

std::size_t turn_outwards(Mesh& welded) {
  std::vector<Shell> shells = shells_of(welded);
  std::erase_if(shells, [&](const auto& shell) { return !is_closed(welded, shell); });
  double sum = 0;
  for (const auto& shell : shells)
    sum += volume_of(welded, shell);
  std::size_t turned = 0;
  if (sum < 0) {  // as a whole: a hollow and its wall keep their ways against each other
    for (const auto& shell : shells)
      turn(welded, shell);
    turned = shells.size();
  }
  Mesh outer;  // what can have a hollow
  outer.vertices = welded.vertices;
  std::vector<std::size_t> inverted;
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (volume_of(welded, shells[s]) < 0) {
      inverted.push_back(s);
    } else {
      for (const std::uint32_t i : shells[s])
        outer.triangles.push_back(welded.triangles[i]);
    }
  }
  if (inverted.empty()) return turned;
  const MeshQuery around(outer);
  for (const std::size_t s : inverted) {
    if (around.winding(welded.vertices[welded.triangles[shells[s].front()][0]]) > 0) continue;
    turn(welded, shells[s]);
    ++turned;
  }
  return turned;
}

}  // namespace mechane::geometry
