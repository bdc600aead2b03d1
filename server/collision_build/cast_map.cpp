#include "server/collision_build/cast_map.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "server/collision_build/texel_fit.hpp"

namespace mechane::collision_build {
namespace {

constexpr double kMaxRho = 16;        // beyond this there is practically no surface
constexpr double kMinRho = 1.0 / 16;  // 'no hit'
constexpr std::size_t kCenters = 64;
constexpr std::size_t kWitnesses = 160;
constexpr double kClearanceWeight =
    0.1;  // a centre deep in the solid beats one that sees as much but lies close to a wall
constexpr double kOwnCenterBonus = 0.05;
constexpr double kPieceMargin = 1.03;

/// About `count` of the places, evenly chosen.
std::vector<SurfacePlace> some_of(std::span<const SurfacePlace> all, std::size_t count) {
  std::vector<SurfacePlace> chosen;
  const std::size_t step = std::max<std::size_t>(1, all.size() / count);
  for (std::size_t i = step / 2; i < all.size(); i += step)
    chosen.push_back(all[i]);
  return chosen;
}

/// The share of the witnesses that are seen from the centre through the solid alone. Stops where `is_too_few` is true of the most that the
/// share can still become.
template <class IsTooFew>
double seen_share(const Solid& solid, const Vec3& center, std::span<const SurfacePlace> all,
                  const IsTooFew& is_too_few) {
  std::size_t hidden = 0;
  const auto share = [&] { return static_cast<double>(all.size() - hidden) / static_cast<double>(all.size()); };
  for (const SurfacePlace& w : all) {
    if (w.n_O.dot(w.p_O - center) > 0 && solid.walk(center, w.p_O - center, 2) > 0.98) continue;
    ++hidden;
    if (is_too_few(share())) break;
  }
  return all.empty() ? 0 : share();
}

/// Middles of chords through the part, straight in from its surface.
std::vector<Vec3> candidate_centers(const Solid& solid, std::size_t node, std::span<const SurfacePlace> places) {
  std::vector<Vec3> centers;
  std::vector<geometry::RayHit> hits;
  for (const SurfacePlace& place : some_of(places, kCenters)) {
    const Vec3 start = place.p_O - 1e-7 * place.n_O;
    solid.part(node).cast(start, -place.n_O, hits);
    if (!hits.empty()) centers.push_back(start - 0.5 * hits.front().t * place.n_O);
  }
  return centers;
}

Vec3 choose_center(const Solid& solid, std::size_t node, std::span<const SurfacePlace> places,
                   std::span<const geometry::HalfSpace> cell, const Vec3& own) {
  const std::vector<SurfacePlace> witnesses = some_of(places, kWitnesses);
  std::vector<Vec3> centers = candidate_centers(solid, node, places);
  if (solid.part(node).contains(own)) centers.insert(centers.begin(), own);
  // A centre in another piece would make a map of that piece.
  std::erase_if(centers, [&](const Vec3& c) { return !geometry::cell_contains(cell, c); });
  std::vector<double> clearance;
  clearance.reserve(centers.size());
  for (const Vec3& c : centers)
    clearance.push_back(solid.part(node).closest(c).distance_m);
  const double widest = clearance.empty() ? 1 : *std::max_element(clearance.begin(), clearance.end());
  Vec3 best = own;
  double best_score = -1;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const auto score_of = [&](double share) {
      const double score = share + kClearanceWeight * clearance[i] / widest;
      return centers[i] == own ? score + kOwnCenterBonus : score;
    };
    const double score =
        score_of(seen_share(solid, centers[i], witnesses, [&](double share) { return score_of(share) <= best_score; }));
    if (score > best_score) {
      best_score = score;
      best = centers[i];
    }
  }
  return best;
}

}  // namespace

MapFrame choose_frame(const Solid& solid, std::size_t node, std::span<const SurfacePlace> places,
                      std::span<const geometry::HalfSpace> cell, std::span<const Vec3> bound_points_O,
                      const Pose& X_OQ) {
  MapFrame frame;
  frame.X_OQ = X_OQ;
  const Pose X_QO = X_OQ.inverse();
  frame.center_Q = X_QO * choose_center(solid, node, places, cell, X_OQ.p);
  // The cube spans the part in the superquadric's frame, and no more: other parts answer for the solid beyond.
  for (const Vec3& p_O : bound_points_O)
    frame.half_Q = frame.half_Q.cwiseMax((X_QO * p_O - frame.center_Q).cwiseAbs());
  // Half a crack more on each side, so that parts beside a crack meet in it. A little more for pieces: their samples miss their corners.
  const double wider = cell.empty() ? 1.0001 : kPieceMargin;
  frame.half_Q = (wider * frame.half_Q.array() + 0.5 * solid.seam_gap_m() + 1e-6).matrix();
  return frame;
}

collision::RadialMap cast_map(const Solid& solid, const MapFrame& frame, int resolution) {
  const Vec3f half_Q = frame.half_Q.cast<float>();
  const Vec3 center_O = frame.X_OQ * frame.center_Q;
  const int rays = (resolution - 1) * rays_per_cell(resolution) + 1;
  std::vector<float> texels;
  texels.reserve(6 * static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution));
  std::vector<float> sigma(static_cast<std::size_t>(rays) * static_cast<std::size_t>(rays));
  for (int face = 0; face < 6; ++face) {
    for (int ray = 0; ray < rays * rays; ++ray) {
      const Vec3 direction_Q = collision::RadialMap::texel_direction(rays, half_Q, face, ray % rays, ray / rays);
      const double rho = solid.walk(center_O, frame.X_OQ.rotate(direction_Q), kMaxRho);
      sigma[static_cast<std::size_t>(ray)] = static_cast<float>(1 / std::max(rho, kMinRho));
    }
    const std::vector<float> fitted = fit_texels(resolution, sigma);
    texels.insert(texels.end(), fitted.begin(), fitted.end());
  }
  join_faces(resolution, texels);
  return collision::RadialMap::from_sigma(resolution, frame.center_Q.cast<float>(), half_Q, texels);
}

}  // namespace mechane::collision_build
