#include "server/collision/object_builder.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

#include "server/base/parallel.hpp"
#include "server/collision/cast_map.hpp"
#include "server/collision/choose_map.hpp"
#include "server/collision/part_source.hpp"
#include "server/collision/samples.hpp"
#include "server/collision/solid.hpp"
#include "server/geometry/mesh_check.hpp"
#include "server/geometry/mesh_orient.hpp"

namespace mechane::collision {
namespace {

constexpr double kWeld = 1e-6;               // of the part's diagonal
constexpr std::size_t kProbesPerPart = 600;  // for the choice of its map
constexpr std::size_t kReportProbes = 400;   // per part, for the object's error
constexpr int kRefinements = 1;              // rounds
constexpr double kFaultShare = 0.01;         // of a part's probes: the budget is one of a 99th percentile
constexpr std::size_t kGraveFault = 1000;    // a miss is one too many

std::string where_of(const std::string& part) {
  return "part '" + part + "'";
}

Expected<void> check_budget(const BuildConfig& config) {
  const char* where = "build settings";
  if (!(config.max_error_share > 0 && config.max_error_share <= 0.1) || !(config.max_error_m > 0)) {
    return fail("the error budget is outside 0 to 0.1 of the diagonal, or not over 0 m", where,
                "use max_error_share 0.003 and max_error_m 0.001");
  }
  if (!(config.miss_share > 0 && config.miss_share <= 0.1)) {
    return fail("miss_share is outside 0 to 0.1 of the diagonal", where, "use 0.002");
  }
  if (!(config.probe_depth_m >= 1e-5 && config.probe_depth_m <= 10)) {
    return fail("probe_depth_m is outside 0.00001 to 10 m", where, "use 0.004, which is how far a finger sinks in");
  }
  if (!config.radial_maps && !config.bricks) {
    return fail("neither radial maps nor bricks are allowed", where, "allow one of them");
  }
  return {};
}

Expected<void> check_config(const BuildConfig& config) {
  const char* where = "build settings";
  const auto& known = RadialMap::kResolutions;
  if (config.map_resolution != 0 && std::find(known.begin(), known.end(), config.map_resolution) == known.end()) {
    return fail("map_resolution is " + std::to_string(config.map_resolution), where,
                "use 8, 12, 16, 24, 32, 48 or 64, or 0 for the smallest that is exact enough");
  }
  if (!(config.sample_spacing_m >= 1e-4 && config.sample_spacing_m <= 1)) {
    return fail("sample_spacing_m is outside 0.0001 to 1 m", where, "use 0.005 for things that a hand touches");
  }
  if (config.max_samples_per_part < kLanes || config.max_samples_per_part > 1'000'000) {
    return fail("max_samples_per_part is outside 16 to 1000000", where, "use 4096");
  }
  if (!(config.seam_gap_m >= 0 && config.seam_gap_m <= 0.1)) {
    return fail("seam_gap_m is outside 0 to 0.1 m", where, "use 0.001");
  }
  return check_budget(config);
}

Expected<void> check_count(std::size_t parts) {
  if (parts == 0) return fail("there are no parts", "object", "name at least one mesh as a part");
  if (parts > kMaxParts) {
    return fail(std::to_string(parts) + " parts, more than " + std::to_string(kMaxParts), "object",
                "use fewer, larger parts");
  }
  return {};
}

Expected<std::vector<geometry::Mesh>> weld_nodes(std::span<const geometry::NamedMesh> nodes) {
  if (auto ok = check_count(nodes.size()); !ok) return tl::unexpected(ok.error());
  std::vector<geometry::Mesh> welded;
  for (const geometry::NamedMesh& node : nodes) {
    if (auto ok = geometry::check_mesh(node.mesh, where_of(node.name)); !ok) return tl::unexpected(ok.error());
    welded.push_back(geometry::weld(node.mesh, kWeld * node.mesh.bounds().diagonal().norm()));
    if (welded.back().triangles.empty()) {
      return fail("all triangles are without area", where_of(node.name), "export the model with its faces");
    }
    static_cast<void>(geometry::turn_outwards(welded.back()));
  }
  return welded;
}

double diagonal_of(std::span<const geometry::Mesh> meshes) {
  Eigen::AlignedBox3d box;
  for (const geometry::Mesh& mesh : meshes)
    box.extend(mesh.bounds());
  return box.diagonal().norm();
}

ErrorBudget budget_of(const BuildConfig& config, double diagonal_m) {
  return {std::min(config.max_error_share * diagonal_m, config.max_error_m), config.miss_share * diagonal_m,
          config.probe_depth_m};
}

/// Everything that the parts are made from; immutable while they are.
struct Ground {
  std::span<const geometry::Mesh> nodes;
  const Solid& solid;
  const geometry::MeshQuery& skin;
  const BuildConfig& config;
  ErrorBudget budget;
};

bool wants_pieces(const BuildConfig& config, std::size_t nodes) {
  return config.parts == Parts::decomposed || (config.parts == Parts::automatic && nodes == 1);
}

/// The parts to be, in the order of the nodes.
Expected<std::vector<PartSource>> find_sources(std::span<const geometry::NamedMesh> nodes, const Ground& ground) {
  std::vector<geometry::Decomposition> cuts(nodes.size());
  if (wants_pieces(ground.config, nodes.size())) {
    geometry::DecomposeConfig config;
    config.max_concavity = ground.config.max_concavity;
    config.max_parts = ground.config.max_pieces;
    config.grid_cells = ground.config.grid_cells;
    config.seed = ground.config.seed;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!ground.solid.is_closed(i)) continue;  // no inside, no pieces
      auto cut = geometry::decompose(ground.nodes[i], config);
      if (!cut) return fail(cut.error().what, where_of(nodes[i].name), cut.error().remedy);
      cuts[i] = std::move(*cut);
    }
  }
  std::vector<std::vector<PartSource>> found(nodes.size());
  for_each_index(nodes.size(), [&](std::size_t i) {
    found[i] = sources_of_node(nodes[i].name, ground.nodes[i], i, cuts[i], ground.solid, ground.config);
  });
  std::vector<PartSource> sources;
  for (auto& some : found)
    std::move(some.begin(), some.end(), std::back_inserter(sources));
  if (auto ok = check_count(sources.size()); !ok) return tl::unexpected(ok.error());
  return sources;
}

