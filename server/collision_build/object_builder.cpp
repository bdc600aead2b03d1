#include "server/collision_build/object_builder.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

#include "server/base/parallel.hpp"
#include "server/base/random.hpp"
#include "server/collision/samples.hpp"
#include "server/collision_build/cast_map.hpp"
#include "server/collision_build/choose_map.hpp"
#include "server/collision_build/part_box.hpp"
#include "server/collision_build/part_source.hpp"
#include "server/collision_build/solid.hpp"
#include "server/geometry/mesh_check.hpp"
#include "server/geometry/surface_samples.hpp"

namespace mechane::collision_build {
namespace {

constexpr std::size_t kProbesPerPart = 600;  // for the choice of its map
constexpr std::size_t kReportProbes = 400;   // per part, for the object's error
constexpr int kRefinements = 4;              // rounds, at most
constexpr std::size_t kWitnessesPerPart = 12'000;
constexpr std::size_t kWitnessesAlone = 4;  // of a map that must find them all: as if it were so many parts
constexpr std::size_t kMostWitnesses = 120'000;
constexpr double kWitnessDepth = 2.5;     // times what must not be missed
constexpr std::size_t kChunk = 1000;      // witnesses
constexpr double kMostGrowth = 2.5;       // of a map's bytes in one round, for the sake of a thin layer under a crest
constexpr std::size_t kWorthOfWhole = 2;  // a brick may take this many times the bytes of the parts that it replaces
constexpr std::size_t kBytesOfPart =
    480;  // beside its map; fixed, so that no member that is added changes what is built
constexpr std::size_t kMostBytesUncut = 262'144;
constexpr std::size_t kMostBytesUnited = 1U << 20;
constexpr double kFinestSkin = 0.5;  // of the error's budget: what of a wall may reach into another part
constexpr std::size_t kMostProbesUnited = 24'000;
constexpr double kStrayUncut = 5e-4;            // of the witnesses, which are where maps err most
constexpr std::size_t kMostPartsOfWhole = 48;   // for more parts, 64 blocks along the longest edge are too coarse
constexpr std::size_t kAlwaysGranted = 12'288;  // bytes of one map
constexpr double kFaultShare = 0.01;            // of a part's probes: the budget is for the 99th percentile

std::string where_of(const std::string& part) {
  return "part '" + part + "'";
}

/// The same Error, at a part.
tl::unexpected<Error> at_part(Error error, const std::string& part) {
  error.where = where_of(part);
  return tl::unexpected(std::move(error));
}

tl::unexpected<Error> wrong_setting(std::string what, std::string remedy) {
  return fail(ErrorCode::invalid_value, std::move(what), "build settings", std::move(remedy));
}

Expected<void> check_budget(const BuildConfig& config) {
  if (!(config.max_error_share > 0 && config.max_error_share <= 0.1) || !(config.max_error_m > 0)) {
    return wrong_setting("max_error_share is outside 0 to 0.1, or max_error_m is not above 0",
                         "use max_error_share 0.003 and max_error_m 0.001");
  }
  if (!(config.miss_share > 0 && config.miss_share <= 0.1)) {
    return wrong_setting("miss_share is outside 0 to 0.1", "use 0.002");
  }
  if (!(config.probe_depth_m >= 1e-5 && config.probe_depth_m <= 10)) {
    return wrong_setting("probe_depth_m is outside 0.00001 to 10 m", "use 0.004, which is how far a finger sinks in");
  }
  if (!(config.solid.thickness_m >= geometry::kLeastSheet_m && config.solid.thickness_m <= geometry::kMostSheet_m)) {
    return wrong_setting("the thickness of sheets is outside 0.0001 to 0.1 m", "use 0.001");
  }
  if (!config.radial_maps && !config.bricks) {
    return fail(ErrorCode::conflict, "neither radial maps nor bricks are allowed", "build settings",
                "allow at least one of them");
  }
  return {};
}

Expected<void> check_config(const BuildConfig& config) {
  const auto& known = collision::RadialMap::kResolutions;
  if (config.map_resolution != 0 && std::find(known.begin(), known.end(), config.map_resolution) == known.end()) {
    return wrong_setting("map_resolution is " + std::to_string(config.map_resolution),
                         "use 8, 12, 16, 24, 32, 48 or 64, or 0 for the smallest that is exact enough");
  }
  if (!(config.sample_spacing_m >= 1e-4 && config.sample_spacing_m <= 1)) {
    return wrong_setting("sample_spacing_m is outside 0.0001 to 1 m", "use 0.005 for things that a hand touches");
  }
  if (config.max_samples_per_part < collision::kLanes || config.max_samples_per_part > 1'000'000) {
    return wrong_setting("max_samples_per_part is outside 16 to 1000000", "use 4096");
  }
  if (!(config.seam_gap_m >= 0 && config.seam_gap_m <= 0.1)) {
    return wrong_setting("seam_gap_m is outside 0 to 0.1 m", "use 0.001");
  }
  return check_budget(config);
}

Expected<void> check_count(std::size_t parts) {
  if (parts == 0) return fail(ErrorCode::missing, "there are no parts", "object", "name at least one mesh as a part");
  if (parts > collision::kMaxParts) {
    return fail(ErrorCode::too_large, "there are " + std::to_string(parts) + " parts", "object",
                "use fewer, larger parts: at most " + std::to_string(collision::kMaxParts));
  }
  return {};
}

Expected<std::vector<geometry::SolidMesh>> make_solids(std::span<const geometry::NamedMesh> nodes,
                                                       const geometry::SolidChoice& choice) {
  if (auto ok = check_count(nodes.size()); !ok) return tl::unexpected(ok.error());
  std::vector<geometry::SolidMesh> solids;
  for (const geometry::NamedMesh& node : nodes) {
    if (auto ok = geometry::check_mesh(node.mesh, where_of(node.name)); !ok) return tl::unexpected(ok.error());
    const geometry::Mesh welded = geometry::weld(node.mesh);
    if (welded.triangles.empty()) {
      return fail(ErrorCode::invalid_value, "no triangle of the mesh has an area", where_of(node.name),
                  "export the model with its faces");
    }
    solids.push_back(geometry::make_solid(welded, choice));
    if (solids.back().mesh.empty()) {
      return fail(ErrorCode::invalid_value, "the mesh encloses nothing, even with its holes closed",
                  where_of(node.name), "let it be a sheet: solid 'auto', or 'sheet 0.001'");
    }
  }
  return solids;
}

std::vector<geometry::Mesh> meshes_of(std::span<const geometry::SolidMesh> solids) {
  std::vector<geometry::Mesh> meshes;
  for (const geometry::SolidMesh& solid : solids)
    meshes.push_back(solid.mesh);
  return meshes;
}

double diagonal_of(std::span<const geometry::Mesh> meshes) {
  Eigen::AlignedBox3d box;
  for (const geometry::Mesh& mesh : meshes)
    box.extend(mesh.bounds());
  return box.diagonal().norm();
}

ErrorBudget budget_of(const BuildConfig& config, double diagonal_m) {
  return {std::min(config.max_error_share * diagonal_m, config.max_error_m),
          std::min(config.miss_share * diagonal_m, config.max_error_m), config.probe_depth_m};
}

/// Everything that the parts are made from; immutable while they are.
struct BuildInput {
  std::span<const geometry::Mesh> nodes;
  const Solid& solid;
  const geometry::Mesh& skin_mesh;  // what borders on air
  const geometry::MeshQuery& skin;
  const BuildConfig& config;
  ErrorBudget budget;
  bool uncut = false;      // one map for all, in place of pieces
  bool united = false;     // one field for all nodes; uncut is then true, too
  bool may_stray = false;  // a few witnesses may be missed by it
};

bool wants_pieces(const BuildConfig& config, std::size_t nodes) {
  if (config.fields) return false;
  return config.parts == Parts::decomposed || (config.parts == Parts::automatic && nodes == 1);
}

/// The parts to be, in the order of the nodes.
Expected<std::vector<PartSource>> find_sources(std::span<const geometry::NamedMesh> nodes, const BuildInput& input) {
  std::vector<geometry::Decomposition> cuts(nodes.size());
  if (!input.uncut && wants_pieces(input.config, nodes.size())) {
    geometry::DecomposeConfig config;
    config.max_concavity = input.config.max_concavity;
    config.max_parts = input.config.max_pieces;
    config.grid_cells = input.config.grid_cells;
    config.seed = input.config.seed;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      auto cut = geometry::decompose(input.nodes[i], config);
      if (!cut) return at_part(cut.error(), nodes[i].name);
      cuts[i] = std::move(*cut);
    }
  }
  std::vector<std::vector<PartSource>> found(nodes.size());
  for_each_index(nodes.size(), [&](std::size_t i) {
    found[i] = sources_of_node(nodes[i].name, input.nodes[i], i, cuts[i], input.solid, input.config);
  });
  std::vector<PartSource> sources;
  for (auto& some : found)
    std::move(some.begin(), some.end(), std::back_inserter(sources));
  if (input.united) sources = {unite(input.nodes, sources)};
  if (auto ok = check_count(sources.size()); !ok) return tl::unexpected(ok.error());
  return sources;
}

/// Around the mesh if the part is all of it, else around the part's points.
Expected<geometry::FitResult> fit_bound(const PartSource& source, const geometry::Mesh* mesh, const BuildInput& input) {
  if (input.config.bounds == Bounds::boxes) {
    std::vector<Vec3> surface_points_O;
    for (const SurfacePlace& place : source.places)
      surface_points_O.push_back(place.p_O);
    return fit_box(source.bound_points_O, surface_points_O);
  }
  geometry::FitConfig config;
  config.seed = input.config.seed;
  return mesh != nullptr ? geometry::fit_superquadric(*mesh, config)
                         : geometry::fit_superquadric(source.bound_points_O, config);
}

Expected<geometry::FitResult> fit_source(const PartSource& source, const BuildInput& input) {
  const geometry::Mesh all = input.united ? merged(input.nodes) : geometry::Mesh{};
  const geometry::Mesh& mesh = input.united ? all : input.nodes[source.node];
  auto fit = fit_bound(source, source.is_whole_node() ? &mesh : nullptr, input);
  if (!fit) return at_part(fit.error(), source.name);
  return fit;
}

MapFrame frame_around(std::span<const Vec3> points_O, const Pose& X_OQ) {
  const Pose X_QO = X_OQ.inverse();
  Eigen::AlignedBox3d box_Q;
  for (const Vec3& p_O : points_O)
    box_Q.extend(X_QO * p_O);
  return {X_OQ, box_Q.center(), 0.5 * box_Q.sizes()};
}

/// A part, with what is needed to make a finer map of it.
struct BuiltPart {
  collision::Part part;
  MapFrame frame;
  MapFrame box;  // the tightest frame, whatever is seen from its middle
  std::vector<Probe> probes;
};

MapChoice map_for(const BuiltPart& built, const BuildInput& input, std::size_t more_than, std::span<const Probe> must,
                  bool may_grow = false) {
  const BuildConfig& config = input.config;
  MapCandidates candidates{config.radial_maps, config.bricks, config.map_resolution, more_than};
  candidates.must = must;
  if (input.uncut) {
    candidates.at_most = kMostBytesUncut;
    candidates.but_for = kStrayUncut;
    candidates.brick_frame = &built.box;
  }
  if (config.fields) candidates.field_of = &input.skin_mesh;
  if (input.united) {
    candidates.at_most = kMostBytesUnited;
    candidates.but_for = input.may_stray ? kStrayUncut : 0;
    candidates.radial = candidates.brick = false;  // parts are better than those
  }
  // A map that is not exact enough may grow as far as it must; one that only misses a thin layer may not.
  if (more_than > 0 && !may_grow)
    candidates.at_most =
        std::max(kAlwaysGranted, static_cast<std::size_t>(kMostGrowth * static_cast<double>(more_than)));
  return choose_map(input.solid, input.skin, built.frame, built.probes, input.budget, candidates);
}

void set_map(MapChoice&& choice, collision::Part& part, PartReport& report) {
  report.map = choice.map.name();
  report.bytes = choice.map.bytes();
  report.error = choice.error;
  report.met = choice.met;
  part.map = std::move(choice.map);
}

/// `must`: see MapCandidates.
Expected<BuiltPart> make_part(const PartSource& source, const BuildInput& input, std::span<const Probe> must,
                              PartReport& report) {
  const auto fit = fit_source(source, input);
  if (!fit) return tl::unexpected(fit.error());
  BuiltPart built;
  built.box = frame_around(source.bound_points_O, fit->X_OQ);
  built.frame = input.united ? built.box
                             : choose_frame(input.solid, source.node, source.places, source.cell, source.bound_points_O,
                                            fit->X_OQ);
  const std::size_t probes = input.united  ? std::min(kMostProbesUnited, kProbesPerPart * input.nodes.size())
                             : input.uncut ? source.places.size()
                                           : kProbesPerPart;
  built.probes = make_probes(input.solid, input.skin, source.places, input.budget, probes, input.config.seed + 2);
  report.name = source.name;
  report.fit = fit->report;
  report.samples = source.samples_O.size();
  report.spacing_m = source.spacing_m;
  built.part.name = source.name;
  built.part.X_OQ = fit->X_OQ;
  built.part.superquadric = fit->shape;
  built.part.bound_O = collision::bounding_sphere(source.bound_points_O);
  set_map(map_for(built, input, 0, must), built.part, report);
  if (source.places.empty()) {  // wholly inside others: nobody feels it
    report.error = {0, 0, 0, 0, 0, 0};
    report.met = true;
  }
  return built;
}

/// What find_contacts would find for a point: the hit of the part in which it lies most centrally, and that part.
struct Answer {
  collision::MapHit hit;
  std::size_t part = 0;
};

Answer ask(std::span<const collision::Part> parts, const Vec3& p_O) {
  Answer best;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if ((p_O - parts[i].bound_O.center).norm() > parts[i].bound_O.radius) continue;
    const collision::MapHit hit = parts[i].map.evaluate((parts[i].X_OQ.inverse() * p_O).cast<float>());
    if (hit.hit && (!best.hit.hit || hit.m < best.hit.m)) best = {hit, i};
  }
  return best;
}

