#include "server/collision/part_map.hpp"

#include <algorithm>
#include <cmath>

#include "server/geometry/surface_samples.hpp"

namespace mechane::collision {
namespace {

constexpr double kMaxRho = 16;        // beyond it the surface is as good as nowhere
constexpr double kMinRho = 1.0 / 16;  // 'no hit'
constexpr std::size_t kCenters = 64;
constexpr std::size_t kWitnesses = 160;
constexpr double kClearanceWeight =
    0.1;  // a centre deep in the wood beats one that sees as much but lies close to a wall
constexpr double kOwnCenterBonus = 0.05;

struct Witness {
  Vec3 p = Vec3::Zero();
  Vec3 n = Vec3::Zero();
};

/// Places of the part's surface that border on air.
std::vector<Witness> witnesses(const Solid& solid, std::size_t part, const geometry::Mesh& mesh, std::uint64_t seed) {
  std::vector<Witness> found;
  for (const auto& sample : geometry::sample_by_area(mesh, kWitnesses, seed)) {
    const Vec3 n = solid.part(part).triangle_normal(sample.triangle);
    if (solid.is_exposed(part, sample.p, n)) found.push_back({sample.p, n});
  }
  return found;
}

/// The share of the witnesses that the centre sees through wood alone.
double seen_share(const Solid& solid, std::size_t part, const Vec3& center, const std::vector<Witness>& all) {
  std::size_t seen = 0;
  for (const Witness& w : all) {
    if (solid.walk(part, center, w.p - center, 2) > 0.98 && w.n.dot(w.p - center) > 0) ++seen;
  }
  return all.empty() ? 0 : static_cast<double>(seen) / static_cast<double>(all.size());
}

/// Middles of chords through the part, straight in from its surface.
std::vector<Vec3> candidate_centers(const Solid& solid, std::size_t part, const geometry::Mesh& mesh,
                                    std::uint64_t seed) {
  std::vector<Vec3> centers;
  std::vector<geometry::RayHit> hits;
  for (const auto& sample : geometry::sample_by_area(mesh, kCenters, seed + 1)) {
    const Vec3 inward = -solid.part(part).triangle_normal(sample.triangle);
    const Vec3 start = sample.p + 1e-7 * inward;
    solid.part(part).cast(start, inward, hits);
    if (!hits.empty()) centers.push_back(start + 0.5 * hits.front().t * inward);
  }
  return centers;
}

Vec3 choose_center(const Solid& solid, std::size_t part, const geometry::Mesh& mesh, const Vec3& own,
                   std::uint64_t seed) {
  if (!solid.is_closed(part)) return own;
  const std::vector<Witness> surface = witnesses(solid, part, mesh, seed);
  std::vector<Vec3> centers = candidate_centers(solid, part, mesh, seed);
  if (solid.part(part).winding(own) > 0) centers.insert(centers.begin(), own);
  std::vector<double> clearance;
  clearance.reserve(centers.size());
  for (const Vec3& c : centers)
    clearance.push_back(solid.part(part).closest(c).distance_m);
  const double widest = clearance.empty() ? 1 : *std::max_element(clearance.begin(), clearance.end());
  Vec3 best = own;
  double best_score = -1;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    double score = seen_share(solid, part, centers[i], surface) + kClearanceWeight * clearance[i] / widest;
    if (centers[i] == own) score += kOwnCenterBonus;
    if (score > best_score) {
      best_score = score;
      best = centers[i];
    }
  }
  return best;
}

}  // namespace

RadialMap cast_map(const Solid& solid, std::size_t part, const geometry::Mesh& mesh,
                   const geometry::Superquadric& shape, const Pose& X_OQ, int resolution, std::uint64_t seed) {
  const Vec3 center_O = choose_center(solid, part, mesh, X_OQ.p, seed);
  const Vec3 center_Q = X_OQ.inverse() * center_O;
  // The semi-axes scale the cube, widened where the centre is not the superquadric's own. A bent shape reaches beyond its axes.
  Vec3 half = shape.a + center_Q.cwiseAbs();
  for (const Vec3& v : mesh.vertices)
    half = half.cwiseMax((X_OQ.inverse() * v - center_Q).cwiseAbs());
  // Half a crack more on each side, so that parts beside a crack meet in it.
  const Vec3f half_Q = (1.0001 * half.array() + 0.5 * solid.seam_gap_m()).matrix().cast<float>();

  std::vector<float> sigma;
  sigma.reserve(6 * static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution));
  for (int face = 0; face < 6; ++face) {
    for (int texel = 0; texel < resolution * resolution; ++texel) {
      const Vec3 direction_Q =
          RadialMap::texel_direction(resolution, half_Q, face, texel % resolution, texel / resolution);
      const double rho = solid.walk(part, center_O, X_OQ.rotate(direction_Q), kMaxRho);
      sigma.push_back(static_cast<float>(1 / std::max(rho, kMinRho)));
    }
  }
  return RadialMap::from_sigma(resolution, center_Q.cast<float>(), half_Q, sigma);
}

}  // namespace mechane::collision
