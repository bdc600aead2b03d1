#include "server/collision/object_builder.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

#include "server/base/parallel.hpp"
#include "server/collision/part_map.hpp"
#include "server/collision/samples.hpp"
#include "server/collision/solid.hpp"
#include "server/geometry/mesh_check.hpp"
#include "server/geometry/random.hpp"
#include "server/geometry/surface_samples.hpp"

namespace mechane::collision {
namespace {

constexpr double kWeld = 1e-6;             // of the part's diagonal
constexpr std::size_t kErrorProbes = 400;  // per part
constexpr double kProbeDepth_m = 0.004;    // a finger that presses hard sinks in this far

std::string where_of(const geometry::NamedMesh& part) {
  return "part '" + part.name + "'";
}

Expected<void> check_config(const BuildConfig& config) {
  const char* where = "build settings";
  if (config.map_resolution != 16 && config.map_resolution != 32 && config.map_resolution != 64) {
    return fail("map_resolution is " + std::to_string(config.map_resolution), where, "use 16, 32 or 64");
  }
  if (!(config.sample_spacing_m >= 1e-4 && config.sample_spacing_m <= 1)) {
    return fail("sample_spacing_m is outside 0.0001 to 1 m", where, "use 0.005 for things that a hand touches");
  }
  if (config.max_samples_per_part < kClusterSize || config.max_samples_per_part > 1'000'000) {
    return fail("max_samples_per_part is outside 16 to 1000000", where, "use 4096");
  }
  if (!(config.seam_gap_m >= 0 && config.seam_gap_m <= 0.1)) {
    return fail("seam_gap_m is outside 0 to 0.1 m", where, "use 0.001");
  }
  return {};
}

Expected<std::vector<geometry::Mesh>> weld_parts(std::span<const geometry::NamedMesh> parts) {
  if (parts.empty()) return fail("there are no parts", "object", "name at least one mesh as a part");
  if (parts.size() > kMaxParts) {
    return fail(std::to_string(parts.size()) + " parts, more than " + std::to_string(kMaxParts), "object",
                "use fewer, larger parts");
  }
  std::vector<geometry::Mesh> welded;
  for (const geometry::NamedMesh& part : parts) {
    if (auto ok = geometry::check_mesh(part.mesh, where_of(part)); !ok) return tl::unexpected(ok.error());
    welded.push_back(geometry::weld(part.mesh, kWeld * part.mesh.bounds().diagonal().norm()));
    if (welded.back().triangles.empty()) {
      return fail("all triangles are without area", where_of(part), "export the model with its faces");
    }
  }
  return welded;
}

Expected<Part> make_part(const geometry::NamedMesh& source, const geometry::Mesh& mesh, std::size_t index,
                         const Solid& solid, const BuildConfig& config, PartReport& report) {
  geometry::FitConfig fit_config;
  fit_config.seed = config.seed;
  const auto fit = geometry::fit_superquadric(mesh, fit_config);
  if (!fit) return fail(fit.error().what, where_of(source), fit.error().remedy);
  Part part;
  part.name = source.name;
  part.X_OQ = fit->X_OQ;
  part.superquadric = fit->shape;
  part.map = cast_map(solid, index, mesh, fit->shape, fit->X_OQ, config.map_resolution, config.seed);
  part.bound_O = bounding_sphere(mesh.vertices);
  report.name = source.name;
  report.fit = fit->report;
  report.closed = solid.is_closed(index);
  return part;
}

/// Samples of the part's surface where it borders on air, at the wanted spacing or, above the cap, at a wider one.
std::vector<Vec3> exposed_samples(const geometry::Mesh& mesh, std::size_t index, const Solid& solid,
                                  const BuildConfig& config, PartReport& report) {
  const auto exposed = [&](const geometry::SurfaceSample& sample) {
    return solid.is_exposed(index, sample.p, solid.part(index).triangle_normal(sample.triangle));
  };
  // A rough count first, so that a huge part is not sampled finely for nothing.
  const double cells = geometry::surface_area_m2(mesh) / static_cast<double>(2 * config.max_samples_per_part);
  double spacing = std::max(config.sample_spacing_m, std::sqrt(cells));
  std::vector<geometry::SurfaceSample> samples;
  for (int round = 0; round < 8; ++round) {
    samples = geometry::sample_by_spacing(mesh, spacing, config.seed, exposed);
    if (samples.size() <= config.max_samples_per_part) break;
    const double excess = static_cast<double>(samples.size()) / static_cast<double>(config.max_samples_per_part);
    spacing *= 1.05 * std::sqrt(excess);
  }
  if (samples.size() > config.max_samples_per_part) samples.resize(config.max_samples_per_part);
  std::vector<Vec3> points;
  points.reserve(samples.size());
  for (const auto& sample : samples)
    points.push_back(sample.p);
  report.samples = points.size();
  report.spacing_m = spacing;
  return points;
}

/// Triangles of all parts that border on air somewhere: the solid's true surface, for the exact distance.
geometry::Mesh air_side(std::span<const geometry::Mesh> parts, const Solid& solid) {
  geometry::Mesh skin;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto base = static_cast<std::uint32_t>(skin.vertices.size());
    skin.vertices.insert(skin.vertices.end(), parts[i].vertices.begin(), parts[i].vertices.end());
    for (std::uint32_t t = 0; t < parts[i].triangles.size(); ++t) {
      const auto& v = parts[i].triangles[t];
      const Vec3 n = solid.part(i).triangle_normal(t);
      const Vec3 middle = (parts[i].vertices[v[0]] + parts[i].vertices[v[1]] + parts[i].vertices[v[2]]) / 3;
      bool exposed = solid.is_exposed(i, middle, n);
      for (int k = 0; k < 3 && !exposed; ++k) {
        exposed = solid.is_exposed(i, 0.2 * middle + 0.8 * parts[i].vertices[v[k]], n);
      }
      if (exposed) skin.triangles.push_back({v[0] + base, v[1] + base, v[2] + base});
    }
  }
  return skin;
}

/// What find_contacts would say of a point: the hit in which it lies most centrally.
MapHit ask(const Object& object, const Vec3& p_O) {
  MapHit best;
  for (const Part& part : object.parts) {
    if ((p_O - part.bound_O.center).norm() > part.bound_O.radius) continue;
    const MapHit hit = part.map.evaluate((part.X_OQ.inverse() * p_O).cast<float>());
    if (hit.hit && (!best.hit || hit.m < best.m)) best = hit;
  }
  return best;
}

/// Points up to kProbeDepth_m under the part's surface; a missed one counts with its whole depth.
void measure_depth_error(const Object& object, std::size_t index, const geometry::Mesh& mesh, const Solid& solid,
                         const geometry::MeshQuery& skin, std::uint64_t seed, PartReport& report) {
  geometry::Random random(seed);
  std::vector<double> errors;
  for (const auto& sample : geometry::sample_by_area(mesh, kErrorProbes, seed + 2)) {
    const Vec3 n = solid.part(index).triangle_normal(sample.triangle);
    const Vec3 p = sample.p - random.unit() * kProbeDepth_m * n;
    if (!solid.is_exposed(index, sample.p, n) || !solid.contains(p)) continue;
    const MapHit hit = ask(object, p);
    const double depth_m = hit.hit ? static_cast<double>(hit.depth_m) : 0.0;
    errors.push_back(std::abs(depth_m - skin.closest(p).distance_m));
  }
  if (errors.empty()) return;
  std::sort(errors.begin(), errors.end());
  report.depth_error_p50_m = errors[errors.size() / 2];
  report.depth_error_p99_m = errors[errors.size() * 99 / 100];
}

}  // namespace