/// The part that should have answered for a point that no part found: the one whose map's box holds it the most centrally.
std::size_t owner(std::span<const collision::Part> parts, const Vec3& p_O) {
  std::size_t best = 0;
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const collision::BoxView box = parts[i].map.box();
    const Vec3f p_Q = (parts[i].X_OQ.inverse() * p_O).cast<float>();
    float m = 0;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      m = std::max(m, std::abs(p_Q[k] - box.center[axis]) / box.half[axis]);
    }
    if (m >= least) continue;
    least = m;
    best = i;
  }
  return best;
}

/// The faults of a part when all parts are asked together.
struct Faults {
  std::size_t inexact = 0;    // of the part's own probes
  bool made_up = false;       // one of them is a contact with air
  std::vector<Probe> missed;  // own probes and witnesses
};

void judge_own(std::span<const collision::Part> parts, std::span<const BuiltPart> built, const ErrorBudget& budget,
               std::vector<Faults>& faults) {
  for (const BuiltPart& one : built) {
    for (const Probe& probe : one.probes) {
      const Answer answer = ask(parts, probe.p_O);
      if (!answer.hit.hit) {
        if (probe.depth_m > budget.missed_m) faults[owner(parts, probe.p_O)].missed.push_back(probe);
        continue;
      }
      Faults& answering = faults[answer.part];
      if (probe.depth_m < -budget.missed_m) answering.made_up = true;
      if (std::abs(static_cast<double>(answer.hit.depth_m) - probe.depth_m) > budget.depth_p99_m) ++answering.inexact;
    }
  }
}

