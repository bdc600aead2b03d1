#include "server/geometry/pieces/concave_places.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>

#include "server/geometry/area_normal.hpp"
#include "server/geometry/surface_samples.hpp"

namespace mechane::geometry {
namespace {

constexpr double kLeastAngle_rad = 8 * kPi / 180;
constexpr double kPlaceLength = 1.0 / 16;  // of the diagonal: a longer edge has several places
constexpr std::size_t kSmoothSamples = 2000;
constexpr double kLeastBend = 1.5;    // curvature times the diagonal
constexpr double kHessianStep = 1.5;  // cells
constexpr std::size_t kMostPlaces = 3000;

struct MeshEdge {
  std::uint64_t key = 0;
  std::uint32_t triangle = 0;
};

std::vector<MeshEdge> sorted_edges(const Mesh& mesh) {
  std::vector<MeshEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
      edges.push_back({std::uint64_t{low} << 32 | high, t});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const MeshEdge& a, const MeshEdge& b) {
    return std::pair(a.key, a.triangle) < std::pair(b.key, b.triangle);
  });
  return edges;
}

void add_crease(const Mesh& mesh, const MeshEdge& first, const MeshEdge& second, double diagonal,
                std::vector<ConcavePlace>& places) {
  const Vec3 n1 = area_normal(mesh, first.triangle).normalized();
  const Vec3 n2 = area_normal(mesh, second.triangle).normalized();
  const double angle = std::atan2(n1.cross(n2).norm(), n1.dot(n2));
  if (angle < kLeastAngle_rad || angle > kPi - 1e-3) return;
  const auto low = static_cast<std::uint32_t>(first.key >> 32);
  const auto high = static_cast<std::uint32_t>(first.key & 0xFFFFFFFFU);
  const Vec3& a = mesh.vertices[low];
  const Vec3& b = mesh.vertices[high];
  // Concave where the other triangle rises above the first one's plane.
  double rise = 0;
  for (const std::uint32_t v : mesh.triangles[second.triangle])
    rise += n1.dot(mesh.vertices[v] - a);
  if (rise <= 0) return;
  const double length = (b - a).norm();
  const int count = 1 + static_cast<int>(length / (kPlaceLength * diagonal));
  ConcavePlace place;
  place.along = (b - a).normalized();
  place.across = (n1 - n2).normalized();
  place.face_a = n1;
  place.face_b = n2;
  place.weight = angle * length / (count * diagonal);
  for (int i = 0; i < count; ++i) {
    place.p = a + (b - a) * ((i + 0.5) / count);
    places.push_back(place);
  }
}

/// Second derivatives of the distance, over a step wide enough to smooth the grid's corners.
Mat3 hessian(const DistanceGrid& grid, const Vec3& p, double step) {
  Mat3 h;
  const double middle = grid.at(p);
  for (int i = 0; i < 3; ++i) {
    const Vec3 u = step * Vec3::Unit(i);
    h(i, i) = grid.at(p + u) - 2 * middle + grid.at(p - u);
    for (int j = 0; j < i; ++j) {
      const Vec3 v = step * Vec3::Unit(j);
      h(i, j) = h(j, i) = 0.25 * (grid.at(p + u + v) - grid.at(p + u - v) - grid.at(p - u + v) + grid.at(p - u - v));
    }
  }
  return h / (step * step);
}

void add_smooth(const DistanceGrid& grid, const SurfaceSample& sample, const Vec3& n, double diagonal, double area_m2,
                std::vector<ConcavePlace>& places) {
  // On a surface of distance 0 the Hessian in the tangent plane is the curvature, negative where it is concave.
  const Mat3 h = hessian(grid, sample.p, kHessianStep * grid.cell_m());
  const Vec3 u = n.unitOrthogonal();
  const Vec3 v = n.cross(u);
  Eigen::Matrix2d tangential;
  tangential << u.dot(h * u), u.dot(h * v), v.dot(h * u), v.dot(h * v);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
  eigen.computeDirect(tangential);
  const double bend = -eigen.eigenvalues()[0] * diagonal;
  if (bend < kLeastBend) return;
  ConcavePlace place;
  place.p = sample.p;
  place.across = eigen.eigenvectors()(0, 0) * u + eigen.eigenvectors()(1, 0) * v;
  place.along = n.cross(place.across);
  place.weight = bend * area_m2 / (diagonal * diagonal);
  places.push_back(place);
}

}  // namespace

std::vector<ConcavePlace> find_concave_places(const Mesh& mesh, const DistanceGrid& grid, std::uint64_t seed) {
  const double diagonal = mesh.bounds().diagonal().norm();
  std::vector<ConcavePlace> places;
  const std::vector<MeshEdge> edges = sorted_edges(mesh);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const bool pair = edges[i].key == edges[i + 1].key && (i + 2 >= edges.size() || edges[i + 2].key != edges[i].key) &&
                      (i == 0 || edges[i - 1].key != edges[i].key);
    if (pair) add_crease(mesh, edges[i], edges[i + 1], diagonal, places);
  }
  const double area = surface_area_m2(mesh) / static_cast<double>(kSmoothSamples);
  for (const SurfaceSample& sample : sample_by_area(mesh, kSmoothSamples, seed))
    add_smooth(grid, sample, area_normal(mesh, sample.triangle).normalized(), diagonal, area, places);
  std::stable_sort(places.begin(), places.end(),
                   [](const ConcavePlace& a, const ConcavePlace& b) { return a.weight > b.weight; });
  if (places.size() > kMostPlaces) places.resize(kMostPlaces);
  return places;
}

}  // namespace mechane::geometry
