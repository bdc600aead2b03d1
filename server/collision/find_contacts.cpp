#include <array>
#include <cmath>

#include "server/collision/object.hpp"

namespace mechane::collision {
namespace {

// Parts of one object that a single cluster of 16 samples can lie in at once. More than a few means parts on top of each other; the
// first ones by index are kept.
constexpr std::size_t kMaxCandidates = 32;

/// Frame of the samples' object (S) to the frame of the object that they are tested against (T).
struct Relative {
  Pose X_TS;
  const Object& target;
  const Pose& X_WT;
  bool target_is_a;
};

/// A part of the target near the cluster, with the way from the samples' frame to the part's own.
struct Candidate {
  Eigen::Matrix3f R_QS;
  Vec3f p_QS;
  std::uint16_t part = 0;
};

bool overlap(const geometry::Sphere& a, const Vec3& center_b, double radius_b) noexcept {
  const double reach = a.radius + radius_b;
  return (a.center - center_b).squaredNorm() <= reach * reach;
}

Candidate make_candidate(const Relative& relative, std::size_t part) noexcept {
  const Pose X_QS = relative.target.parts[part].X_OQ.inverse() * relative.X_TS;
  return {X_QS.R.toRotationMatrix().cast<float>(), X_QS.p.cast<float>(), static_cast<std::uint16_t>(part)};
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

/// The samples of one cluster against the parts near it. A sample inside several parts counts once, in the part in which it lies most
/// centrally: parts overlap at their seams, and a map is at its best around its middle.
void test_cluster(const Relative& relative, const Object& source, const Cluster& cluster,
                  std::span<const Candidate> candidates, ContactBuffer& out) noexcept {
  for (std::uint32_t i = cluster.first; i < cluster.first + cluster.count; ++i) {
    const Candidate* best = nullptr;
    MapHit best_hit;
    Vec3f best_p = Vec3f::Zero();
    for (const Candidate& candidate : candidates) {
      const Vec3f p_QP = candidate.R_QS * source.samples_O[i] + candidate.p_QS;
      const MapHit hit = relative.target.parts[candidate.part].map.evaluate(p_QP);
      if (!hit.hit || (best != nullptr && hit.m >= best_hit.m)) continue;
      best = &candidate;
      best_hit = hit;
      best_p = p_QP;
    }
    if (best != nullptr) report(relative, *best, best_p, best_hit, cluster.part, out);
  }
}

/// Samples of `source` in parts of the target.
void test_samples(const Relative& relative, const Object& source, ContactBuffer& out) noexcept {
  const Object& target = relative.target;
  for (std::size_t s = 0; s < source.parts.size(); ++s) {
    const geometry::Sphere& part_bound = source.parts[s].bound_O;
    if (!overlap(target.bound_O, relative.X_TS * part_bound.center, part_bound.radius)) continue;
    for (std::uint32_t c = source.first_cluster[s]; c < source.first_cluster[s + 1]; ++c) {
      const Cluster& cluster = source.clusters[c];
      const Vec3 center_T = relative.X_TS * cluster.bound_O.center;
      if (!overlap(target.bound_O, center_T, cluster.bound_O.radius)) continue;
      std::array<Candidate, kMaxCandidates> near;
      std::size_t count = 0;
      for (std::size_t t = 0; t < target.parts.size() && count < near.size(); ++t) {
        if (overlap(target.parts[t].bound_O, center_T, cluster.bound_O.radius)) {
          near[count++] = make_candidate(relative, t);
        }
      }
      if (count > 0) test_cluster(relative, source, cluster, std::span(near).first(count), out);
    }
  }
}

}  // namespace

void ContactBuffer::add(const PointContact& contact) noexcept {
  if (count_ < storage_.size()) {
    storage_[count_++] = contact;
    return;
  }
  PointContact* shallowest = nullptr;
  for (PointContact& kept : storage_) {
    if (shallowest == nullptr || kept.depth_m < shallowest->depth_m) shallowest = &kept;
  }
  if (shallowest != nullptr && contact.depth_m > shallowest->depth_m) *shallowest = contact;
}

void find_contacts(const Object& a, const Pose& X_WA, const Object& b, const Pose& X_WB, ContactBuffer& out) noexcept {
  const Pose X_BA = X_WB.inverse() * X_WA;
  if (!overlap(b.bound_O, X_BA * a.bound_O.center, a.bound_O.radius)) return;
  test_samples({X_BA, b, X_WB, false}, a, out);
  test_samples({X_BA.inverse(), a, X_WA, true}, b, out);
}

}  // namespace mechane::collision
