// Meshes that are open or overlap, through the product's builder and its contact query, against solid angles and distances by brute force.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "client-sdk/fit/probe.hpp"
#include "server/base/parallel.hpp"
#include "server/base/random.hpp"
#include "server/collision_build/object_builder.hpp"
#include "server/geometry/area_normal.hpp"
#include "server/geometry/mesh_check.hpp"
#include "server/geometry/surface_samples.hpp"
#include "tests/benchmark/bench_stats.hpp"
#include "tests/benchmark/collision/models.hpp"
#include "tests/benchmark/collision/scene.hpp"
#include "tests/support/open_meshes.hpp"

namespace mechane::benchmark {
namespace {

constexpr double kBeyond = 0.002;  // of the diagonal: what is this deep must be felt, what is this far outside must not
constexpr double kClear = 0.6;     // a winding number above this is inside, for the depth
constexpr double kDoubt = 0.1;     // from 0 and 1: winding numbers between are not judged
constexpr double kBefore = 1e-6;   // of the diagonal: where a side of the surface is asked
constexpr double kWithin = 0.98;   // of a distance: within this nothing of the surface may lie
constexpr double kHeld_m = 0.2;    // the diagonal of each thing
constexpr double kEnclosing = 0.6;  // a winding number that a sheet does not reach

struct Case {
  std::string name;
  geometry::Mesh given;
  geometry::Mesh truth;  // what was given before it was damaged
};

Vec3 nearest_on(const Vec3& from, const Vec3& to, const Vec3& p) {
  const Vec3 way = to - from;
  return from + std::clamp(way.dot(p - from) / std::max(way.squaredNorm(), 1e-30), 0.0, 1.0) * way;
}

/// The nearest place of the mesh, whichever side of it is asked; every triangle is looked at.
geometry::SurfacePoint nearest_of(const geometry::Mesh& mesh, const Vec3& p) {
  geometry::SurfacePoint best;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const Vec3 a = mesh.vertices[t[0]];
    const Vec3 ab = mesh.vertices[t[1]] - a;
    const Vec3 ac = mesh.vertices[t[2]] - a;
    const Vec3 n = ab.cross(ac);
    const double area = n.squaredNorm();
    const auto offer = [&](const Vec3& q) {
      const double d = (q - p).norm();
      if (d < best.distance_m) best = {q, d, i};
    };
    if (area > 0) {
      const Vec3 foot = p - n.dot(p - a) / area * n - a;
      const double v = foot.cross(ac).dot(n) / area;
      const double w = ab.cross(foot).dot(n) / area;
      if (v >= 0 && w >= 0 && v + w <= 1) offer(a + foot);
    }
    for (std::size_t k = 0; k < 3; ++k)
      offer(nearest_on(mesh.vertices[t[k]], mesh.vertices[t[(k + 1) % 3]], p));
  }
  return best;
}

/// What is inside, and how deep, by brute force.
class Truth {
 public:
  Truth(const geometry::Mesh& mesh, double sheet_m) : mesh_(mesh), diagonal_m_(mesh.bounds().diagonal().norm()) {
    Random random(1);
    const Eigen::AlignedBox3d box = mesh.bounds();
    bool encloses = false;
    for (int i = 0; i < 200 && !encloses; ++i) {
      const Vec3 share(random.unit(), random.unit(), random.unit());
      encloses = test::exact_winding(mesh, box.min() + share.cwiseProduct(box.sizes())) > kEnclosing;
    }
    if (!encloses) sheet_m_ = sheet_m;
    for (const auto& [a, b] : geometry::rims(mesh))
      rims_.push_back({mesh.vertices[a], mesh.vertices[b]});
  }

  [[nodiscard]] bool is_sheet() const { return sheet_m_ > 0; }

  /// None where there is doubt.
  [[nodiscard]] std::optional<bool> is_inside(const Vec3& p) const {
    if (is_sheet()) {
      const double distance_m = nearest_of(mesh_, p).distance_m;
      // A sheet ends at its rim; how round, is not judged.
      if (distance_to_rim_m(p) <= (1 + 1e-9) * distance_m) return std::nullopt;
      return distance_m < 0.5 * sheet_m_;
    }
    const double winding = test::exact_winding(mesh_, p);
    if (winding > kDoubt && winding < 1 - kDoubt) return std::nullopt;
    return winding > 0.5;
  }

