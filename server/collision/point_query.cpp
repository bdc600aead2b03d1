#include "server/collision/point_query.hpp"

#include <algorithm>

#include "server/base/assert.hpp"
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

GroupsView groups_of(const PointSet& points, std::size_t block) noexcept {
  GroupsView groups{from(points.groups, block), points.rotations};
  for (const float*& numbers : groups.R)
    numbers += block;
  return groups;
}

GroupPlaces places_of(const GroupsView& groups) noexcept {
  GroupPlaces places;
  std::copy_n(groups.spheres.x, kLanes, places.x.begin());
  std::copy_n(groups.spheres.y, kLanes, places.y.begin());
  std::copy_n(groups.spheres.z, kLanes, places.z.begin());
  for (std::size_t i = 0; i < groups.R.size(); ++i)
    std::copy_n(groups.R[i], kLanes, places.R[i].begin());
  return places;
}

// Of a margin: what is left of it when float32 has rounded on the way.
constexpr float kSurely = 0.99F;

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
  if (!reaches(points)) return;
  if (is_field()) {
    sift_field(points, parts_.front().field, kernels,
               [&](std::uint32_t* quads, std::size_t count) { add_hits(points, quads, count, out, kernels); });
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

void PlacedObject::query(const PointSet& points, NearList& near, PointHits& out,
                         const Kernels& kernels) const noexcept {
  if (!is_field() || points.quads.x == nullptr || points.rotations[0] == nullptr) {
    query(points, out, kernels);
    return;
  }
  if (!reaches(points)) return;
  if (!still_holds(near, points, kernels)) renew(near, points, kernels);
  for (std::size_t at = 0; at < near.count_; at += kFieldBatch)
    add_hits(points, &near.quads_[at], std::min(kFieldBatch, near.count_ - at), out, kernels);
}

bool PlacedObject::reaches(const PointSet& points) const noexcept {
  const float reach = points.radius + radius_;
  return (points.center - center_S_).squaredNorm() <= reach * reach;
}

bool PlacedObject::is_field() const noexcept {
  return parts_.size() == 1 && parts_.front().kind == PlacedPart::Kind::field;
}

bool PlacedObject::still_holds(const NearList& near, const PointSet& points, const Kernels& kernels) const noexcept {
  const BlockTransform& X_BS = parts_.front().X_BS;
  if (near.times_made_ == 0 || near.X_BS_.R_BA != X_BS.R_BA || near.X_BS_.p_BA != X_BS.p_BA) return false;
  for (std::size_t block = 0; block < points.group_count; block += kLanes) {
    const GroupsView now = groups_of(points, block);
    const std::size_t count = std::min(kLanes, points.group_count - block);
    if (!kernels.have_stayed(now, near.places_[block / kLanes], count, kSurely * near.margin_m_)) return false;
  }
  return true;
}

void PlacedObject::renew(NearList& near, const PointSet& points, const Kernels& kernels) const noexcept {
  MECHANE_ASSERT(points.group_count <= kLanes * near.places_.size());
  MECHANE_ASSERT(kLanes * points.group_count * points.clusters_per_group <= 4 * (near.quads_.size() - kLanes));
  const PlacedPart& part = parts_.front();
  ++near.times_made_;
  near.X_BS_ = part.X_BS;
  for (std::size_t block = 0; block < points.group_count; block += kLanes)
    near.places_[block / kLanes] = places_of(groups_of(points, block));
  near.count_ = 0;
  FieldView wider = part.field;
  wider.margin = near.margin_m_ * wider.inverse_block;
  sift_field(points, wider, kernels, [&](const std::uint32_t* quads, std::size_t count) {
    std::copy_n(quads, count, &near.quads_[near.count_]);
    near.count_ += count;
  });
}

/// From groups to clusters, 16 groups at a time, to quads: take(quads, count) gets at most kFieldBatch, and room for three more.
template <class Take>
void PlacedObject::sift_field(const PointSet& points, const FieldView& field, const Kernels& kernels,
                              const Take& take) const noexcept {
  constexpr std::size_t kFour = 4;
  const BlockTransform& X_BS = parts_.front().X_BS;
  const std::size_t each = points.clusters_per_group;
  for (std::size_t block = 0; block < points.group_count; block += kLanes) {
    const std::size_t groups = std::min(kLanes, points.group_count - block);
    std::array<std::uint32_t, kLanes * kLanes / kFour + kFour> fours;
    std::array<std::uint32_t, kLanes * kLanes + kLanes> clusters;
    std::size_t four_count = 0;
    std::size_t count = 0;
    LaneMask near = kernels.field_near(field, X_BS, from(points.groups, block), groups);
    for (; near != 0; near &= near - 1) {
      const std::size_t first = each * (block + static_cast<std::size_t>(std::countr_zero(near)));
      if (each % kFour == 0) {
        for (std::size_t i = 0; i < each / kFour; ++i)
          fours[four_count++] = static_cast<std::uint32_t>(first / kFour + i);
        continue;
      }
      LaneMask some = kernels.field_near(field, X_BS, from(points.clusters, first), each);
      for (; some != 0; some &= some - 1)
        clusters[count++] = static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(std::countr_zero(some));
    }
    if (four_count > 0)
      count = kernels.field_sift(field, X_BS, points.clusters, kFour, fours.data(), four_count, clusters.data());
    for (std::size_t at = 0; at < count; at += kFieldBatch / kFour) {
      const std::size_t some = std::min(kFieldBatch / kFour, count - at);
      std::array<std::uint32_t, kFieldBatch + kLanes> quads;
      if (points.quads.x != nullptr) {
        take(quads.data(), kernels.field_sift(field, X_BS, points.quads, kFour, &clusters[at], some, quads.data()));
        continue;
      }
      for (std::size_t i = 0; i < kFour * some; ++i)
        quads[i] = static_cast<std::uint32_t>(kFour * clusters[at + i / kFour] + i % kFour);
      take(quads.data(), kFour * some);
    }
  }
}

void PlacedObject::add_hits(const PointSet& points, std::uint32_t* quads, std::size_t count, PointHits& out,
                            const Kernels& kernels) const noexcept {
  if (count == 0) return;
  const PlacedPart& part = parts_.front();
  const PointRuns runs{points.points.x, points.points.y, points.points.z, kLanes, {}, 0};
  std::array<float, 9> R_SQ;
  Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(R_SQ.data()) = R_SQ_.front();
  const std::size_t used = out.count;
  const HitRuns hits{&out.point[used], &out.depth_m[used], &out.n_x[used], &out.n_y[used], &out.n_z[used], out.room()};
  out.count += kernels.field_hits(part.field, part.X_BS, R_SQ, runs, quads, count, hits);
}

}  // namespace mechane::collision