Expected<geometry::FitResult> fit_source(const PartSource& source, const Ground& ground) {
  geometry::FitConfig config;
  config.seed = ground.config.seed;
  auto fit = source.is_whole_node() ? geometry::fit_superquadric(ground.nodes[source.node], config)
                                    : geometry::fit_superquadric(source.bound_points_O, config);
  if (!fit) return fail(fit.error().what, where_of(source.name), fit.error().remedy);
  return fit;
}

/// A part, and what a finer map of it would be made from.
struct Made {
  Part part;
  MapFrame frame;
  std::vector<Probe> probes;
};

MapChoice map_for(const Made& made, std::size_t node, const Ground& ground, std::size_t more_than) {
  const BuildConfig& config = ground.config;
  const MapCandidates candidates{config.radial_maps, config.bricks, config.map_resolution, more_than};
  return choose_map(ground.solid, ground.skin, node, made.frame, made.probes, ground.budget, candidates);
}

void set_map(MapChoice&& choice, Part& part, PartReport& report) {
  report.map = choice.map.name();
  report.bytes = choice.map.bytes();
  report.error = choice.error;
  report.met = choice.met;
  part.map = std::move(choice.map);
}

Expected<Made> make_part(const PartSource& source, const Ground& ground, PartReport& report) {
  const auto fit = fit_source(source, ground);
  if (!fit) return tl::unexpected(fit.error());
  Made made;
  made.frame = choose_frame(ground.solid, source.node, source.places, source.cell, source.bound_points_O, fit->X_OQ);
  made.probes = make_probes(ground.solid, ground.skin, source.node, source.places, ground.budget, kProbesPerPart,
                            ground.config.seed + 2);
  report.name = source.name;
  report.fit = fit->report;
  report.closed = ground.solid.is_closed(source.node);
  report.samples = source.samples_O.size();
  report.spacing_m = source.spacing_m;
  made.part.name = source.name;
  made.part.X_OQ = fit->X_OQ;
  made.part.superquadric = fit->shape;
  made.part.bound_O = bounding_sphere(source.bound_points_O);
  set_map(map_for(made, source.node, ground, 0), made.part, report);
  if (source.places.empty()) {  // wholly inside others: nobody feels it
    report.error = {0, 0, 0, 0, 0, 0};
    report.met = true;
  }
  return made;
}

/// What find_contacts would say of a point: the hit in which it lies most centrally; and whose it is.
struct Answer {
  MapHit hit;
  std::size_t part = 0;
};

Answer ask(std::span<const Part> parts, const Vec3& p_O) {
  Answer best;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if ((p_O - parts[i].bound_O.center).norm() > parts[i].bound_O.radius) continue;
    const MapHit hit = parts[i].map.evaluate((parts[i].X_OQ.inverse() * p_O).cast<float>());
    if (hit.hit && (!best.hit.hit || hit.m < best.hit.m)) best = {hit, i};
  }
  return best;
}