std::vector<Faults> find_faults(std::span<const collision::Part> parts, std::span<const BuiltPart> built,
                                std::span<const Probe> witnesses, const ErrorBudget& budget) {
  std::vector<Faults> faults(parts.size());
  judge_own(parts, built, budget, faults);
  std::vector<std::uint8_t> missed(witnesses.size());
  for_each_index((witnesses.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    for (std::size_t k = kChunk * chunk; k < std::min(witnesses.size(), kChunk * (chunk + 1)); ++k)
      missed[k] = ask(parts, witnesses[k].p_O).hit.hit ? 0 : 1;
  });
  for (std::size_t k = 0; k < witnesses.size(); ++k) {
    if (missed[k] != 0) faults[owner(parts, witnesses[k].p_O)].missed.push_back(witnesses[k]);
  }
  return faults;
}

/// Many points just deep enough to count, all over the surface. The crest of a thread is a few per cent of its part, and only a thin
/// layer under it gets lost: a part's own probes, at all depths, seldom meet it.
std::vector<Probe> make_witnesses(const BuildInput& input, std::size_t parts) {
  const std::size_t count = std::min(kMostWitnesses, kWitnessesPerPart * parts);
  const auto places = geometry::sample_by_area(input.skin_mesh, count, input.config.seed + 4);
  std::vector<std::vector<Probe>> some((places.size() + kChunk - 1) / kChunk);
  for_each_index(some.size(), [&](std::size_t chunk) {
    Random random(input.config.seed + 5 + chunk);
    for (std::size_t k = kChunk * chunk; k < std::min(places.size(), kChunk * (chunk + 1)); ++k) {
      const double wanted_m = input.budget.missed_m * (1 + (kWitnessDepth - 1) * random.unit());
      const Vec3 p_O = places[k].p - wanted_m * input.skin.triangle_normal(places[k].triangle);
      if (!input.solid.contains(p_O)) continue;
      const double depth_m = input.skin.closest(p_O).distance_m;
      if (depth_m > input.budget.missed_m) some[chunk].push_back({p_O, depth_m});
    }
  });
  std::vector<Probe> witnesses;
  for (const auto& probes : some)
    witnesses.insert(witnesses.end(), probes.begin(), probes.end());
  return witnesses;
}

