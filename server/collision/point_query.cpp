#include "server/collision/point_query.hpp"

#include <algorithm>

#include "server/collision/cluster_query.hpp"

namespace mechane::collision {
namespace {

struct SetPoints {
  const PointsView& all;
  [[nodiscard]] PointsView points(std::uint32_t cluster) const noexcept {
    const std::size_t at = kLanes * cluster;
    return {all.x + at, all.y + at, all.z + at};
  }
  [[nodiscard]] static std::size_t count(std::uint32_t /*cluster*/) noexcept { return kLanes; }
};

SpheresView from(const SpheresView& spheres, std::size_t at) noexcept {
  return {spheres.x + at, spheres.y + at, spheres.z + at, spheres.radius + at};
}

}  // namespace

PointHits::PointHits(std::size_t points) : point(points), depth_m(points), n_x(points), n_y(points), n_z(points) {}

PlacedObject::PlacedObject(const Object& object, const Pose& X_SO)
    : center_S_((X_SO * object.bound_O.center).cast<float>()), radius_(static_cast<float>(object.bound_O.radius)) {
  for (std::size_t i = 0; i < object.parts.size(); ++i) {
    const Part& part = object.parts[i];
    if (part.map.empty()) continue;
    const Pose X_SQ = X_SO * part.X_OQ;
    parts_.emplace_back().place(part, static_cast<std::uint16_t>(i), X_SQ.inverse());
    R_SQ_.push_back(X_SQ.R.toRotationMatrix().cast<float>());
  }
}

void PlacedObject::query(const PointSet& points, PointHits& out, const Kernels& kernels) const noexcept {
  const float reach = points.radius + radius_;
  if ((points.center - center_S_).squaredNorm() > reach * reach) return;
  const auto sink = [&](const InsidePoint& inside) {
    if (out.count == out.point.size()) return;
    const Vec3f n = R_SQ_[static_cast<std::size_t>(inside.part - parts_.data())] * inside.n_Q;
    out.point[out.count] = static_cast<std::uint32_t>(kLanes * inside.cluster + inside.lane);
    out.depth_m[out.count] = inside.depth_m;
    out.n_x[out.count] = n.x();
    out.n_y[out.count] = n.y();
    out.n_z[out.count] = n.z();
    ++out.count;
  };
  const SetPoints source{points.points};
  for (std::size_t first = 0; first < parts_.size(); first += kPartBatch) {
    const std::span<const PlacedPart> batch =
        std::span(parts_).subspan(first, std::min(kPartBatch, parts_.size() - first));
    ClusterQuery query(source, batch, kernels, sink);
    for (std::size_t block = 0; block < points.group_count; block += kLanes) {
      const std::size_t groups = std::min(kLanes, points.group_count - block);
      std::array<std::uint64_t, kLanes> near_of{};
      for (std::size_t c = 0; c < batch.size(); ++c) {
        for (LaneMask lanes = batch[c].near(kernels, from(points.groups, block), groups); lanes != 0;
             lanes &= lanes - 1)
          near_of[static_cast<std::size_t>(std::countr_zero(lanes))] |= std::uint64_t{1} << c;
      }
      for (std::size_t g = 0; g < groups; ++g) {
        if (near_of[g] == 0) continue;
        const std::size_t cluster = points.clusters_per_group * (block + g);
        query.test_group(from(points.clusters, cluster), points.clusters_per_group, static_cast<std::uint32_t>(cluster),
                         near_of[g]);
      }
    }
    query.finish();
  }
}

}  // namespace mechane::collision
