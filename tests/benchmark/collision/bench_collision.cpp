// Contact queries of the product and of its peers, on one scene, in one run: equal answers first, then time and memory.
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <numeric>

#include <CLI/CLI.hpp>

#include "server/collision/kernels.hpp"
#include "tests/benchmark/bench_stats.hpp"
#include "tests/benchmark/collision/method.hpp"
#include "tests/benchmark/collision/oracle.hpp"
#include "tests/benchmark/collision/timing.hpp"

namespace mechane::benchmark {
namespace {

constexpr const char* kOurs = "sqmap";
constexpr const char* kField = "field";
constexpr double kBrickErrorShare = 0.001;  // of an object's diagonal: what sizes the dense grids, whatever ours err by
constexpr std::array<std::size_t, 4> kCrowds = {1, 10, 100, 1000};

bool is_ours(const std::string& method) {
  return method.starts_with(kOurs) || method.starts_with(kField);
}

struct Config {
  std::uint64_t seed = kDefaultSeed;
  std::size_t steps = 2000;
  std::size_t checked = 200;
  double budget_pct = 0.3;
  double our_error_pct = 100 * kOurErrorShare;
  bool crowds = false;
  TimingConfig timing;
  std::vector<std::string> methods = {
      kOurs,          "sqmap_avx512", "sqmap_avx2",     "sqmap_portable", "sqmap_nobrick", "sqmap_boxes", "field",
      "field_lists",  "field_avx2",   "field_portable", "paper",          "paper_along",   "brick",       "brick_lists",
      "brick_scalar", "openvdb",      "bt_sdf",         "embree",         "fcl_contacts",  "fcl_yesno",   "fcl_gjk"};
};

using Agreements = std::array<Agreement, kSceneObjects>;

/// Our objects are built once for all instruction sets.
class Workshop {
 public:
  Workshop(const Scene& scene, double our_error_pct, Report& report)
      : scene_(scene), our_error_pct_(our_error_pct), report_(report) {}

  /// Null where the machine lacks what it takes, which the report then says, or where there is no such method.
  MethodPtr make(const std::string& name, const Accuracy& accuracy) {
    if (is_ours(name)) return make_ours(name);
    if (name.starts_with("paper")) return make_paper(scene_, name, *objects_of(OurMaps::any));
    if (name == "brick") return make_brick(scene_, of_bricks(accuracy), Simd::best);
    if (name == "brick_lists") return make_brick(scene_, of_bricks(accuracy), Simd::best, NearLists::used);
    if (name == "brick_scalar") return make_brick(scene_, of_bricks(accuracy), Simd::scalar);
    if (name == "openvdb") return make_openvdb(scene_, accuracy);
    if (name == "bt_sdf") return make_bt_sdf(scene_, accuracy);
    if (name == "embree") return make_embree(scene_);
    if (name == "fcl_contacts") return make_fcl_contacts(scene_);
    if (name == "fcl_yesno") return make_fcl_yesno(scene_);
    if (name == "fcl_gjk") return make_fcl_gjk(scene_);
    return nullptr;
  }
  /// Fields among more and more objects.
  std::vector<MethodPtr> make_crowds() {
    std::vector<MethodPtr> made;
    for (const std::size_t objects : kCrowds)
      made.push_back(make_crowd(scene_, "objects_us." + std::to_string(objects), objects_of(OurMaps::fields), objects));
    return made;
  }

 private:
  [[nodiscard]] Accuracy of_bricks(Accuracy accuracy) const {
    for (std::size_t k = 0; k < kSceneObjects; ++k)
      accuracy.p99_m[k] = kBrickErrorShare * scene_.objects[k].diagonal_m;
    return accuracy;
  }
  MethodPtr make_ours(const std::string& name) {
    using collision::InstructionSet;
    if (name == kOurs) return with(name, OurMaps::any, collision::best_set());
    if (name == "sqmap_avx512") return with(name, OurMaps::any, InstructionSet::avx512);
    if (name == "sqmap_avx2") return with(name, OurMaps::any, InstructionSet::avx2);
    if (name == "sqmap_portable") return with(name, OurMaps::any, InstructionSet::portable);
    if (name == "sqmap_nobrick") return with(name, OurMaps::radial_only, collision::best_set());
    if (name == "field_lists") return with(name, OurMaps::fields, collision::best_set(), NearLists::used);
    if (name == "field") return with(name, OurMaps::fields, collision::best_set());
    if (name == "field_avx2") return with(name, OurMaps::fields, InstructionSet::avx2);
    if (name == "field_portable") return with(name, OurMaps::fields, InstructionSet::portable);
    if (name == "sqmap_boxes") return with(name, OurMaps::boxes, collision::best_set());
    return nullptr;
  }
  MethodPtr with(const std::string& name, OurMaps maps, collision::InstructionSet set,
                 NearLists lists = NearLists::none) {
    if (!collision::is_supported(set)) {
      report_.note(name + " was not run: this processor lacks its instructions");
      return nullptr;
    }
    return make_sqmap(scene_, name, objects_of(maps), set, lists);
  }
  const std::shared_ptr<const OurObjects>& objects_of(OurMaps maps) {
    std::shared_ptr<const OurObjects>& built = built_[maps];
    if (built == nullptr) built = build_ours(scene_, maps, our_error_pct_ / 100);
    return built;
  }

