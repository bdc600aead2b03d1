#include <algorithm>

#include "server/collision/cluster_query.hpp"
#include "server/collision/object.hpp"

namespace mechane::collision {
namespace {

bool overlap(const geometry::Sphere& a, const Vec3& center_b, double radius_b) noexcept {
  const double reach = a.radius + radius_b;
  return (a.center - center_b).squaredNorm() <= reach * reach;
}

/// Whether two spheres are certainly apart, whatever was rounded on the way to the distance of their centres. Nearly all pairs are.
bool are_apart(const geometry::Sphere& a, const Vec3& p_ab, const geometry::Sphere& b) noexcept {
  constexpr double kSurely = 1 + 1e-9;
  const double reach = kSurely * (a.radius + b.radius);
  return p_ab.squaredNorm() > reach * reach;
}

/// Whether a sphere reaches the box: the tight cull for parts that are long and thin.
bool reaches_box(const BoxView& box, const Vec3f& center_Q, float radius) noexcept {
  float square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const float beyond = std::abs(center_Q[static_cast<Eigen::Index>(i)] - box.center[i]) - box.half[i];
    square += beyond > 0 ? beyond * beyond : 0;
  }
  return square <= radius * radius;
}

/// The samples of one object, tested against the parts of the other, the target (T). Each that is inside goes to
/// sink(inside, part of the source).
template <class Sink>
class Direction {
 public:
  Direction(const Object& source, const Pose& X_TS, const Object& target, Sink sink)
      : source_(source), X_TS_(X_TS), target_(target), sink_(std::move(sink)) {}

  void run() noexcept {
    if (target_.parts.size() == 1 && target_.parts.front().map.field() != nullptr) {
      run_field();
      return;
    }
    const auto report = [this](const InsidePoint& inside) { sink_(inside, source_.clusters[inside.cluster].part); };
    for (std::size_t next = 0; next < target_.parts.size();) {
      const std::size_t count = collect(next);
      if (count == 0) continue;
      const Vec3 target_center_S = X_TS_.inverse() * target_.bound_O.center;
      ClusterQuery query(*this, std::span<const PlacedPart>(near_).first(count), best_kernels(), report);
      const std::uint64_t all = count == kPartBatch ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
      for_each_near_group(target_center_S, [&](const ClusterGroup& group) {
        query.test_group(group.bounds_O.view(), group.count, group.first_cluster, all);
      });
      query.finish();
    }
  }

  // The interface that ClusterQuery needs.
  [[nodiscard]] PointsView points(std::uint32_t cluster) const noexcept {
    return source_.clusters[cluster].samples_O.view();
  }
  [[nodiscard]] std::size_t count(std::uint32_t cluster) const noexcept { return source_.clusters[cluster].count; }

 private:
  template <class Body>
  void for_each_near_group(const Vec3& target_center_S, const Body& body) const noexcept {
    for (std::size_t s = 0; s < source_.parts.size(); ++s) {
      if (!is_near(source_.parts[s], target_center_S)) continue;
      for (std::uint32_t g = source_.first_group[s]; g < source_.first_group[s + 1]; ++g) {
        const ClusterGroup& group = source_.groups[g];
        if (overlap(group.bound_O, target_center_S, target_.bound_O.radius)) body(group);
      }
    }
  }

  /// Where the target is one field: its kernels go from clusters to hits by themselves.
  void run_field() noexcept {
    static constexpr std::size_t kMost = kFieldBatch / 4;
    std::size_t next = 0;
    if (collect(next) == 0) return;
    const PlacedPart& part = near_.front();
    const Kernels& kernels = best_kernels();
    std::array<std::uint32_t, kMost + kLanes> clusters;
    std::size_t count = 0;
    for_each_near_group(X_TS_.inverse() * target_.bound_O.center, [&](const ClusterGroup& group) {
      for (LaneMask near = part.near(kernels, group.bounds_O.view(), group.count); near != 0; near &= near - 1) {
        clusters[count++] = group.first_cluster + static_cast<std::uint32_t>(std::countr_zero(near));
        if (count < kMost) continue;
        give_hits(part, kernels, clusters.data(), count);
        count = 0;
      }
    });
    if (count > 0) give_hits(part, kernels, clusters.data(), count);
  }

  void give_hits(const PlacedPart& part, const Kernels& kernels, std::uint32_t* clusters,
                 std::size_t cluster_count) noexcept {
    static constexpr std::array<float, 9> kStraight = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    constexpr std::size_t kRoom = 4 * kFieldBatch;
    std::array<std::uint32_t, kRoom + kLanes> point;
    std::array<float, kRoom + kLanes> depth_m;
    std::array<float, kRoom + kLanes> x;
    std::array<float, kRoom + kLanes> y;
    std::array<float, kRoom + kLanes> z;
    const HitRuns out{point.data(), depth_m.data(), x.data(), y.data(), z.data(), kRoom};
    const PointRuns runs = runs_of(source_);
    std::array<std::uint32_t, kFieldBatch + kLanes> quads;
    const std::size_t quad_count =
        kernels.field_sift(part.field, part.X_BS, runs.quads, runs.quad_stride, clusters, cluster_count, quads.data());
    const std::size_t count = kernels.field_hits(part.field, part.X_BS, kStraight, runs, quads.data(), quad_count, out);
    const Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>> R_QS(part.X_QS.R_BA.data());
    const Eigen::Map<const Vec3f> p_QS(part.X_QS.p_BA.data());
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t cluster = point[i] / kLanes;
      const std::uint32_t lane = point[i] % kLanes;
      const Cluster& samples = source_.clusters[cluster];
      if (lane >= samples.count) continue;  // it repeats another
      const Vec3f p_Q = R_QS * samples.sample_O(lane) + p_QS;
      sink_(InsidePoint{cluster, lane, &part, p_Q, {x[i], y[i], z[i]}, depth_m[i]}, samples.part);
    }
  }

