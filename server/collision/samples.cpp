#include "server/collision/samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "server/base/assert.hpp"

namespace mechane::collision {
namespace {

constexpr double kFloatRounding = 1.2e-7;  // of a place's distance from the origin, at most

/// Sorts the points so that each run of 16 is compact: halve along the longest side, at a multiple of 16.
void sort_into_runs(std::span<Vec3> points) {
  if (points.size() <= kLanes) return;
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points)
    box.extend(p);
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const std::size_t runs = (points.size() + kLanes - 1) / kLanes;
  const std::size_t half = runs / 2 * kLanes;
  // A total order, so that the result does not depend on the library where coordinates are equal.
  const auto less = [axis](const Vec3& l, const Vec3& r) {
    if (l[axis] != r[axis]) return l[axis] < r[axis];
    return std::lexicographical_compare(l.begin(), l.end(), r.begin(), r.end());
  };
  std::sort(points.begin(), points.end(), less);
  sort_into_runs(points.first(half));
  sort_into_runs(points.subspan(half));
}

/// Around some of the object's clusters.
geometry::Sphere sphere_around(std::span<const Cluster> clusters) {
  Eigen::AlignedBox3d box;
  for (const Cluster& cluster : clusters) {
    box.extend(Vec3(cluster.bound_O.center.array() - cluster.bound_O.radius));
    box.extend(Vec3(cluster.bound_O.center.array() + cluster.bound_O.radius));
  }
  geometry::Sphere sphere{box.center(), 0};
  for (const Cluster& cluster : clusters)
    sphere.radius = std::max(sphere.radius, (cluster.bound_O.center - sphere.center).norm() + cluster.bound_O.radius);
  return sphere;
}

void close_groups(Object& object) {
  object.groups.clear();
  object.first_group.clear();
  std::size_t next = 0;
  std::uint32_t samples = 0;
  for (std::size_t part = 0; part < object.parts.size(); ++part) {
    object.first_group.push_back(static_cast<std::uint32_t>(object.groups.size()));
    for (; next < object.clusters.size() && object.clusters[next].part == part; ++next) {
      const bool starts = object.groups.size() == object.first_group.back() || object.groups.back().count == kLanes;
      if (starts) object.groups.push_back({{}, {}, static_cast<std::uint32_t>(next), 0});
      ClusterGroup& group = object.groups.back();
      object.clusters[next].first_sample = samples;
      samples += object.clusters[next].count;
      const geometry::Sphere& bound = object.clusters[next].bound_O;
      const std::size_t lane = group.count++;
      group.bounds_O.x[lane] = static_cast<float>(bound.center.x());
      group.bounds_O.y[lane] = static_cast<float>(bound.center.y());
      group.bounds_O.z[lane] = static_cast<float>(bound.center.z());
      group.bounds_O.radius[lane] = static_cast<float>(bound.radius * (1 + 1e-6));  // rounded up
    }
  }
  for (ClusterGroup& group : object.groups)
    group.bound_O = sphere_around(std::span(object.clusters).subspan(group.first_cluster, group.count));
  object.first_group.push_back(static_cast<std::uint32_t>(object.groups.size()));
  MECHANE_ASSERT(next == object.clusters.size());
}

}  // namespace

geometry::Sphere bounding_sphere(std::span<const Vec3> points) {
  geometry::Sphere sphere;
  if (points.empty()) return sphere;
  const auto farthest = [&](const Vec3& from) {
    return *std::max_element(points.begin(), points.end(), [&](const Vec3& l, const Vec3& r) {
      return (l - from).squaredNorm() < (r - from).squaredNorm();
    });
  };
  const Vec3 p = farthest(points.front());
  const Vec3 q = farthest(p);
  sphere.center = 0.5 * (p + q);
  sphere.radius = 0.5 * (p - q).norm();
  for (const Vec3& x : points) {
    const double distance = (x - sphere.center).norm();
    if (distance <= sphere.radius) continue;
    const double grown = 0.5 * (sphere.radius + distance);
    sphere.center += (distance - grown) / distance * (x - sphere.center);
    sphere.radius = grown;
  }
  for (const Vec3& x : points)
    sphere.radius = std::max(sphere.radius, (x - sphere.center).norm());
  sphere.radius *= 1 + 1e-6;  // for the rounding above
  return sphere;
}

QuadSpheres quad_spheres(const PointBlock& points) {
  QuadSpheres quads;
  for (std::size_t quad = 0; quad < quads.x.size(); ++quad) {
    std::array<Vec3, 4> four;
    for (std::size_t i = 0; i < four.size(); ++i)
      four[i] = Vec3f(points.x[4 * quad + i], points.y[4 * quad + i], points.z[4 * quad + i]).cast<double>();
    const geometry::Sphere sphere = bounding_sphere(four);
    quads.x[quad] = static_cast<float>(sphere.center.x());
    quads.y[quad] = static_cast<float>(sphere.center.y());
    quads.z[quad] = static_cast<float>(sphere.center.z());
    quads.radius[quad] = static_cast<float>((sphere.radius + kFloatRounding * sphere.center.norm()) * (1 + 1e-6));
  }
  return quads;
}

void append_samples(Object& object, std::uint16_t part, std::vector<Vec3> points_O) {
  sort_into_runs(points_O);
  const std::span<const Vec3> points(points_O);
  for (std::size_t at = 0; at < points.size(); at += kLanes) {
    const auto run = points.subspan(at, std::min(kLanes, points.size() - at));
    Cluster cluster;
    cluster.count = static_cast<std::uint16_t>(run.size());
    cluster.part = part;
    std::array<Vec3, kLanes> rounded;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const Vec3f p = run[lane < run.size() ? lane : 0].cast<float>();
      cluster.samples_O.x[lane] = p.x();
      cluster.samples_O.y[lane] = p.y();
      cluster.samples_O.z[lane] = p.z();
      rounded[lane] = p.cast<double>();
    }
    cluster.bound_O = bounding_sphere(rounded);
    // The kernels get the centre in float32, too: far from the origin that moves it by more than a small sphere's own margin.
    cluster.bound_O.radius += kFloatRounding * cluster.bound_O.center.norm();
    object.clusters.push_back(cluster);
  }
}

void close_clusters(Object& object) {
  for (Cluster& cluster : object.clusters)
    cluster.quads_O = quad_spheres(cluster.samples_O);
  close_groups(object);
  Eigen::AlignedBox3d box;
  for (const Part& part : object.parts) {
    box.extend(Vec3(part.bound_O.center.array() - part.bound_O.radius));
    box.extend(Vec3(part.bound_O.center.array() + part.bound_O.radius));
  }
  object.bound_O = {};
  if (object.parts.empty()) return;
  object.bound_O.center = box.center();
  for (const Part& part : object.parts) {
    const double reach = (part.bound_O.center - object.bound_O.center).norm() + part.bound_O.radius;
    object.bound_O.radius = std::max(object.bound_O.radius, reach);
  }
}

std::size_t sample_count(const Object& object) {
  std::size_t count = 0;
  for (const Cluster& cluster : object.clusters)
    count += cluster.count;
  return count;
}

}  // namespace mechane::collision