/// Gives parts finer maps until the object as a whole meets the budget, or nothing finer is left.
void refine(std::vector<collision::Part>& parts, std::span<const BuiltPart> built, std::span<const Probe> witnesses,
            const BuildInput& input, std::vector<PartReport>& reports) {
  std::vector<std::vector<Probe>> must(parts.size());
  std::vector<bool> exhausted(parts.size());
  for (int round = 0; round < kRefinements; ++round) {
    const std::vector<Faults> faults = find_faults(parts, built, witnesses, input.budget);
    std::vector<std::size_t> guilty;
    std::vector<bool> may_grow(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      must[i].insert(must[i].end(), faults[i].missed.begin(), faults[i].missed.end());
      // Only the first round is for inexact maps: one that is still inexact after it stays so.
      const bool inexact = faults[i].made_up || static_cast<double>(faults[i].inexact) >
                                                    kFaultShare * static_cast<double>(built[i].probes.size());
      may_grow[i] = round == 0 && inexact && !reports[i].met;
      if (!exhausted[i] && ((round == 0 && inexact) || !faults[i].missed.empty())) guilty.push_back(i);
    }
    if (guilty.empty()) return;
    std::vector<MapChoice> finer(guilty.size());
    for_each_index(guilty.size(), [&](std::size_t k) {
      const std::size_t i = guilty[k];
      finer[k] = map_for(built[i], input, parts[i].map.bytes(), must[i], may_grow[i]);
    });
    for (std::size_t k = 0; k < guilty.size(); ++k) {
      const std::size_t i = guilty[k];
      const MapError& before = reports[i].error;
      const bool fewer = finer[k].error.p99_m <= before.p99_m && finer[k].error.missed < before.missed + must[i].size();
      const bool better = !finer[k].map.empty() && (finer[k].met || fewer);
      exhausted[i] = !better || !finer[k].met;
      if (better) set_map(std::move(finer[k]), parts[i], reports[i]);
    }
  }
}

