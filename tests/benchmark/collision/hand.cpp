// The hand: sixteen superquadrics, 128 samples each. Lengths in units of about 14 cm, as the objects'.
#include <cmath>

#include "server/base/assert.hpp"
#include "server/collision/samples.hpp"
#include "server/geometry/superquadric_mesh.hpp"
#include "server/geometry/surface_samples.hpp"
#include "tests/benchmark/collision/scene.hpp"

namespace mechane::benchmark {
namespace {

constexpr double kHandUnit_m = 0.14;
constexpr int kFineCells = 24;
constexpr std::uint64_t kSampleSeed = 7;
constexpr std::array<double, kJoints> kHalfLengths = {0.15, 0.12, 0.10};  // of a finger's segments
constexpr std::array<double, kJoints> kHalfWidths = {0.075, 0.068, 0.06};
constexpr double kThumb = 0.85;  // its length against a finger's

geometry::Superquadric shape_of(std::size_t segment) {
  geometry::Superquadric shape;
  if (segment == 0) {
    shape.a = kHandUnit_m * Vec3(0.30, 0.32, 0.09);
    shape.e1 = shape.e2 = 0.5;
    return shape;
  }
  const std::size_t joint = (segment - 1) % kJoints;
  const double length = kHalfLengths[joint] * (segment <= kJoints ? kThumb : 1);
  shape.a = kHandUnit_m * Vec3(length, kHalfWidths[joint], 0.9 * kHalfWidths[joint]);
  shape.e1 = 0.7;
  shape.e2 = 0.8;
  return shape;
}

/// 9 rings of 14 vertices and two poles: 128 vertices, as many as there are samples.
geometry::Mesh coarse_mesh(const geometry::Superquadric& shape) {
  constexpr std::uint32_t kAround = 14;
  constexpr std::uint32_t kBands = 10;
  geometry::Mesh mesh;
  const auto at = [&](double eta, double omega) {
    mesh.vertices.push_back(geometry::surface_point(shape, {eta, omega}));
  };
  at(kPi / 2, 0);
  for (std::uint32_t band = 1; band < kBands; ++band)
    for (std::uint32_t i = 0; i < kAround; ++i)
      at(kPi / 2 - kPi * band / kBands, 2 * kPi * i / kAround - kPi + 1e-9);
  at(-kPi / 2, 0);
  const auto vertex = [](std::uint32_t band, std::uint32_t i) { return 1 + (band - 1) * kAround + i % kAround; };
  const std::uint32_t last = 1 + (kBands - 1) * kAround;
  for (std::uint32_t i = 0; i < kAround; ++i) {
    mesh.triangles.push_back({0, vertex(1, i), vertex(1, i + 1)});
    for (std::uint32_t band = 1; band + 1 < kBands; ++band) {
      mesh.triangles.push_back({vertex(band, i), vertex(band + 1, i), vertex(band + 1, i + 1)});
      mesh.triangles.push_back({vertex(band, i), vertex(band + 1, i + 1), vertex(band, i + 1)});
    }
    mesh.triangles.push_back({last, vertex(kBands - 1, i + 1), vertex(kBands - 1, i)});
  }
  return mesh;
}

Segment make_segment(std::size_t index) {
  Segment segment;
  segment.shape = shape_of(index);
  segment.mesh_S = coarse_mesh(segment.shape);
  std::vector<Vec3> points;
  const geometry::Mesh fine = geometry::tessellate(segment.shape, kFineCells);
  for (const auto& sample : geometry::sample_by_area(fine, kSegmentPoints, kSampleSeed + index))
    points.push_back(sample.p / geometry::radial_form(segment.shape, sample.p));
  collision::Object object;
  collision::append_samples(object, 0, std::move(points));
  MECHANE_ASSERT(collision::sample_count(object) == kSegmentPoints && object.clusters.size() == kSegmentClusters);
  std::vector<Vec3> all;
  collision::for_each_sample(object, [&](const collision::Cluster& cluster, std::size_t lane) {
    segment.samples_S.push_back(cluster.sample_O(lane));
    all.push_back(segment.samples_S.back().cast<double>());
  });
  for (std::size_t i = 0; i < kSegmentClusters; ++i) {
    MECHANE_ASSERT(object.clusters[i].count == kClusterPoints);
    segment.clusters_S[i] = object.clusters[i].bound_O;
  }
  for (std::size_t i = 0; i < segment.quads_S.size(); ++i)
    segment.quads_S[i] = collision::bounding_sphere(std::span(all).subspan(4 * i, 4));
  segment.bound_S = collision::bounding_sphere(all);
  return segment;
}

Pose turned(const Vec3& axis, double angle_rad) {
  return {Vec3::Zero(), Quat(Eigen::AngleAxisd(angle_rad, axis))};
}

Pose moved(double x, double y, double z) {
  return {kHandUnit_m * Vec3(x, y, z), Quat::Identity()};
}

}  // namespace

HandModel make_hand() {
  HandModel hand;
  for (std::size_t i = 0; i < kSegments; ++i)
    hand[i] = make_segment(i);
  return hand;
}

HandPose hand_pose(const Pose& X_WPalm, const Bends& bent_rad) {
  HandPose X_WS;
  X_WS[0] = X_WPalm;
  for (std::size_t finger = 0; finger < kFingers; ++finger) {
    const bool thumb = finger == 0;
    Pose joint = X_WPalm;
    if (thumb) {
      joint = joint * moved(0, -0.34, -0.02) * turned(Vec3::UnitZ(), -0.9);
    } else {
      joint = joint * moved(0.31, -0.26 + 0.173 * static_cast<double>(finger - 1), 0);
    }
    for (std::size_t i = 0; i < kJoints; ++i) {
      const double half = kHalfLengths[i] * (thumb ? kThumb : 1);
      joint = joint * turned(Vec3::UnitY(), bent_rad[finger][i]);
      X_WS[1 + kJoints * finger + i] = joint * moved(half, 0, 0);
      joint = joint * moved(2 * half, 0, 0);
    }
  }
  return X_WS;
}

void Scene::fill(std::size_t step, HandStep& out) const {
  out.X_WS = steps[step];
  out.center = Vec3f::Zero();
  for (std::size_t s = 0; s < kSegments; ++s) {
    const Eigen::Matrix3f R = out.X_WS[s].R.toRotationMatrix().cast<float>();
    const Vec3f p = out.X_WS[s].p.cast<float>();
    for (std::size_t i = 0; i < kSegmentPoints; ++i) {
      const Vec3f q = R * hand[s].samples_S[i] + p;
      out.x[s * kSegmentPoints + i] = q.x();
      out.y[s * kSegmentPoints + i] = q.y();
      out.z[s * kSegmentPoints + i] = q.z();
    }
    const auto sphere = [&](const geometry::Sphere& bound, std::size_t to, auto& x, auto& y, auto& z, auto& r) {
      const Vec3f q = R * bound.center.cast<float>() + p;
      x[to] = q.x();
      y[to] = q.y();
      z[to] = q.z();
      r[to] = static_cast<float>(bound.radius);
    };
    for (std::size_t c = 0; c < kSegmentClusters; ++c)
      sphere(hand[s].clusters_S[c], s * kSegmentClusters + c, out.cluster_x, out.cluster_y, out.cluster_z,
             out.cluster_r);
    for (std::size_t q = 0; q < kSegmentPoints / 4; ++q)
      sphere(hand[s].quads_S[q], s * kSegmentPoints / 4 + q, out.quad_x, out.quad_y, out.quad_z, out.quad_r);
    for (std::size_t i = 0; i < out.segment_R.size(); ++i)
      out.segment_R[i][s] = R(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3));
    sphere(hand[s].bound_S, s, out.segment_x, out.segment_y, out.segment_z, out.segment_r);
    out.center += p / kSegments;
  }
  out.radius = 0;
  for (std::size_t s = 0; s < kSegments; ++s) {
    const Vec3f q(out.segment_x[s], out.segment_y[s], out.segment_z[s]);
    out.radius = std::max(out.radius, (q - out.center).norm() + out.segment_r[s]);
  }
}

std::array<const float*, 9> rotations_of(const HandStep& hand) {
  std::array<const float*, 9> rotations{};
  for (std::size_t i = 0; i < rotations.size(); ++i)
    rotations[i] = hand.segment_R[i].data();
  return rotations;
}

}  // namespace mechane::benchmark
