#include "client-sdk/fit/surface.hpp"

#include <algorithm>
#include <limits>

#include "server/base/parallel.hpp"
#include "server/collision_build/solid.hpp"
#include "server/geometry/area_normal.hpp"

namespace mechane::fit {
namespace {

constexpr double kReachShare = 0.02;   // of the diagonal
constexpr double kUnderShare = 0.005;  // how deep below a triangle its part is looked up
constexpr double kStartShare = 1e-6;   // so that a ray that starts on a face does not meet it
constexpr int kSteps = 6;
constexpr int kHalvings = 6;
constexpr double kCornerShare = 0.8;  // a triangle is probed at its middle, and this far towards its corners

Vec3 middle_of(const geometry::Mesh& mesh, std::uint32_t triangle) {
  const auto& v = mesh.triangles[triangle];
  return (mesh.vertices[v[0]] + mesh.vertices[v[1]] + mesh.vertices[v[2]]) / 3;
}

bool borders_on_air(const geometry::Mesh& mesh, std::uint32_t triangle, const collision_build::Solid& solid,
                    std::uint32_t owner) {
  const Vec3 n = geometry::area_normal(mesh, triangle).normalized();
  const Vec3 middle = middle_of(mesh, triangle);
  if (solid.is_exposed(owner, middle, n)) return true;
  const auto& corners = mesh.triangles[triangle];
  return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t v) {
    return solid.is_exposed(owner, (1 - kCornerShare) * middle + kCornerShare * mesh.vertices[v], n);
  });
}

/// The part whose superquadric's centre is nearest, in units of its size; for triangles where nothing is felt.
std::uint32_t nearest_part(const collision::Object& object, const Vec3& p_O) {
  std::uint32_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < object.parts.size(); ++i) {
    const Vec3 p_Q = object.parts[i].X_OQ.inverse() * p_O;
    const double distance = p_Q.cwiseQuotient(object.parts[i].superquadric.a).norm();
    if (distance >= least) continue;
    least = distance;
    best = i;
  }
  return best;
}

collision_build::Solid solid_of(const FittedObject& fitted) {
  std::vector<geometry::Mesh> meshes;
  meshes.reserve(fitted.report.solids.size());
  for (const geometry::SolidMesh& solid : fitted.report.solids)
    meshes.push_back(solid.mesh);
  return {meshes, fitted.config.seam_gap_m};
}

}  // namespace

Surface::Surface(const FittedObject& fitted)
    : probe_(fitted.object), solid_(solid_of(fitted)), skin_(geometry::Mesh{}), parts_(fitted.object.parts.size()) {
  for (std::uint32_t m = 0; m < fitted.report.solids.size(); ++m) {
    const geometry::Mesh& mesh = fitted.report.solids[m].mesh;
    const auto& origin = fitted.report.solids[m].origin;
    origin_.insert(origin_.end(), origin.begin(), origin.end());
    const auto base = static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.insert(mesh_.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& t : mesh.triangles)
      mesh_.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
    mesh_of_triangle_.resize(mesh_.triangles.size(), m);
  }
  diagonal_m_ = mesh_.bounds().diagonal().norm();
  find_skin();
  assign_parts(fitted);
}

void Surface::find_skin() {
  // Bytes, because threads must not share the words of a vector<bool>.
  std::vector<std::uint8_t> exposed(mesh_.triangles.size());
  for_each_index(mesh_.triangles.size(), [&](std::size_t t) {
    exposed[t] = borders_on_air(mesh_, static_cast<std::uint32_t>(t), solid_, mesh_of_triangle_[t]) ? 1 : 0;
  });
  geometry::Mesh skin;
  skin.vertices = mesh_.vertices;
  for (std::size_t t = 0; t < exposed.size(); ++t) {
    exposed_.push_back(exposed[t] != 0);
    if (exposed[t] != 0) skin.triangles.push_back(mesh_.triangles[t]);
  }
  skin_ = geometry::MeshQuery(skin);
}

/// If the author defined the parts, they are the meshes; if the builder cut, a triangle belongs to the part that is
/// felt below it.
void Surface::assign_parts(const FittedObject& fitted) {
  if (parts_ == fitted.meshes.size()) {
    part_of_triangle_ = mesh_of_triangle_;
    return;
  }
  part_of_triangle_.resize(mesh_.triangles.size());
  for_each_index(mesh_.triangles.size(), [&](std::size_t i) {
    const auto t = static_cast<std::uint32_t>(i);
    const Vec3 p = middle_of(mesh_, t);
    const Felt felt = probe_.at(p - kUnderShare * diagonal_m_ * geometry::area_normal(mesh_, t).normalized());
    part_of_triangle_[i] = felt.hit ? static_cast<std::uint32_t>(felt.part) : nearest_part(fitted.object, p);
  });
}

std::vector<std::size_t> Surface::triangles_of_parts() const {
  std::vector<std::size_t> counts(parts_);
  for (const std::uint32_t part : part_of_triangle_)
    ++counts[part];
  return counts;
}

double Surface::reach_m() const {
  return kReachShare * diagonal_m_;
}

/// Half the distance to the next face, at most the reach.
double Surface::clearance_m(const Vec3& p_O, const Vec3& direction) const {
  std::vector<geometry::RayHit> hits;
  const double start_m = kStartShare * diagonal_m_;
  skin_.cast(p_O + start_m * direction, direction, hits);
  return hits.empty() ? reach_m() : std::min(reach_m(), 0.5 * (start_m + hits.front().t));
}

std::optional<SurfaceError> Surface::error_at(const Vec3& p_O, std::uint32_t triangle) const {
  if (!exposed_[triangle]) return std::nullopt;
  const Vec3 n = geometry::area_normal(mesh_, triangle).normalized();
  if (!solid_.is_exposed(mesh_of_triangle_[triangle], p_O, n)) return std::nullopt;
  // If the surface itself is already felt, search outwards for the place where the feeling ends; else inwards for its
  // start.
  const bool met_before = probe_.at(p_O - kStartShare * diagonal_m_ * n).hit;
  const Vec3 direction = met_before ? n : Vec3(-n);
  const double reach = clearance_m(p_O, direction);
  double near = 0;
  double far = 0;
  bool turned = false;
  for (int i = 1; i <= kSteps && !turned; ++i) {
    near = far;
    far = reach * i * i / (kSteps * kSteps);  // finer steps near 0, as most errors are small
    turned = probe_.at(p_O + far * direction).hit != met_before;
  }
  // Near a corner the search may run along a neighbouring face, so the distance from the whole surface counts.
  const auto from_surface = [&](double t) { return skin_.closest(p_O + t * direction, 2 * reach_m()).distance_m; };
  if (!turned) return SurfaceError{met_before, from_surface(reach)};
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (near + far);
    (probe_.at(p_O + middle * direction).hit == met_before ? near : far) = middle;
  }
  return SurfaceError{true, from_surface(0.5 * (near + far))};
}

}  // namespace mechane::fit