/// A part as a query uses it.
std::size_t bytes_of(const collision::Part& part) {
  return part.map.bytes() + kBytesOfPart;
}

/// One brick in place of all parts, where it meets the budget and is not much larger: a query then asks once, not part after part. Nothing
/// where the parts are better.
std::optional<collision::Part> make_whole(const PartSource& whole, std::span<const collision::Part> parts,
                                          std::span<const BuiltPart> built, std::span<const Probe> witnesses,
                                          const BuildInput& input, PartReport& report) {
  const geometry::Mesh mesh = merged(input.nodes);
  const auto fit = fit_bound(whole, &mesh, input);
  if (!fit) return std::nullopt;
  std::vector<Probe> probes;
  for (const BuiltPart& one : built)
    probes.insert(probes.end(), one.probes.begin(), one.probes.end());
  std::vector<Probe> must(witnesses.begin(), witnesses.end());  // a single part has no neighbours that help out
  must.insert(must.end(), probes.begin(), probes.end());
  MapCandidates candidates;
  candidates.radial = false;
  candidates.must = must;
  candidates.at_most = 0;
  for (const collision::Part& part : parts)
    candidates.at_most += bytes_of(part);
  candidates.at_most *= kWorthOfWhole;
  MapChoice choice = choose_map(input.solid, input.skin, frame_around(whole.bound_points_O, fit->X_OQ), probes,
                                input.budget, candidates);
  if (!choice.met) return std::nullopt;
  report.name = whole.name;
  report.fit = fit->report;
  report.samples = whole.samples_O.size();
  report.spacing_m = whole.spacing_m;
  collision::Part part;
  part.name = whole.name;
  part.X_OQ = fit->X_OQ;
  part.superquadric = fit->shape;
  part.bound_O = collision::bounding_sphere(whole.bound_points_O);
  set_map(std::move(choice), part, report);
  return part;
}