  const Scene& scene_;
  double our_error_pct_;
  Report& report_;
  std::map<OurMaps, std::shared_ptr<const OurObjects>> built_;
};

std::vector<std::string> known_methods() {
  return Config{}.methods;
}

/// The grids may err as much as our maps do, object by object: no more than the budget, and no less than a tenth of it.
Accuracy accuracy_for(const Config& config, const Scene& scene, const Oracle& oracle, Method* ours) {
  Accuracy accuracy;
  accuracy.points = oracle.known_points();
  const Agreements agreements = ours != nullptr ? compare(scene, oracle, *ours) : Agreements{};
  for (std::size_t k = 0; k < kSceneObjects; ++k) {
    const double pct = ours != nullptr
                           ? std::clamp(agreements[k].error_p99_pct, 0.1 * config.budget_pct, config.budget_pct)
                           : config.budget_pct;
    accuracy.p99_m[k] = pct / 100 * scene.objects[k].diagonal_m;
  }
  return accuracy;
}

void report_scene(const Scene& scene, const Oracle& oracle, Report& report) {
  std::size_t triangles = 0;
  for (const SceneObject& object : scene.objects)
    triangles += object.mesh_O.triangles.size();
  report.metric("scene.triangles", static_cast<double>(triangles));
  for (std::size_t k = 0; k < kSceneObjects; ++k) {
    const auto first = std::find(scene.grasped.begin(), scene.grasped.end(), k) - scene.grasped.begin();
    report.metric("scene.first_step." + scene.objects[k].name, static_cast<double>(first));
  }
  std::vector<float> depths_pct;
  for (const Oracle::Step& step : oracle.steps())
    for (const Oracle::Answer& answer : step.near)
      if (answer.distance_m < 0)
        depths_pct.push_back(static_cast<float>(-100 * answer.distance_m / scene.objects[answer.object].diagonal_m));
  const Quantiles depths(depths_pct);
  report.metric("scene.points_inside_per_step",
                static_cast<double>(depths.size()) / static_cast<double>(oracle.steps().size()));
  report.metric("scene.depth_pct.median", depths.quantile_us(0.5));
  report.metric("scene.depth_pct.p99", depths.quantile_us(0.99));
  report.metric("scene.depth_pct.max", depths.quantile_us(1));
}

/// Ours goes by the bare names, too.
void report_agreement(const Scene& scene, const std::string& method, const Agreements& agreements, Report& report) {
  Agreement worst;
  for (std::size_t k = 0; k < kSceneObjects; ++k) {
    const Agreement& a = agreements[k];
    const std::string place = "." + method + "." + scene.objects[k].name;
    report.metric("depth_error_pct" + place + ".p50", a.error_p50_pct);
    report.metric("depth_error_pct" + place + ".p99", a.error_p99_pct);
    report.metric("depth_error_pct" + place + ".max", a.error_max_pct);
    report.metric("normal_error_deg" + place + ".p50", a.normal_p50_deg);
    report.metric("normal_error_deg" + place + ".p99", a.normal_p99_deg);
    report.metric("normal_deg" + place + ".p99", a.faces_p99_deg);
    report.metric("missed" + place, static_cast<double>(a.missed));
    report.metric("false" + place, static_cast<double>(a.false_hits));
    worst.points += a.points;
    worst.missed += a.missed;
    worst.false_hits += a.false_hits;
    worst.error_p50_pct = std::max(worst.error_p50_pct, a.error_p50_pct);
    worst.error_p99_pct = std::max(worst.error_p99_pct, a.error_p99_pct);
    worst.faces_p99_deg = std::max(worst.faces_p99_deg, a.faces_p99_deg);
    worst.error_max_pct = std::max(worst.error_max_pct, a.error_max_pct);
  }
  for (const std::string& place :
       method == kOurs ? std::vector<std::string>{"", "." + method} : std::vector{"." + method}) {
    report.metric("depth_error_pct" + place + ".p50", worst.error_p50_pct);
    report.metric("depth_error_pct" + place + ".p99", worst.error_p99_pct);
    report.metric("depth_error_pct" + place + ".max", worst.error_max_pct);
    report.metric("normal_deg" + place + ".p99", worst.faces_p99_deg);
    report.metric("missed" + place, static_cast<double>(worst.missed));
    report.metric("false" + place, static_cast<double>(worst.false_hits));
  }
  report.metric("checked_contacts." + method, static_cast<double>(worst.points));
}

/// The median over the rounds, step by step.
std::vector<std::array<double, 2>> by_step(const StepTimes& times, std::size_t steps) {
  std::vector<std::array<double, 2>> curve;
  for (std::size_t step = 0; step < steps; ++step) {
    std::vector<float> here;
    for (const auto& round : times.rounds_us)
      here.push_back(round[step]);
    curve.push_back({static_cast<double>(step), Quantiles(here).quantile_us(0.5)});
  }
  return curve;
}

void report_times(const Scene& scene, const std::string& method, const StepTimes& times, Report& report) {
  const std::vector<float> all = times.all_passes_us();
  Quantiles whole(all);
  report.distribution("step_us." + method, whole);
  const auto count = static_cast<double>(std::max<std::size_t>(all.size(), 1));
  report.metric("step_us." + method + ".mean", std::accumulate(all.begin(), all.end(), 0.0) / count);
  report.metric("preempted_pct." + method, 100 * static_cast<double>(times.preempted) / count);
  std::vector<std::vector<float>> of_object(kSceneObjects);
  for (const auto& round : times.rounds_us)
    for (std::size_t step = 0; step < round.size(); ++step)
      of_object[scene.grasped[step]].push_back(round[step]);
  for (std::size_t k = 0; k < kSceneObjects; ++k) {
    const Quantiles object(of_object[k]);
    report.metric("step_us." + method + "." + scene.objects[k].name + ".median", object.quantile_us(0.5));
    report.metric("step_us." + method + "." + scene.objects[k].name + ".p99", object.quantile_us(0.99));
  }
  const Quantiles cold(times.cold_us);
  report.metric("cold_step_us." + method + ".median", cold.quantile_us(0.5));
  report.metric("cold_step_us." + method + ".p99", cold.quantile_us(0.99));
  if (method == "sqmap_boxes") report.metric("step_us.box_frame.median", whole.quantile_us(0.5));
  report.curve("grasp." + method, by_step(times, scene.steps.size()));
}

/// ratio.<peer> and, with a run of our AVX2 kernels, ratio_avx2.<peer>: how many times as long as ours the peer takes. With fields, also
/// ratio_field.<peer>, and ratio_field_lists.<peer> where what is near is remembered. Names that end in _p99: of the 99th percentiles.
void report_ratios(const std::vector<MethodPtr>& methods, const std::vector<StepTimes>& times, Report& report) {
  for (const auto& [share, suffix] : {std::pair{0.5, ""}, std::pair{0.99, "_p99"}}) {
    std::map<std::string, double> us;
    for (std::size_t m = 0; m < methods.size(); ++m)
      us[methods[m]->name()] = Quantiles(times[m].all_passes_us()).quantile_us(share);
    for (const auto& [base, prefix] :
         {std::pair{kOurs, "ratio"}, std::pair{"sqmap_avx2", "ratio_avx2"}, std::pair{kField, "ratio_field"},
          std::pair{"field_lists", "ratio_field_lists"}}) {
      const auto ours = us.find(base);
      if (ours == us.end() || ours->second <= 0) continue;
      for (const auto& [name, time] : us)
        if (!is_ours(name)) report.metric(prefix + std::string(".") + name + suffix, time / ours->second);
    }
  }
}

/// Where the bytes are: maps of either kind, how many parts there are, and what a part takes besides its map.
void report_shares(const Scene& scene, const std::vector<MapShare>& maps, Report& report) {
  std::map<std::string, double> sums;
  for (const MapShare& share : maps) {
    const std::string& object = scene.objects[share.object].name;
    for (const std::string& place : {std::string(), "." + object}) {
      sums["parts" + place] += 1;
      sums["map_bytes" + place + (share.radial ? ".radial" : ".brick")] += static_cast<double>(share.bytes);
    }
  }
  for (const auto& [name, sum] : sums)
    report.metric(name, sum);
}

void report_method(const Scene& scene, const Method& method, Report& report) {
  report.metric("bytes." + method.name(), static_cast<double>(method.bytes()));
  const std::vector<std::size_t> bytes = method.bytes_by_object();
  for (std::size_t k = 0; k < bytes.size(); ++k)
    report.metric("bytes." + method.name() + "." + scene.objects[k].name, static_cast<double>(bytes[k]));
  report.metric((method.name() == kOurs ? "build_s" : "build_s." + method.name()), method.build_s());
  std::size_t radial = 0;
  std::map<std::string, std::string> kept;
  const std::vector<MapShare> maps = method.maps();
  for (const MapShare& share : maps) {
    radial += share.radial ? 1 : 0;
    kept[scene.objects[share.object].name] += (kept[scene.objects[share.object].name].empty() ? "" : ", ") + share.name;
  }
  if (!maps.empty() && method.name() == kOurs) {
    report_shares(scene, maps, report);
    report.metric("share.radial", static_cast<double>(radial) / static_cast<double>(maps.size()));
    report.metric("share.brick", 1 - static_cast<double>(radial) / static_cast<double>(maps.size()));
    for (const auto& [object, names] : kept)
      report.note("sqmap keeps " + object + " in " + names);
  }
  const std::vector<int> cells = method.cells();
  for (std::size_t k = 0; k < cells.size(); ++k)
    report.metric("cells." + method.name() + "." + scene.objects[k].name, cells[k]);
  for (const auto& [name, value] : method.extra_metrics())
    report.metric(name, value);
  if (!method.answers_points())
    report.metric("mesh_contacts_per_step." + method.name(), method.mesh_contacts_per_step());
}

int main_of(const Config& config) {
  Report report;
  std::cerr << "bench_collision: scene\n";
  const Scene scene = make_scene(config.seed, config.steps);
  const Oracle oracle(scene, config.checked);
  report_scene(scene, oracle, report);
  std::vector<MethodPtr> methods;
  Accuracy accuracy;
  const bool with_ours = std::find(config.methods.begin(), config.methods.end(), kOurs) != config.methods.end();
  Workshop workshop(scene, config.our_error_pct, report);
  if (with_ours) methods.push_back(workshop.make(kOurs, accuracy));
  accuracy = accuracy_for(config, scene, oracle, with_ours ? methods.front().get() : nullptr);
  for (const std::string& name : config.methods) {
    if (name == kOurs) continue;
    std::cerr << "bench_collision: building " << name << "\n";
    MethodPtr method = workshop.make(name, accuracy);
    if (method != nullptr) methods.push_back(std::move(method));
  }
  for (const MethodPtr& method : methods) {
    if (!method->answers_points()) continue;
    std::cerr << "bench_collision: checking " << method->name() << "\n";
    report_agreement(scene, method->name(), compare(scene, oracle, *method), report);
  }
  if (std::find(config.methods.begin(), config.methods.end(), "paper") != config.methods.end())
    report.rows("paper_map_mm", paper_picture(scene));
  if (!pin_to_one_core()) report.note("the system refused to pin the program to one core");
  std::cerr << "bench_collision: timing\n";
  const std::vector<StepTimes> times = time_methods(scene, methods, config.timing);
  for (std::size_t m = 0; m < methods.size(); ++m) {
    report_times(scene, methods[m]->name(), times[m], report);
    report_method(scene, *methods[m], report);
  }
  report_ratios(methods, times, report);
  if (config.crowds) {
    const std::vector<MethodPtr> crowds = workshop.make_crowds();
    const std::vector<StepTimes> taken = time_methods(scene, crowds, {config.timing.rounds, 0});
    for (std::size_t m = 0; m < crowds.size(); ++m)
      report.metric(crowds[m]->name(), Quantiles(taken[m].all_passes_us()).quantile_us(0.5));
  }
  report.note("steps from which the system took the core were timed again, at once: preempted_pct says how many");
  std::cout << report.text() << "\n";
  return 0;
}

}  // namespace
}  // namespace mechane::benchmark