  /// Whether everything within `r_m` of p is inside, as p is, or outside.
  [[nodiscard]] bool is_beyond(const Vec3& p, bool inside, double r_m) const {
    // At its rim a sheet has a wall, too.
    if (is_sheet())
      return std::abs(0.5 * sheet_m_ - nearest_of(mesh_, p).distance_m) > r_m && distance_to_rim_m(p) > r_m;
    for (int i = 0; i < 27; ++i) {
      const Vec3 way(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (i != 13 && (test::exact_winding(mesh_, p + r_m * way.normalized()) > 0.5) != inside) return false;
    }
    return true;
  }

  /// None outside, where the nearest triangle is an inner wall, or where a membrane is nearer.
  [[nodiscard]] std::optional<double> depth_m(const Vec3& p, double at_most_m) const {
    const geometry::SurfacePoint nearest = nearest_of(mesh_, p);
    if (is_sheet()) {
      const double depth_m = 0.5 * sheet_m_ - nearest.distance_m;
      const bool at_rim = distance_to_rim_m(p) <= 0.5 * sheet_m_;  // there the wall at the rim is nearer
      return depth_m > 0 && !at_rim ? std::optional(depth_m) : std::nullopt;
    }
    if (nearest.distance_m > at_most_m || test::exact_winding(mesh_, p) < kClear) return std::nullopt;
    const Vec3 out = kBefore * diagonal_m_ * geometry::area_normal(mesh_, nearest.triangle).normalized();
    const bool outer =
        test::exact_winding(mesh_, nearest.p + out) < 0.5 && test::exact_winding(mesh_, nearest.p - out) > 0.5;
    if (!outer || !is_beyond(p, true, kWithin * nearest.distance_m)) return std::nullopt;
    return nearest.distance_m;
  }

 private:
  [[nodiscard]] double distance_to_rim_m(const Vec3& p) const {
    double least_m = std::numeric_limits<double>::infinity();
    for (const auto& [from, to] : rims_)
      least_m = std::min(least_m, (nearest_on(from, to, p) - p).norm());
    return least_m;
  }

  const geometry::Mesh& mesh_;
  std::vector<std::pair<Vec3, Vec3>> rims_;
  double diagonal_m_;
  double sheet_m_ = 0;  // above 0: it encloses nothing
};

/// Half near the surface, on both sides, half anywhere about it.
std::vector<Vec3> points_about(const geometry::Mesh& mesh, double near_m, std::size_t count, std::uint64_t seed) {
  std::vector<Vec3> points;
  Random random(seed);
  for (const geometry::SurfaceSample& sample : geometry::sample_by_area(mesh, count / 2, seed)) {
    const Vec3 n = geometry::area_normal(mesh, sample.triangle).normalized();
    points.push_back(sample.p + near_m * (2 * random.unit() - 1) * n);
  }
  const Eigen::AlignedBox3d box = mesh.bounds();
  while (points.size() < count) {
    const Vec3 share(random.unit(), random.unit(), random.unit());
    points.push_back(box.min() - Vec3::Constant(near_m) + share.cwiseProduct(box.sizes() + Vec3::Constant(2 * near_m)));
  }
  return points;
}

struct Verdict {
  bool judged = false;
  bool inside = false;
  bool missed = false;
  bool made_up = false;
  std::optional<double> error_m;
};

Verdict judge(const Truth& truth, const fit::Probe& probe, const Vec3& p, double beyond_m, double probe_depth_m) {
  const fit::Felt felt = probe.at(p);
  Verdict verdict;
  if (felt.hit) {
    if (const auto depth_m = truth.depth_m(p, probe_depth_m)) verdict.error_m = std::abs(felt.depth_m - *depth_m);
  }
  const std::optional<bool> inside = truth.is_inside(p);
  if (!inside) return verdict;
  verdict.judged = true;
  verdict.inside = *inside;
  const bool wrong = *inside != felt.hit && truth.is_beyond(p, *inside, beyond_m);
  verdict.made_up = wrong && felt.hit;
  verdict.missed = wrong && !felt.hit;
  return verdict;
}

/// The worst of all cases.
struct Worst {
  double missed_pct = 0, false_pct = 0, p99_pct = 0;
};

bool measure(const Case& one, std::size_t points, std::uint64_t seed, Report& report, Worst& worst) {
  std::cerr << "bench_open: " << one.name << "\n";
  const collision_build::BuildConfig config;
  collision_build::BuildReport built;
  const std::vector<geometry::NamedMesh> parts = {{one.name, one.given}};
  const auto object = collision_build::build_object(parts, config, &built);
  if (!object) {
    std::cerr << "bench_open: " << one.name << ": " << object.error().to_string() << "\n";
    return false;
  }
  const double diagonal_m = one.truth.bounds().diagonal().norm();
  const Truth truth(one.truth, config.solid.thickness_m);
  const fit::Probe probe(*object);
  const std::vector<Vec3> asked = points_about(one.truth, config.probe_depth_m, points, seed);
  std::vector<Verdict> verdicts(asked.size());
  for_each_index(asked.size(), [&](std::size_t i) {
    verdicts[i] = judge(truth, probe, asked[i], kBeyond * diagonal_m, config.probe_depth_m);
  });
  double judged = 0, inside = 0, missed = 0, made_up = 0;
  std::vector<double> errors_pct;
  for (const Verdict& verdict : verdicts) {
    judged += verdict.judged ? 1 : 0;
    inside += verdict.inside ? 1 : 0;
    missed += verdict.missed ? 1 : 0;
    made_up += verdict.made_up ? 1 : 0;
    if (verdict.error_m) errors_pct.push_back(100 * *verdict.error_m / diagonal_m);
  }
  std::sort(errors_pct.begin(), errors_pct.end());
  const double p99_pct = errors_pct.empty() ? 0 : errors_pct[errors_pct.size() * 99 / 100];
  const std::string place = "open." + one.name + ".";
  report.metric(place + "triangles", static_cast<double>(one.given.triangles.size()));
  report.metric(place + "sheet", truth.is_sheet() ? 1 : 0);
  report.metric(place + "build_s", built.seconds);
  report.metric(place + "parts", static_cast<double>(built.parts.size()));
  report.metric(place + "bytes", static_cast<double>(built.bytes));
  report.metric(place + "judged", judged);
  report.metric(place + "inside", inside);
  report.metric(place + "measured", static_cast<double>(errors_pct.size()));
  report.metric(place + "missed_pct", 100 * missed / std::max(inside, 1.0));
  report.metric(place + "false_pct", 100 * made_up / std::max(judged - inside, 1.0));
  report.metric(place + "depth_error_pct.p99", p99_pct);
  worst.missed_pct = std::max(worst.missed_pct, 100 * missed / std::max(inside, 1.0));
  worst.false_pct = std::max(worst.false_pct, 100 * made_up / std::max(judged - inside, 1.0));
  worst.p99_pct = std::max(worst.p99_pct, p99_pct);
  return true;
}

geometry::Mesh held(geometry::Mesh mesh) {
  const double scale = kHeld_m / mesh.bounds().diagonal().norm();
  for (Vec3& v : mesh.vertices)
    v *= scale;
  return mesh;
}

std::vector<Case> generated(std::uint64_t seed) {
  const geometry::Mesh holes = held(test::ball_with_holes(1, 6, 0.3, seed));
  geometry::Mesh boxes = test::box({1, 0.6, 0.4});
  boxes.append(test::box({0.5, 0.5, 0.7}, {0.6, 0.23, 0.31}));
  boxes = held(std::move(boxes));
  const geometry::Mesh bowl = held(test::bowl(1));
  const geometry::Mesh scan = held(test::with_gaps(test::with_noise(test::bumpy_ball(), 5e-4, seed), 0.02, seed));
  return {{"holes", holes, holes},
          {"boxes", boxes, boxes},
          {"bowl", bowl, bowl},
          {"scan", test::with_turned(scan, 0.05, seed), scan}};
}

int main_of(const std::vector<std::filesystem::path>& files, std::size_t points, std::uint64_t seed) {
  std::vector<Case> cases = generated(seed);
  for (const std::filesystem::path& file : files) {
    auto found = load_models(file);
    if (!found) {
      std::cerr << "bench_open: " << found.error().to_string() << "\n";
      return 2;
    }
    for (const SceneObject& object : *found)
      cases.push_back({object.name, object.mesh_O, object.mesh_O});
  }
  Report report;
  Worst worst;
  for (const Case& one : cases) {
    if (!measure(one, points, seed, report, worst)) return 2;
  }
  report.metric("open.missed_pct", worst.missed_pct);
  report.metric("open.false_pct", worst.false_pct);
  report.metric("open.depth_error_pct.p99", worst.p99_pct);
  std::cout << report.text() << "\n";
  return 0;
}

}  // namespace
}  // namespace mechane::benchmark

int main(int argc, char** argv) {
  std::vector<std::filesystem::path> files;
  std::size_t points = 16'000;  // a tenth of a per cent of the few inside a sheet is then one of them
  std::uint64_t seed = 1;
  CLI::App app{"Meshes that are open or overlap: what is felt of them, against brute force"};
  app.add_option("files", files, ".glb, .gltf, .obj, .stl or .ply, scaled to 20 cm, beside the generated meshes")
      ->check(CLI::ExistingFile);
  app.add_option("--points", points, "that are asked of each mesh")->check(CLI::Range(10, 10'000'000));
  app.add_option("--seed", seed, "other seeds make other holes, and ask at other points");
  CLI11_PARSE(app, argc, argv);
  return mechane::benchmark::main_of(files, points, seed);
}
