// Mesh files through the product's builder and its contact query: what they take, how exact they are, and their peers' time.
#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <memory>
#include <thread>

#include <CLI/CLI.hpp>

#include "server/collision_build/object_builder.hpp"
#include "server/content/object_store.hpp"
#include "server/geometry/mesh_check.hpp"
#include "server/log/log.hpp"
#include "tests/benchmark/bench_stats.hpp"
#include "tests/benchmark/collision/method.hpp"
#include "tests/benchmark/collision/models.hpp"
#include "tests/benchmark/collision/oracle.hpp"
#include "tests/benchmark/collision/resolution.hpp"
#include "tests/benchmark/collision/timing.hpp"

namespace mechane::benchmark {
namespace {

struct Config {
  std::vector<std::filesystem::path> files;
  std::uint64_t seed = kDefaultSeed;
  std::size_t grasps = 8;
  std::size_t steps = 800;
  std::size_t checked = 160;
  std::size_t rounds = 3;
  bool fields = false;
  std::string only;
};

constexpr double kLeastError_pct = 0.03;  // of the diagonal, that a brick must keep to
constexpr double kFinestSkin_m = 0.0002;  // of the surface that fields are held against: where walls meet
constexpr const char* kApart = "archimedes-screw-INNER";  // its bytes are judged apart

void report_build(const std::string& place, const Scene& scene, const Method& ours, Report& report) {
  const SceneObject& object = scene.objects.front();
  const std::vector<MapShare> maps = ours.maps();
  const auto radial = std::count_if(maps.begin(), maps.end(), [](const MapShare& share) { return share.radial; });
  report.metric(place + "triangles", static_cast<double>(object.mesh_O.triangles.size()));
  report.metric(place + "diagonal_mm", 1000 * object.diagonal_m);
  report.metric(place + "build_s", ours.build_s());
  report.metric(place + "parts", static_cast<double>(maps.size()));
  report.metric(place + "share_radial",
                static_cast<double>(radial) / static_cast<double>(std::max<std::size_t>(maps.size(), 1)));
}

void report_answers(const std::string& place, const std::string& method, double diagonal_m, const Agreement& agreement,
                    Report& report) {
  report.metric(place + "depth_error_pct." + method + ".p99", agreement.error_p99_pct);
  report.metric(place + "depth_error_mm." + method + ".p99", 10 * agreement.error_p99_pct * diagonal_m);
  report.metric(place + "depth_error_mm." + method + ".max", 10 * agreement.error_max_pct * diagonal_m);
  report.metric(place + "missed." + method, static_cast<double>(agreement.missed));
  report.metric(place + "false." + method, static_cast<double>(agreement.false_hits));
  report.metric(place + "checked_contacts." + method, static_cast<double>(agreement.points));
}

/// On a thread of its own: the builders of the next model want all cores again.
std::vector<StepTimes> time_pinned(const Scene& scene, const std::vector<MethodPtr>& methods,
                                   const TimingConfig& config) {
  std::vector<StepTimes> times;
  std::jthread([&] {
    (void)pin_to_one_core();
    times = time_methods(scene, methods, config);
  }).join();
  return times;
}

/// A dense grid that errs as much as ours.
void add_brick(const std::string& place, const Scene& scene, const Oracle& oracle, double error_pct,
               std::vector<MethodPtr>& methods, Report& report) {
  const double diagonal_m = scene.objects.front().diagonal_m;
  Accuracy accuracy;
  accuracy.points = oracle.known_points();
  accuracy.p99_m[0] = std::max(error_pct, kLeastError_pct) / 100 * diagonal_m;
  methods.push_back(make_brick(scene, accuracy, Simd::best));
  report_answers(place, "brick", diagonal_m, compare(scene, oracle, *methods.back())[0], report);
}

/// Returns the medians.
std::vector<double> report_times(const std::string& place, const Scene& scene, const std::vector<MethodPtr>& methods,
                                 const Config& config, Report& report) {
  const std::vector<StepTimes> times = time_pinned(scene, methods, {config.rounds, 0});
  std::vector<double> median_us;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const Quantiles all(times[m].all_passes_us());
    median_us.push_back(all.quantile_us(0.5));
    report.metric(place + "step_us." + methods[m]->name() + ".median", median_us.back());
    report.metric(place + "step_us." + methods[m]->name() + ".p99", all.quantile_us(0.99));
    report.metric(place + "bytes." + methods[m]->name(), static_cast<double>(methods[m]->bytes()));
  }
  return median_us;
}

void measure(const Config& config, SceneObject object, Report& report) {
  const std::string place = "model." + object.name + ".";
  std::cerr << "bench_models: " << object.name << "\n";
  const bool closed = geometry::open_edges(object.mesh_O) == 0;
  const Scene scene = make_scene_of(std::move(object), config.seed, config.grasps, config.steps);
  const double diagonal_m = scene.objects.front().diagonal_m;
  const Oracle oracle(scene, config.checked);
  std::vector<MethodPtr> methods;
  methods.push_back(make_sqmap(scene, "sqmap", build_ours(scene, OurMaps::any), collision::best_set()));
  report_build(place, scene, *methods.front(), report);
  if (closed) {
    const Agreement agreement = compare(scene, oracle, *methods.front())[0];
    report_answers(place, "sqmap", diagonal_m, agreement, report);
    add_brick(place, scene, oracle, agreement.error_p99_pct, methods, report);
  } else {
    report.note(scene.objects.front().name + " has open edges: it has no inside to compare depths with, and no brick");
  }
  methods.push_back(make_fcl_contacts(scene));
  (void)report_times(place, scene, methods, config, report);
}

/// Its field, from the cache if it has parts with names, as a server would have it.
std::shared_ptr<const OurObjects> field_of(const SceneObject& object, const std::filesystem::path& file,
                                           const Scene& scene, content::ObjectStore& store) {
  if (object.parts_O.empty()) return build_ours(scene, OurMaps::fields);
  collision_build::BuildConfig config;
  config.fields = true;
  const Stopwatch watch;
  const auto found = store.load(file, object.name.substr(file.stem().string().size() + 1), config);
  if (!found) return nullptr;
  auto built = std::make_shared<OurObjects>();
  built->objects.push_back(**found);
  built->build_s = watch.seconds();
  return built;
}

/// The largest of all models.
struct Worst {
  double time_ratio = 0;
  double bytes_ratio = 0;
};

/// The field against the brick alone.
void measure_field(const Config& config, const std::filesystem::path& file, SceneObject object,
                   content::ObjectStore& store, Worst& worst, Report& report) {
  const std::string name = object.name;
  const std::string place = "model." + name + ".";
  std::cerr << "bench_models: " << name << "\n";
  if (geometry::open_edges(object.mesh_O) != 0) {
    report.note(name + " has open edges: no brick");
    return;
  }
  const Scene scene = make_scene_of(std::move(object), config.seed, config.grasps, config.steps);
  const auto built = field_of(scene.objects.front(), file, scene, store);
  if (built == nullptr) {
    report.note(name + " was not built");
    return;
  }
  const Oracle oracle(scene, config.checked);
  std::vector<MethodPtr> methods;
  methods.push_back(make_sqmap(scene, "field", built, collision::best_set(), NearLists::used));
  report_build(place, scene, *methods.front(), report);
  const Agreement agreement = compare(scene, oracle, *methods.front())[0];
  report_answers(place, "field", scene.objects.front().diagonal_m, agreement, report);
  add_brick(place, scene, oracle, agreement.error_p99_pct, methods, report);
  const std::vector<double> median_us = report_times(place, scene, methods, config, report);
  worst.time_ratio = std::max(worst.time_ratio, median_us[0] / median_us[1]);
  const auto bytes = static_cast<double>(methods[0]->bytes());
  if (name == kApart) {
    report.metric("bytes.inner_screw", bytes);
  } else {
    worst.bytes_ratio = std::max(worst.bytes_ratio, bytes / static_cast<double>(methods[1]->bytes()));
  }
}

int main_of(const Config& config) {
  Report report;
  content::ObjectStore store;
  Worst worst;
  for (const std::filesystem::path& file : config.files) {
    auto found = load_models(file, config.fields ? kFinestSkin_m : 0);
    if (!found) {
      std::cerr << "bench_models: " << found.error().to_string() << "\n";
      return 2;
    }
    for (SceneObject& object : *found) {
      if (object.name.find(config.only) == std::string::npos) continue;
      if (config.fields) {
        measure_field(config, file, std::move(object), store, worst, report);
      } else {
        measure(config, std::move(object), report);
      }
    }
  }
  if (worst.time_ratio > 0) {
    report.metric("models.time_ratio.max", worst.time_ratio);
    report.metric("models.bytes_ratio.max", worst.bytes_ratio);
  }
  std::cout << report.text() << "\n";
  return 0;
}

}  // namespace
}  // namespace mechane::benchmark

int main(int argc, char** argv) {
  mechane::benchmark::Config config;
  CLI::App app{"A hand that grasps the things in mesh files: ours, a brick of equal error, FCL"};
  app.add_option(
         "files", config.files,
         ".glb, .gltf, .obj, .stl or .ply; bodies with named parts keep their size, other meshes are scaled to 20 cm")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--seed", config.seed, "other seeds draw other grasps");
  app.add_option("--steps", config.steps, "of all grasps of a thing")->check(CLI::Range(8, 1'000'000));
  app.add_flag("--fields", config.fields, "each thing's field against the brick alone; what has named parts is cached");
  app.add_option("--only", config.only, "only things whose names contain this");
  app.add_option("--check", config.checked, "steps at which the answers are compared with the exact ones")
      ->check(CLI::Range(1, 100'000));
  CLI11_PARSE(app, argc, argv);
  mechane::log::start("bench_models", mechane::log::Level::warning);
  return mechane::benchmark::main_of(config);
}