/// Parts that the author named are not united.
bool may_be_whole(const BuildConfig& config, std::size_t nodes, std::size_t parts) {
  return config.bricks && wants_pieces(config, nodes) && parts >= 2 && parts <= kMostPartsOfWhole;
}

/// For the object's error: of the same number from each source.
std::vector<Probe> make_report_probes(std::span<const PartSource> sources, const BuildInput& input) {
  std::vector<std::vector<Probe>> probes(sources.size());
  for_each_index(sources.size(), [&](std::size_t i) {
    probes[i] =
        make_probes(input.solid, input.skin, sources[i].places, input.budget, kReportProbes, input.config.seed + 3);
  });
  std::vector<Probe> all;
  for (const auto& some : probes)
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

/// An object that still lacks its samples.
struct Draft {
  std::vector<PartSource> sources;
  std::vector<Probe> witnesses;
  std::vector<BuiltPart> built;
  std::vector<collision::Part> parts;
  std::vector<PartReport> reports;
};

Expected<Draft> make_draft(std::span<const geometry::NamedMesh> nodes, const BuildInput& input,
                           const PartDone& on_part) {
  auto sources = find_sources(nodes, input);
  if (!sources) return tl::unexpected(sources.error());
  Draft draft;
  draft.sources = std::move(*sources);
  const std::size_t count = draft.sources.size();
  const bool is_alone = input.uncut || (input.config.fields && count == 1);
  draft.witnesses = make_witnesses(input, is_alone ? std::max(kWitnessesAlone, nodes.size()) : count);
  const std::span<const Probe> must = is_alone ? std::span(draft.witnesses) : std::span<const Probe>();
  std::vector<Expected<BuiltPart>> tried(count);
  draft.reports.resize(count);
  std::atomic<std::size_t> done{0};
  for_each_index(count, [&](std::size_t i) {
    tried[i] = make_part(draft.sources[i], input, must, draft.reports[i]);
    if (on_part) on_part(++done, count);
  });
  for (auto& one : tried) {
    if (!one) return tl::unexpected(one.error());
    draft.parts.push_back(std::move(one->part));
    draft.built.push_back(std::move(*one));
  }
  if (!input.uncut) refine(draft.parts, draft.built, draft.witnesses, input, draft.reports);
  return draft;
}

/// Nothing that a hand feels belongs to a part: materials and surfaces are a body's.
bool may_be_united(const BuildConfig& config, std::size_t nodes) {
  return config.fields && config.parts != Parts::as_given && nodes > 1;
}

/// What was open or overlapped mostly ends with one map, however it is cut, and asking for winding numbers along the rays of pieces' maps
/// would take nine tenths of the time. A closed mesh is cut first, for its pieces may be smaller.
bool may_stay_uncut(const BuildConfig& config, std::span<const geometry::SolidMesh> solids) {
  const geometry::SolidMesh& first = solids.front();
  return config.bricks && solids.size() == 1 && wants_pieces(config, 1) &&
         (first.open_edges > 0 || first.hidden_area_m2 > 0);
}

Expected<Draft> make_best_draft(std::span<const geometry::NamedMesh> nodes, std::span<const geometry::SolidMesh> solids,
                                const BuildInput& input, const PartDone& on_part) {
  const bool united = may_be_united(input.config, nodes.size());
  if (united || may_stay_uncut(input.config, solids)) {
    BuildInput uncut = input;
    uncut.uncut = true;
    uncut.united = united;
    // On a large thing the witnesses lie less deep than what counts as missed by its size.
    uncut.may_stray = kWitnessDepth * input.budget.missed_m <= input.config.miss_share * diagonal_of(input.nodes);
    auto draft = make_draft(nodes, uncut, on_part);
    if (draft && draft->reports.front().met) return draft;
  }
  return make_draft(nodes, input, on_part);
}

}  // namespace