  /// Fills `near_` with the parts of the target, from `next` on, that the source's sphere reaches.
  std::size_t collect(std::size_t& next) noexcept {
    std::size_t count = 0;
    const Vec3 center_T = X_TS_ * source_.bound_O.center;
    for (; next < target_.parts.size() && count < near_.size(); ++next) {
      const Part& part = target_.parts[next];
      if (part.map.empty() || !overlap(part.bound_O, center_T, source_.bound_O.radius)) continue;
      const Pose X_QS = part.X_OQ.inverse() * X_TS_;
      const Vec3f center_Q = (X_QS * source_.bound_O.center).cast<float>();
      if (!reaches_box(part.map.box(), center_Q, static_cast<float>(source_.bound_O.radius))) continue;
      near_[count++].place(part, static_cast<std::uint16_t>(next), X_QS);
    }
    return count;
  }

  [[nodiscard]] bool is_near(const Part& part, const Vec3& target_center_S) const noexcept {
    if (!overlap(part.bound_O, target_center_S, target_.bound_O.radius)) return false;
    const Vec3f center_Q = (part.X_OQ.inverse() * target_center_S).cast<float>();
    return part.map.empty() || reaches_box(part.map.box(), center_Q, static_cast<float>(target_.bound_O.radius));
  }

  const Object& source_;
  Pose X_TS_;
  const Object& target_;
  Sink sink_;
  std::array<PlacedPart, kPartBatch> near_;
};

/// Makes contacts of the points of one direction.
class ContactSink {
 public:
  ContactSink(const Pose& X_WT, bool target_is_a, ContactBuffer& out)
      : X_WT_(X_WT), target_is_a_(target_is_a), out_(out) {}

  void operator()(const InsidePoint& inside, std::uint16_t source_part) noexcept {
    if (!out_.wants(static_cast<double>(inside.depth_m))) return;
    if (inside.part->part != part_) {  // points of a part come together
      part_ = inside.part->part;
      X_WQ_ = X_WT_ * part_->X_OQ;
    }
    const Vec3 n_W = X_WQ_.rotate(inside.n_Q.cast<double>());  // out of the target
    PointContact contact;
    contact.depth_m = static_cast<double>(inside.depth_m);
    if (target_is_a_) {
      contact.p_WC = X_WQ_ * inside.p_Q.cast<double>();  // the sample itself lies on B's surface
      contact.n_BA_W = -n_W;
      contact.part_a = inside.part->index;
      contact.part_b = source_part;
    } else {
      const Vec3f p_QS = inside.p_Q + inside.depth_m * inside.n_Q;
      contact.p_WC = X_WQ_ * p_QS.cast<double>();
      contact.n_BA_W = n_W;
      contact.part_a = source_part;
      contact.part_b = inside.part->index;
    }
    out_.add(contact);
  }

 private:
  Pose X_WT_;
  bool target_is_a_;
  ContactBuffer& out_;
  const Part* part_ = nullptr;
  Pose X_WQ_;
};

}  // namespace

void ContactBuffer::add(const PointContact& contact) noexcept {
  if (!wants(contact.depth_m)) return;
  // Once the buffer is full it is a heap with the shallowest on top: a new contact must be deeper than that one.
  const auto deeper = [](const PointContact& l, const PointContact& r) { return l.depth_m > r.depth_m; };
  if (count_ < storage_.size()) {
    storage_[count_++] = contact;
    if (count_ == storage_.size()) std::make_heap(storage_.begin(), storage_.end(), deeper);
  } else {
    std::pop_heap(storage_.begin(), storage_.end(), deeper);
    storage_.back() = contact;
    std::push_heap(storage_.begin(), storage_.end(), deeper);
  }
}

PointRuns runs_of(const Object& object) noexcept {
  const Cluster& first = object.clusters.front();
  constexpr std::size_t kStride = sizeof(Cluster) / sizeof(float);
  static_assert(sizeof(Cluster) % sizeof(float) == 0);
  return {first.samples_O.x.data(), first.samples_O.y.data(),
          first.samples_O.z.data(), kStride,
          first.quads_O.view(),     kStride};
}

void find_contacts(const Object& a, const Pose& X_WA, const Object& b, const Pose& X_WB, ContactBuffer& out) noexcept {
  if (are_apart(a.bound_O, X_WB * b.bound_O.center - X_WA * a.bound_O.center, b.bound_O)) return;
  const Pose X_BA = X_WB.inverse() * X_WA;
  if (!overlap(b.bound_O, X_BA * a.bound_O.center, a.bound_O.radius)) return;
  Direction(a, X_BA, b, ContactSink(X_WB, false, out)).run();
  Direction(b, X_BA.inverse(), a, ContactSink(X_WA, true, out)).run();
}

std::size_t find_surface(const Object& points, const Pose& X_TS, const Object& target,
                         std::span<SurfaceHit> out) noexcept {
  std::size_t count = 0;
  const Part* part = nullptr;
  Eigen::Matrix3f R_TQ;
  Vec3f p_TQ;
  Direction(points, X_TS, target, [&](const InsidePoint& inside, std::uint16_t) {
    if (count == out.size()) return;
    if (inside.part->part != part) {
      part = inside.part->part;
      R_TQ = part->X_OQ.R.toRotationMatrix().cast<float>();
      p_TQ = part->X_OQ.p.cast<float>();
    }
    const Vec3f p_QS = inside.p_Q + inside.depth_m * inside.n_Q;
    out[count++] = {R_TQ * p_QS + p_TQ, R_TQ * inside.n_Q, inside.depth_m};
  }).run();
  return count;
}

}  // namespace mechane::collision