Expected<Object> build_object(std::span<const geometry::NamedMesh> parts, const BuildConfig& config,
                              BuildReport* report, const PartDone& on_part) {
  const auto start = std::chrono::steady_clock::now();
  if (auto ok = check_config(config); !ok) return tl::unexpected(ok.error());
  const auto welded = weld_parts(parts);
  if (!welded) return tl::unexpected(welded.error());
  const Solid solid(*welded, config.seam_gap_m);

  BuildReport built;
  built.parts.resize(parts.size());
  std::vector<Expected<Part>> made(parts.size());
  std::vector<std::vector<Vec3>> samples(parts.size());
  std::atomic<std::size_t> done{0};
  for_each_index(parts.size(), [&](std::size_t i) {
    made[i] = make_part(parts[i], (*welded)[i], i, solid, config, built.parts[i]);
    if (made[i]) samples[i] = exposed_samples((*welded)[i], i, solid, config, built.parts[i]);
    if (on_part) on_part(++done);
  });
  Object object;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!made[i]) return tl::unexpected(made[i].error());
    object.parts.push_back(std::move(*made[i]));
    append_samples(object, static_cast<std::uint16_t>(i), std::move(samples[i]));
  }
  close_clusters(object);

  if (report != nullptr) {
    const geometry::MeshQuery skin(air_side(*welded, solid));
    for_each_index(parts.size(), [&](std::size_t i) {
      measure_depth_error(object, i, (*welded)[i], solid, skin, config.seed, built.parts[i]);
    });
    built.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    *report = std::move(built);
  }
  return object;
}

}  // namespace mechane::collision
