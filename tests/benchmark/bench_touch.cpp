// How smooth a facetted surface feels (the paper's Figure 16), and what the force of a grasping hand costs.
#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "server/content/imported_scene.hpp"
#include "server/content/mesh_import.hpp"
#include "server/geometry/area_normal.hpp"
#include "server/geometry/mesh_query.hpp"
#include "tests/benchmark/bench_stats.hpp"
#include "tests/support/floor_server.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/source_folder.hpp"
#include "tests/support/touch.hpp"

namespace mechane::benchmark {
namespace {

using test::FloorServer;

constexpr double kStep_m = 1e-4;
constexpr double kDepth_m = 1e-3;
constexpr double kTip_m = 0.008;

/// An icosahedron whose triangles are halved twice: 320 facets, their corners on the sphere.
geometry::Mesh facetted_sphere(double radius_m) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  geometry::Mesh mesh;
  for (const Vec3& corner :
       {Vec3(-1, g, 0), Vec3(1, g, 0), Vec3(-1, -g, 0), Vec3(1, -g, 0), Vec3(0, -1, g), Vec3(0, 1, g), Vec3(0, -1, -g),
        Vec3(0, 1, -g), Vec3(g, 0, -1), Vec3(g, 0, 1), Vec3(-g, 0, -1), Vec3(-g, 0, 1)})
    mesh.vertices.push_back(radius_m * corner.normalized());
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int halved = 0; halved < 2; ++halved) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices.size()));
      if (fresh) mesh.vertices.push_back(radius_m * (mesh.vertices[a] + mesh.vertices[b]).normalized());
      return at->second;
    };
    for (const auto& [a, b, c] : std::exchange(mesh.triangles, {})) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const auto& smaller :
           {std::array{a, ab, ca}, std::array{b, bc, ab}, std::array{c, ca, bc}, std::array{ab, bc, ca}})
        mesh.triangles.push_back(smaller);
    }
  }
  return mesh;
}

/// A mesh's own normals where a point is nearest to it: its facets', or between its corners' (Morgenbesser and Srinivasan 1996).
class MeshNormals {
 public:
  explicit MeshNormals(const geometry::Mesh& mesh)
      : mesh_(mesh), query_(mesh), corners_(mesh.vertices.size(), Vec3::Zero()) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const std::uint32_t corner : mesh.triangles[t])
        corners_[corner] += geometry::area_normal(mesh, t);
    }
    for (Vec3& normal : corners_)
      normal.normalize();
  }
  [[nodiscard]] Vec3 facet(const Vec3& p) const { return query_.triangle_normal(query_.closest(p).triangle); }
  [[nodiscard]] Vec3 shaded(const Vec3& p) const {
    const geometry::SurfacePoint near = query_.closest(p);
    const auto& [a, b, c] = mesh_.triangles[near.triangle];
    const Vec3& p_a = mesh_.vertices[a];
    const Vec3& p_b = mesh_.vertices[b];
    const Vec3& p_c = mesh_.vertices[c];
    const Vec3 whole = geometry::area_normal(mesh_, near.triangle);
    const double share_a = (p_b - near.p).cross(p_c - near.p).dot(whole) / whole.squaredNorm();
    const double share_b = (p_c - near.p).cross(p_a - near.p).dot(whole) / whole.squaredNorm();
    return (share_a * corners_[a] + share_b * corners_[b] + (1 - share_a - share_b) * corners_[c]).normalized();
  }

 private:
  const geometry::Mesh& mesh_;
  geometry::MeshQuery query_;
  std::vector<Vec3> corners_;
};

/// Once round a sphere in steps of 0.1 mm: the largest change of direction from one step to the next, and how far the direction is from
/// the sphere's own.
struct Felt {
  double jump_deg = 0, deviation_deg = 0;
};

Felt go_round(double radius_m, const std::function<Vec3(const Vec3& way_out)>& normal) {
  const Vec3 u = Vec3(0.3, 0.8, 0.5).normalized();
  const Vec3 v = u.cross(Vec3(0.2, -0.1, 0.9)).normalized();
  const int steps = static_cast<int>(2 * kPi * radius_m / kStep_m);
  Felt felt;
  Vec3 before = normal(u);
  for (int i = 1; i <= steps; ++i) {
    const double angle = i * kStep_m / radius_m;
    const Vec3 way_out = std::cos(angle) * u + std::sin(angle) * v;
    const Vec3 now = normal(way_out);
    felt.jump_deg = std::max(felt.jump_deg, test::degrees_between(before, now));
    felt.deviation_deg += test::degrees_between(way_out, now) / steps;
    before = now;
  }
  return felt;
}