Expected<collision::Object> build_object(std::span<const geometry::NamedMesh> nodes, const BuildConfig& config,
                                         BuildReport* report, const PartDone& on_part) {
  const auto start = std::chrono::steady_clock::now();
  if (auto ok = check_config(config); !ok) return tl::unexpected(ok.error());
  auto solids = make_solids(nodes, config.solid);
  if (!solids) return tl::unexpected(solids.error());
  const std::vector<geometry::Mesh> meshes = meshes_of(*solids);
  const Solid solid(meshes, config.seam_gap_m);
  const double diagonal_m = diagonal_of(meshes);
  const ErrorBudget budget = budget_of(config, diagonal_m);
  const geometry::Mesh skin_mesh =
      config.fields ? cut_air_side(meshes, solid, kFinestSkin * budget.depth_p99_m) : air_side(meshes, solid);
  const geometry::MeshQuery skin(skin_mesh);
  const BuildInput input{meshes, solid, skin_mesh, skin, config, budget};

  auto draft = make_best_draft(nodes, *solids, input, on_part);
  if (!draft) return tl::unexpected(draft.error());
  collision::Object object;
  object.parts = std::move(draft->parts);
  BuildReport full_report;
  full_report.parts = std::move(draft->reports);
  std::vector<PartSource>& sources = draft->sources;
  std::vector<Probe> report_probes;
  if (report != nullptr) report_probes = make_report_probes(sources, input);
  if (may_be_whole(config, nodes.size(), object.parts.size())) {
    PartSource whole = unite(meshes, sources);
    if (nodes.size() == 1) whole.name = nodes[0].name;
    PartReport whole_report;
    if (auto part = make_whole(whole, object.parts, draft->built, draft->witnesses, input, whole_report)) {
      object.parts = {std::move(*part)};
      full_report.parts = {std::move(whole_report)};
      sources = {std::move(whole)};
    }
  }
  for (std::size_t i = 0; i < object.parts.size(); ++i) {
    full_report.bytes += object.parts[i].map.bytes();
    collision::append_samples(object, static_cast<std::uint16_t>(i), std::move(sources[i].samples_O));
  }
  collision::close_clusters(object);

  if (report != nullptr) {
    full_report.solids = std::move(*solids);
    full_report.diagonal_m = diagonal_m;
    full_report.budget = input.budget;
    full_report.error =
        measure(report_probes, input.budget, [&](const Vec3& p_O) { return ask(object.parts, p_O).hit; });
    full_report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    *report = std::move(full_report);
  }
  return object;
}

}  // namespace mechane::collision_build
