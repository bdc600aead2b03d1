#include <algorithm>
#include <array>
#include <cmath>

#include "server/collision/object.hpp"

namespace mechane::collision {
namespace {

// Parts near the other object that are tested together. More than these are taken in batches, and a sample that lies in parts of two
// batches then counts twice.
constexpr std::size_t kBatch = 64;

/// Frame of the samples' object (S) to the frame of the object that they are tested against (T).
struct Relative {
  Pose X_TS;
  const Object& target;
  const Pose& X_WT;
  bool target_is_a;
};

/// A part of the target, with the way from the samples' frame to the part's own.
struct Candidate {
  Eigen::Matrix3f R_QS;
  Vec3f p_QS;
  std::uint16_t part = 0;
};

bool overlap(const geometry::Sphere& a, const Vec3& center_b, double radius_b) noexcept {
  const double reach = a.radius + radius_b;
  return (a.center - center_b).squaredNorm() <= reach * reach;
}

/// Whether a sphere reaches the map's box: the tight cull for parts that are long and thin. An empty map has no box.
bool reaches_box(const RadialMap& map, const Vec3f& center_Q, float radius) noexcept {
  if (map.resolution() == 0) return true;
  const Vec3f outside = ((center_Q - map.center_Q()).cwiseAbs() - map.half_Q()).cwiseMax(0.0F);
  return outside.squaredNorm() <= radius * radius;
}

/// Fills `near` with the parts of the target, from `next` on, that the sphere (in S) reaches.
std::size_t collect(const Relative& relative, const geometry::Sphere& bound_S, std::size_t& next,
                    std::span<Candidate> near) noexcept {
  std::size_t count = 0;
  const Vec3 center_T = relative.X_TS * bound_S.center;
  for (; next < relative.target.parts.size() && count < near.size(); ++next) {
    const Part& part = relative.target.parts[next];
    if (!overlap(part.bound_O, center_T, bound_S.radius)) continue;
    const Pose X_QS = part.X_OQ.inverse() * relative.X_TS;
    const Vec3f center_Q = (X_QS * bound_S.center).cast<float>();
    if (!reaches_box(part.map, center_Q, static_cast<float>(bound_S.radius))) continue;
    near[count++] = {X_QS.R.toRotationMatrix().cast<float>(), X_QS.p.cast<float>(), static_cast<std::uint16_t>(next)};
  }
  return count;
}

void report(const Relative& relative, const Candidate& candidate, const Vec3f& p_QP, const MapHit& hit,
            std::uint16_t sample_part, ContactBuffer& out) noexcept {
  const Pose X_WQ = relative.X_WT * relative.target.parts[candidate.part].X_OQ;
  const Vec3 n_W = X_WQ.rotate(hit.n_Q.cast<double>());  // out of the target
  PointContact contact;
  contact.depth_m = hit.depth_m;
  if (relative.target_is_a) {
    contact.p_WC = X_WQ * p_QP.cast<double>();  // the sample itself lies on B's surface
    contact.n_BA_W = -n_W;
    contact.part_a = candidate.part;
    contact.part_b = sample_part;
  } else {
    contact.p_WC = X_WQ * hit.p_QS.cast<double>();
    contact.n_BA_W = n_W;
    contact.part_a = sample_part;
    contact.part_b = candidate.part;
  }
  out.add(contact);
}

/// One sample against the parts near it. A sample inside several parts counts once, in the part in which it lies most centrally: parts
/// overlap at their seams, and a map is at its best around its middle.
void test_sample(const Relative& relative, const Vec3f& p_SP, std::span<const Candidate* const> near,
                 std::uint16_t sample_part, ContactBuffer& out) noexcept {
  const Candidate* best = nullptr;
  MapHit best_hit;
  Vec3f best_p = Vec3f::Zero();
  for (const Candidate* candidate : near) {
    const Vec3f p_QP = candidate->R_QS * p_SP + candidate->p_QS;
    const MapHit hit = relative.target.parts[candidate->part].map.evaluate(p_QP);
    if (!hit.hit || (best != nullptr && hit.m >= best_hit.m)) continue;
    best = candidate;
    best_hit = hit;
    best_p = p_QP;
  }
  if (best != nullptr) report(relative, *best, best_p, best_hit, sample_part, out);
}

void test_cluster(const Relative& relative, const Object& source, const Cluster& cluster,
                  std::span<const Candidate> candidates, ContactBuffer& out) noexcept {
  const Vec3f center_S = cluster.bound_O.center.cast<float>();
  const auto radius = static_cast<float>(cluster.bound_O.radius);
  std::array<const Candidate*, kBatch> near;
  std::size_t count = 0;
  for (const Candidate& candidate : candidates) {
    const Vec3f center_Q = candidate.R_QS * center_S + candidate.p_QS;
    if (reaches_box(relative.target.parts[candidate.part].map, center_Q, radius)) near[count++] = &candidate;
  }
  if (count == 0) return;
  for (std::uint32_t i = cluster.first; i < cluster.first + cluster.count; ++i) {
    test_sample(relative, source.samples_O[i], std::span(near).first(count), cluster.part, out);
  }
}

/// Samples of `source` in parts of the target.
void test_samples(const Relative& relative, const Object& source, ContactBuffer& out) noexcept {
  const Object& target = relative.target;
  const Pose X_ST = relative.X_TS.inverse();
  const Vec3 target_center_S = X_ST * target.bound_O.center;
  const auto target_radius = static_cast<float>(target.bound_O.radius);
  std::array<Candidate, kBatch> storage;
  for (std::size_t next = 0; next < target.parts.size();) {
    const std::size_t count = collect(relative, source.bound_O, next, storage);
    if (count == 0) continue;
    for (std::size_t s = 0; s < source.parts.size(); ++s) {
      const Part& part = source.parts[s];
      if (!overlap(part.bound_O, target_center_S, target.bound_O.radius)) continue;
      const Vec3f target_center_Q = (part.X_OQ.inverse() * target_center_S).cast<float>();
      if (!reaches_box(part.map, target_center_Q, target_radius)) continue;
      for (std::uint32_t c = source.first_cluster[s]; c < source.first_cluster[s + 1]; ++c) {
        const Cluster& cluster = source.clusters[c];
        if (!overlap(cluster.bound_O, target_center_S, target.bound_O.radius)) continue;
        test_cluster(relative, source, cluster, std::span(storage).first(count), out);
      }
    }
  }
}

}  // namespace

void ContactBuffer::add(const PointContact& contact) noexcept {
  if (storage_.empty()) return;
  // A heap with the shallowest on top, once it is full: the one to beat.
  const auto deeper = [](const PointContact& l, const PointContact& r) { return l.depth_m > r.depth_m; };
  if (count_ < storage_.size()) {
    storage_[count_++] = contact;
    if (count_ == storage_.size()) std::make_heap(storage_.begin(), storage_.end(), deeper);
  } else if (contact.depth_m > storage_.front().depth_m) {
    std::pop_heap(storage_.begin(), storage_.end(), deeper);
    storage_.back() = contact;
    std::push_heap(storage_.begin(), storage_.end(), deeper);
  }
}

void find_contacts(const Object& a, const Pose& X_WA, const Object& b, const Pose& X_WB, ContactBuffer& out) noexcept {
  const Pose X_BA = X_WB.inverse() * X_WA;
  if (!overlap(b.bound_O, X_BA * a.bound_O.center, a.bound_O.radius)) return;
  test_samples({X_BA, b, X_WB, false}, a, out);
  test_samples({X_BA.inverse(), a, X_WA, true}, b, out);
}

}  // namespace mechane::collision
