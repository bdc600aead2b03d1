#include "client-sdk/studio/view/workable.hpp"

#include <algorithm>

#include "server/collision/object.hpp"
#include "server/state/affordances.hpp"

namespace mechane::studio {
namespace {

Eigen::AlignedBox3d box_around(const collision::Object& object, const Pose& X_WB) {
  Eigen::AlignedBox3d box;
  for (const collision::Cluster& cluster : object.clusters)
    for (std::size_t lane = 0; lane < cluster.count; ++lane)
      box.extend(X_WB * cluster.sample_O(lane).cast<double>().eval());
  return box;
}

}  // namespace

std::vector<WorkableBody> workable_bodies(const state::WorldDescription& world, const SeenWorld& seen) {
  std::vector<std::uint8_t> worked(world.bodies.size(), 0);
  for (const state::Affordance& affordance : state::affordances_of(world))
    worked[affordance.object.index()] = 1;
  std::vector<WorkableBody> all;
  const std::size_t known = std::min({world.bodies.size(), seen.X_WB.size(), seen.visible.size()});
  for (std::size_t i = 0; i < known; ++i) {
    const state::BodyDescription& body = world.bodies[i];
    if (worked[i] != 0 && seen.visible[i] != 0 && body.object != nullptr && !body.object->clusters.empty())
      all.push_back({body.name, box_around(*body.object, seen.X_WB[i])});
  }
  return all;
}

}  // namespace mechane::studio
