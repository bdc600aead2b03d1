#include "server/geometry/surface_samples.hpp"

#include <algorithm>
#include <cmath>

#include "server/base/random.hpp"
#include "server/geometry/apart_filter.hpp"
#include "server/geometry/area_normal.hpp"

namespace mechane::geometry {
namespace {

constexpr double kClosest = 0.7;  // of the spacing
constexpr double kRefusedReach = 0.25;
constexpr double kCandidatesPerCell = 20;
constexpr std::size_t kMaxCandidates = 4'000'000;

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
  std::vector<SurfaceSample> vertices;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t v : mesh.triangles[i])
      vertices.push_back({mesh.vertices[v], i});
  }
  const double wanted = kCandidatesPerCell * surface_area_m2(mesh) / (spacing_m * spacing_m);
  const auto count = static_cast<std::size_t>(std::min(std::ceil(wanted), static_cast<double>(kMaxCandidates)));
  std::vector<SurfaceSample> random = sample_by_area(mesh, count, seed);
  // Sampling by area gives them triangle after triangle; the greedy choice needs them in random order (Fisher-Yates).
  Random shuffle(seed + 1);
  for (std::size_t i = random.size(); i > 1; --i)
    std::swap(random[i - 1], random[shuffle.below(i)]);

  ApartFilter apart(kClosest * spacing_m);
  ApartFilter refused(kRefusedReach * spacing_m);  // spares asking `accept` again and again beside a refused point
  std::vector<SurfaceSample> kept;
  const auto keep = [&](const SurfaceSample& sample) {
    apart.put(sample.p);
    kept.push_back(sample);
  };
  for (const SurfaceSample& vertex : vertices) {
    if (apart.is_apart(vertex.p) && (!accept || accept(vertex))) keep(vertex);
  }
  for (const SurfaceSample& candidate : random) {
    if (!apart.is_apart(candidate.p) || (accept && !refused.is_apart(candidate.p))) continue;
    if (accept && !accept(candidate)) {
      refused.put(candidate.p);
      continue;
    }
    keep(candidate);
  }
  return kept;
}

}  // namespace mechane::geometry