int main(int argc, char** argv) {
  mechane::benchmark::Config config;
  CLI::App app{"Contact queries of a hand against five objects: ours and the peers', their answers, times and memory"};
  app.add_option("--seed", config.seed, "other seeds draw other objects of the same kinds, and other grasps");
  app.add_option("--steps", config.steps, "of approach and grasp, over all objects")->check(CLI::Range(50, 1'000'000));
  app.add_option("--rounds", config.timing.rounds, "how often each method goes through all steps")
      ->check(CLI::Range(1, 1000));
  app.add_option("--cold-steps", config.timing.cold_steps, "steps that are timed with cold caches")
      ->check(CLI::Range(0, 100'000));
  app.add_option("--check", config.checked, "steps at which the answers are compared with the exact ones")
      ->check(CLI::Range(1, 100'000));
  app.add_option("--budget", config.budget_pct,
                 "p99 depth error that a grid may have at most, % of the object's diagonal")
      ->check(CLI::Range(0.01, 10.0));
  app.add_option("--error", config.our_error_pct, "p99 depth error that our maps may have at most, the same")
      ->check(CLI::Range(0.01, 10.0));
  app.add_flag("--crowds", config.crowds, "also fields among 1 to 1000 objects");
  app.add_option("--methods", config.methods, "which, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(mechane::benchmark::known_methods()));
  CLI11_PARSE(app, argc, argv);
  return mechane::benchmark::main_of(config);
}
