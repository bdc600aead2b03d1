#include "server/dynamics/body_samples.hpp"

#include <algorithm>
#include <vector>

#include "server/collision/samples.hpp"
#include "server/geometry/apart_filter.hpp"

namespace mechane::dynamics {
namespace {

constexpr double kMostSpacing_m = 0.012;
constexpr double kShareOfExtent = 0.25;

double spacing_for(const collision::Part& part) {
  std::array<float, 3> half = part.map.box().half;
  std::sort(half.begin(), half.end());
  return std::min(kMostSpacing_m, kShareOfExtent * 2 * static_cast<double>(half[1]));
}

/// From outside inwards, each sample that is `spacing_m` away from all that were kept before it.
std::vector<Vec3> spread(std::vector<Vec3> samples, const Vec3& center, double spacing_m) {
  std::stable_sort(samples.begin(), samples.end(), [&](const Vec3& l, const Vec3& r) {
    return (l - center).squaredNorm() > (r - center).squaredNorm();
  });
  std::vector<Vec3> kept;
  geometry::ApartFilter apart(spacing_m);
  for (const Vec3& p : samples) {
    if (!apart.is_apart(p)) continue;
    apart.put(p);
    kept.push_back(p);
  }
  return kept;
}

}  // namespace

collision::Object with_fewer_samples(const collision::Object& object) {
  std::vector<std::vector<Vec3>> samples(object.parts.size());
  collision::for_each_sample(object, [&](const collision::Cluster& cluster, std::size_t lane) {
    samples[cluster.part].push_back(cluster.sample_O(lane).cast<double>());
  });
  collision::Object out;
  out.parts = object.parts;
  for (std::size_t i = 0; i < out.parts.size(); ++i) {
    const collision::Part& part = out.parts[i];
    const double spacing_m = part.map.empty() ? kMostSpacing_m : spacing_for(part);
    const std::vector<Vec3> kept = spread(std::move(samples[i]), part.bound_O.center, spacing_m);
    collision::append_samples(out, static_cast<std::uint16_t>(i), kept);
  }
  collision::close_clusters(out);
  return out;
}

}  // namespace mechane::dynamics
