#include "server/geometry/surface_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "server/base/random.hpp"
#include "server/geometry/area_normal.hpp"

namespace mechane::geometry {
namespace {

constexpr double kClosest = 0.7;  // of the spacing
constexpr double kRefusedReach = 0.25;
constexpr double kCandidatesPerCell = 20;
constexpr std::size_t kMaxCandidates = 4'000'000;

/// Keeps points apart: a hash of cells as wide as the least distance.
class ApartFilter {
 public:
  explicit ApartFilter(double least_m) : least_(least_m) {}

  /// Whether a point would lie at least the least distance from all points put in so far.
  [[nodiscard]] bool is_apart(const Vec3& p) const {
    // Its own cell first, the corners last: nearly all points have one nearby, and are refused at once.
    static constexpr std::array<int, 27> kNearestFirst{13, 4,  10, 12, 14, 16, 22, 1, 3, 5,  7,  9,  11, 15,
                                                       17, 19, 21, 23, 25, 0,  2,  6, 8, 18, 20, 24, 26};
    const Cell c = cell(p);
    for (const int n : kNearestFirst) {
      const auto found = cells_.find(key({c[0] + n % 3 - 1, c[1] + n / 3 % 3 - 1, c[2] + n / 9 - 1}));
      if (found == cells_.end()) continue;
      for (const Vec3& q : found->second) {
        if ((q - p).squaredNorm() < least_ * least_) return false;
      }
    }
    return true;
  }
  void put(const Vec3& p) { cells_[key(cell(p))].push_back(p); }

 private:
  using Cell = std::array<std::int64_t, 3>;
  [[nodiscard]] Cell cell(const Vec3& p) const {
    return {std::llround(p.x() / least_), std::llround(p.y() / least_), std::llround(p.z() / least_)};
  }
  // Two cells may share a key. That only costs a few more comparisons.
  [[nodiscard]] static std::uint64_t key(const Cell& c) {
    return static_cast<std::uint64_t>(c[0]) * 73856093U ^ static_cast<std::uint64_t>(c[1]) * 19349663U ^
           static_cast<std::uint64_t>(c[2]) * 83492791U;
  }

  double least_;
  std::unordered_map<std::uint64_t, std::vector<Vec3>> cells_;
};

}  // namespace

double surface_area_m2(const Mesh& mesh) {
  double area = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    area += 0.5 * area_normal(mesh, i).norm();
  return area;
}

std::vector<SurfaceSample> sample_by_area(const Mesh& mesh, std::size_t count, std::uint64_t seed) {
  std::vector<SurfaceSample> samples;
  std::vector<double> running(mesh.triangles.size());
  double area = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    running[i] = area += 0.5 * area_normal(mesh, i).norm();
  if (!(area > 0)) return samples;
  Random random(seed);
  samples.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double at = area * (static_cast<double>(k) + random.unit()) / static_cast<double>(count);
    const auto found = std::upper_bound(running.begin(), running.end(), at);
    const auto i = std::min<std::size_t>(static_cast<std::size_t>(found - running.begin()), running.size() - 1);
    // Uniform in a triangle: the root turns the square's density into the triangle's.
    const double root = std::sqrt(random.unit());
    const double v = random.unit();
    const auto& t = mesh.triangles[i];
    samples.push_back(
        {(1 - root) * mesh.vertices[t[0]] + root * (1 - v) * mesh.vertices[t[1]] + root * v * mesh.vertices[t[2]],
         static_cast<std::uint32_t>(i)});
  }
  return samples;
}

std::vector<SurfaceSample> sample_by_spacing(const Mesh& mesh, double spacing_m, std::uint64_t seed,
                                             const std::function<bool(const SurfaceSample&)>& accept) {
  // A vertex once for each of its triangles: one of them may be accepted where another is not.
  std::vector<SurfaceSample> candidates;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t v : mesh.triangles[i])
      candidates.push_back({mesh.vertices[v], i});
  }
  const double wanted = kCandidatesPerCell * surface_area_m2(mesh) / (spacing_m * spacing_m);
  const auto count = static_cast<std::size_t>(std::min(std::ceil(wanted), static_cast<double>(kMaxCandidates)));
  std::vector<SurfaceSample> random = sample_by_area(mesh, count, seed);
  // Sampling by area gives them triangle after triangle; the greedy choice needs them in random order (Fisher-Yates).
  Random shuffle(seed + 1);
  for (std::size_t i = random.size(); i > 1; --i)
    std::swap(random[i - 1], random[shuffle.below(i)]);
  const std::size_t first_random = candidates.size();
  candidates.insert(candidates.end(), random.begin(), random.end());

  ApartFilter apart(kClosest * spacing_m);
  ApartFilter refused(kRefusedReach * spacing_m);  // spares asking `accept` again and again beside a refused point
  std::vector<SurfaceSample> kept;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const SurfaceSample& candidate = candidates[i];
    if (!apart.is_apart(candidate.p)) continue;
    if (accept) {
      if (i >= first_random && !refused.is_apart(candidate.p)) continue;
      if (!accept(candidate)) {
        if (i >= first_random) refused.put(candidate.p);
        continue;
      }
    }
    apart.put(candidate.p);
    kept.push_back(candidate);
  }
  return kept;
}

}  // namespace mechane::geometry
