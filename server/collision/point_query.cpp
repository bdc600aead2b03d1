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

PointHits::PointHits(std::size_t points)
    : point(points + kLanes),
      depth_m(points + kLanes),
      n_x(points + kLanes),
      n_y(points + kLanes),
      n_z(points + kLanes) {}

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
  if (parts_.size() == 1 && parts_.front().kind == PlacedPart::Kind::field) {
    query_field(points, out, kernels);
    return;
  }
  const auto sink = [&](const InsidePoint& inside) {
    if (out.room() == 0) return;
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

/// From groups to clusters, 16 groups at a time, to hits.
void PlacedObject::query_field(const PointSet& points, PointHits& out, const Kernels& kernels) const noexcept {
  constexpr std::size_t kFour = 4;
  const PlacedPart& part = parts_.front();
  const PointRuns runs{points.points.x, points.points.y, points.points.z, kLanes, points.quads, kFour};
  std::array<float, 9> R_SQ;
  Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(R_SQ.data()) = R_SQ_.front();
  const std::size_t each = points.clusters_per_group;
  for (std::size_t block = 0; block < points.group_count; block += kLanes) {
    const std::size_t groups = std::min(kLanes, points.group_count - block);
    std::array<std::uint32_t, kLanes * kLanes / kFour + kFour> fours;
    std::array<std::uint32_t, kLanes * kLanes + kLanes> clusters;
    std::size_t four_count = 0;
    std::size_t count = 0;
    for (LaneMask near = part.near(kernels, from(points.groups, block), groups); near != 0; near &= near - 1) {
      const std::size_t first = each * (block + static_cast<std::size_t>(std::countr_zero(near)));
      if (each % kFour == 0) {
        for (std::size_t i = 0; i < each / kFour; ++i)
          fours[four_count++] = static_cast<std::uint32_t>(first / kFour + i);
        continue;
      }
      for (LaneMask some = part.near(kernels, from(points.clusters, first), each); some != 0; some &= some - 1)
        clusters[count++] = static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(std::countr_zero(some));
    }
    if (four_count > 0)
      count =
          kernels.field_sift(part.field, part.X_BS, points.clusters, kFour, fours.data(), four_count, clusters.data());
    for (std::size_t at = 0; at < count; at += kFieldBatch) {
      const std::size_t used = out.count;
      const HitRuns hits{&out.point[used], &out.depth_m[used], &out.n_x[used],
                         &out.n_y[used],   &out.n_z[used],     out.room()};
      out.count +=
          kernels.field_hits(part.field, part.X_BS, R_SQ, runs, &clusters[at], std::min(kFieldBatch, count - at), hits);
    }
  }
}

}  // namespace mechane::collision