Vec3 felt_by_tip(FloorServer& server, double radius_m, const Vec3& way_out) {
  hand::HandSample sample;
  sample.X_WH.p = (radius_m + kTip_m - kDepth_m) * way_out;
  const hand::HapticOutput& output = server.answer(sample);
  if (output.contact_count == 0) throw std::runtime_error("a tip that is in the sphere touches nothing");
  return output.contacts[0].n_W;
}

void measure_smoothness(Report& report, const std::string& name, const geometry::Mesh& mesh, double radius_m) {
  const MeshNormals normals(mesh);
  const auto object = test::built(mesh);
  haptics::ForceConfig of_contacts;
  of_contacts.normals = haptics::NormalKind::of_contacts;
  FloorServer as_found(object, of_contacts);
  FloorServer smooth(object, {});
  const std::array<std::pair<const char*, Felt>, 4> felt{
      {{"mesh", go_round(radius_m, [&](const Vec3& out) { return normals.facet((radius_m - kDepth_m) * out); })},
       {"shading", go_round(radius_m, [&](const Vec3& out) { return normals.shaded((radius_m - kDepth_m) * out); })},
       {"contacts", go_round(radius_m, [&](const Vec3& out) { return felt_by_tip(as_found, radius_m, out); })},
       {"smooth", go_round(radius_m, [&](const Vec3& out) { return felt_by_tip(smooth, radius_m, out); })}}};
  for (const auto& [kind, one] : felt) {
    report.metric(name + "." + kind + ".jump_deg.max", one.jump_deg);
    report.metric(name + "." + kind + ".deviation_deg.mean", one.deviation_deg);
  }
  report.metric(name + ".jump_ratio", felt[3].second.jump_deg / felt[0].second.jump_deg);
  report.metric(name + ".deviation_ratio", felt[3].second.deviation_deg / felt[1].second.deviation_deg);
}

/// The ball of the shipped aeolipile: its corners lie on a sphere of 80 mm.
geometry::Mesh shipped_ball() {
  const auto scene = content::import_mesh(test::source_folder() / "scenarios/models/aiolos-sphere.glb");
  if (!scene) throw std::runtime_error(scene.error().to_string());
  const auto parts = content::collision_parts(*scene, "part_ball");
  if (!parts) throw std::runtime_error(parts.error().to_string());
  return parts->front().mesh;
}

/// A whole hand closed around a bar of 36 mm, which moves a little from tick to tick: from its pose to its force, and the force alone.
void measure_grasp(Report& report) {
  constexpr int kTicks = 20'000;
  SystemClock clock;
  FloorServer server(test::built(test::cylinder(0.018, 0.08, 32)), {});
  hand::HandSample sample;
  sample.kind = hand::HandKind::glove;
  sample.joints.fill(0);
  for (std::size_t f = 0; f < hand::kFingers; ++f)
    test::close_finger(sample, f, 1);
  Samples all(kTicks), force(kTicks);
  std::size_t touching = 0;
  for (int i = 0; i < kTicks; ++i) {
    const double angle = 2 * kPi * i / 1000;
    sample.X_WH.p = Vec3(-0.1, 0.036, 0) + 5e-4 * Vec3(std::cos(angle), std::sin(angle), std::sin(2 * angle));
    const Duration begin = clock.thread_cpu_time();
    server.find_contacts(sample);
    const Duration found = clock.thread_cpu_time();
    server.render();
    const Duration end = clock.thread_cpu_time();
    all.add(end - begin);
    force.add(end - found);
    touching = std::max<std::size_t>(touching, server.segments_that_touch());
  }
  report.note(fmt::format("the grasp: up to {} of 16 segments touch the bar", touching));
  report.distribution("touch_us.grasp", all);
  report.distribution("force_us.grasp", force);
}

}  // namespace
}  // namespace mechane::benchmark

int main() {
  using namespace mechane;
  benchmark::Report report;
  try {
    benchmark::measure_smoothness(report, "fig16", benchmark::facetted_sphere(0.05), 0.05);
    benchmark::measure_smoothness(report, "fig16.shipped", benchmark::shipped_ball(), 0.08);
    benchmark::measure_grasp(report);
  } catch (const std::exception& error) {
    std::cerr << "bench_touch: " << error.what() << "\n";
    return 1;
  }
  std::cout << report.text() << "\n";
  return 0;
}