/// Parts of whose answers, or missing answers, too many break the budget once all parts are asked together.
std::vector<std::size_t> culprits(std::span<const Part> parts, std::span<const Made> made, const ErrorBudget& budget) {
  std::vector<std::size_t> faults(parts.size());
  for (std::size_t i = 0; i < made.size(); ++i) {
    for (const Probe& probe : made[i].probes) {
      const Answer answer = ask(parts, probe.p_O);
      const double depth = answer.hit.hit ? static_cast<double>(answer.hit.depth_m) : 0.0;
      const bool missed = !answer.hit.hit && probe.depth_m > budget.missed_m;
      const bool wrong = answer.hit.hit && probe.depth_m < -budget.missed_m;
      if (missed || wrong) faults[answer.hit.hit ? answer.part : i] += kGraveFault;
      if (answer.hit.hit && std::abs(depth - probe.depth_m) > budget.depth_p99_m) ++faults[answer.part];
    }
  }
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < faults.size(); ++i) {
    if (static_cast<double>(faults[i]) > kFaultShare * static_cast<double>(made[i].probes.size())) found.push_back(i);
  }
  return found;
}

/// Gives parts finer maps until the object as a whole meets the budget, or nothing finer is left.
void refine(std::vector<Part>& parts, std::span<const Made> made, std::span<const PartSource> sources,
            const Ground& ground, std::vector<PartReport>& reports) {
  for (int round = 0; round < kRefinements; ++round) {
    const std::vector<std::size_t> guilty = culprits(parts, made, ground.budget);
    if (guilty.empty()) return;
    std::vector<MapChoice> finer(guilty.size());
    for_each_index(guilty.size(), [&](std::size_t k) {
      const std::size_t i = guilty[k];
      finer[k] = map_for(made[i], sources[i].node, ground, parts[i].map.bytes());
    });
    for (std::size_t k = 0; k < guilty.size(); ++k) {
      const std::size_t i = guilty[k];
      if (finer[k].map.empty()) continue;
      if (finer[k].met || finer[k].error.badness_m() < reports[i].error.badness_m())
        set_map(std::move(finer[k]), parts[i], reports[i]);
    }
  }
}

MapError error_of(const Object& object, std::span<const PartSource> sources, const Ground& ground) {
  std::vector<std::vector<Probe>> probes(sources.size());
  for_each_index(sources.size(), [&](std::size_t i) {
    probes[i] = make_probes(ground.solid, ground.skin, sources[i].node, sources[i].places, ground.budget, kReportProbes,
                            ground.config.seed + 3);
  });
  std::vector<Probe> all;
  for (const auto& some : probes)
    all.insert(all.end(), some.begin(), some.end());
  return measure(all, ground.budget, [&](const Vec3& p_O) { return ask(object.parts, p_O).hit; });
}

}  // namespace

Expected<Object> build_object(std::span<const geometry::NamedMesh> nodes, const BuildConfig& config,
                              BuildReport* report, const PartDone& on_part) {
  const auto start = std::chrono::steady_clock::now();
  if (auto ok = check_config(config); !ok) return tl::unexpected(ok.error());
  const auto welded = weld_nodes(nodes);
  if (!welded) return tl::unexpected(welded.error());
  const Solid solid(*welded, config.seam_gap_m);
  const geometry::MeshQuery skin(air_side(*welded, solid));
  const double diagonal_m = diagonal_of(*welded);
  const Ground ground{*welded, solid, skin, config, budget_of(config, diagonal_m)};

  auto sources = find_sources(nodes, ground);
  if (!sources) return tl::unexpected(sources.error());
  std::vector<Expected<Made>> tried(sources->size());
  BuildReport built;
  built.parts.resize(sources->size());
  std::atomic<std::size_t> done{0};
  for_each_index(sources->size(), [&](std::size_t i) {
    tried[i] = make_part((*sources)[i], ground, built.parts[i]);
    if (on_part) on_part(++done, sources->size());
  });
  Object object;
  std::vector<Made> made;
  for (auto& one : tried) {
    if (!one) return tl::unexpected(one.error());
    object.parts.push_back(std::move(one->part));
    made.push_back(std::move(*one));
  }
  refine(object.parts, made, *sources, ground, built.parts);
  for (std::size_t i = 0; i < made.size(); ++i) {
    built.bytes += object.parts[i].map.bytes();
    append_samples(object, static_cast<std::uint16_t>(i), std::move((*sources)[i].samples_O));
  }
  close_clusters(object);

  if (report != nullptr) {
    built.diagonal_m = diagonal_m;
    built.budget = ground.budget;
    built.error = error_of(object, *sources, ground);
    built.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    *report = std::move(built);
  }
  return object;
}

}  // namespace mechane::collision
