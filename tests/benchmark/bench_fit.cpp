// Whether the fit finds a superquadric again: random shapes, 2000 points each, without noise, with noise, with outliers; and how long
// one whole fit takes.
#include <algorithm>
#include <array>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "server/base/parallel.hpp"
#include "server/geometry/fitting/fit.hpp"
#include "tests/benchmark/bench_stats.hpp"
#include "tests/support/superquadric_draw.hpp"

namespace mechane::benchmark {
namespace {

constexpr std::size_t kPoints = 2000;
constexpr std::size_t kJudges = 2000;  // points that measure the distance between two surfaces, each way
constexpr int kCells = 32;  // of a tessellation's edge: its chords are 0.05 % of the diagonal off, most of them less
constexpr double kRecoveredPct = 1;

struct Set {
  const char* name;
  double noise_pct;
  double outliers;
};
constexpr std::array<Set, 4> kSets = {{{"noise0", 0, 0}, {"noise1", 1, 0}, {"noise3", 3, 0}, {"outliers20", 0, 0.2}}};

struct Config {
  std::size_t count = 1000;
  std::uint64_t seed = 1;
  std::string noise = "all";
  bool failures = false;
};

struct Judged {
  double off_pct = 100;  // the larger of the two mean distances
  Duration took{};
  geometry::FitResult fit;
};

std::uint64_t seed_of(const Config& config, std::size_t index) {
  return config.seed * 1'000'003 + index;
}

Judged judge(std::size_t index, const Set& set, const Config& config) {
  const std::uint64_t seed = seed_of(config, index);
  const test::PlacedSuperquadric truth = test::draw_superquadric(seed);
  const geometry::Mesh mesh = test::placed_mesh(truth, kCells);
  std::vector<Vec3> points = test::points_on(truth, mesh, kPoints, seed);
  test::disturb(points, 0.01 * set.noise_pct * mesh.bounds().diagonal().norm(), set.outliers, seed ^ 0x5555);

  geometry::FitConfig fit_config;
  fit_config.robust = true;
  fit_config.bound = false;
  fit_config.deformation_gain = 0.02;
  Judged judged;
  SystemClock clock;
  const Duration began = clock.thread_cpu_time();
  const auto fit = geometry::fit_superquadric(points, fit_config);
  judged.took = clock.thread_cpu_time() - began;
  if (!fit) return judged;
  judged.fit = *fit;
  judged.off_pct = test::surface_difference_pct(truth, {fit->shape, fit->X_OQ}, kCells, kJudges);
  return judged;
}

std::string text_of(const geometry::Superquadric& s) {
  std::string text;
  const double longest = s.a.maxCoeff();
  for (const double v : {s.a.x() / longest, s.a.y() / longest, s.a.z() / longest, s.e1, s.e2, s.taper_x, s.taper_y,
                         s.bend_per_m * 2 * s.a.z(), s.bend_angle_rad}) {
    text += std::to_string(v).substr(0, 5) + " ";
  }
  return text;
}

void run_set(const Set& set, const Config& config, Report& report, Samples& times) {
  std::vector<Judged> judged(config.count);
  for_each_index(config.count, [&](std::size_t i) { judged[i] = judge(i, set, config); });
  std::size_t recovered = 0;
  double sum = 0;
  Samples own(config.count);
  for (std::size_t i = 0; i < judged.size(); ++i) {
    const Judged& one = judged[i];
    recovered += one.off_pct < kRecoveredPct ? 1 : 0;
    sum += std::min(10.0, one.off_pct);
    times.add(one.took);
    own.add(one.took);
    if (!config.failures || one.off_pct < kRecoveredPct) continue;
    std::cerr << set.name << " " << i << " off " << one.off_pct << " % sampled error " << one.fit.report.mean_pct
              << "\n  true  " << text_of(test::draw_superquadric(seed_of(config, i)).shape) << "\n  found "
              << text_of(one.fit.shape) << " " << one.fit.report.start << "\n";
  }
  const auto count = static_cast<double>(config.count);
  const std::string name = set.name;
  report.metric("fit.recovered_pct." + name, 100 * static_cast<double>(recovered) / count);
  report.metric("fit.mean_off_pct." + name, sum / count);
  report.metric("fit.ms.median." + name, 1e-3 * own.quantile_us(0.5));
  report.metric("fit.ms.p99." + name, 1e-3 * own.quantile_us(0.99));
}

void describe_draw(Report& report, const Config& config) {
  report.note("fit: " + std::to_string(config.count) +
              " superquadrics, the same for each set; semi-axes uniform in 1 to 8, exponents uniform in 0.1 to 1.9; "
              "half of them with "
              "taper, both ways uniform in -0.6 to 0.6; half of them with a bend, from one end to the other uniform in "
              "0 to 90 degrees, in "
              "any direction; both drawn independently, folded shapes drawn again; any pose");
  report.note(
      "fit: 2000 points spread by area; Gaussian noise of 0, 1, 3 % of the diagonal in x, y, z; outliers are a fifth "
      "of the points, "
      "put anywhere in a box of twice the part's sides");
  report.note(
      "fit: recovered when the mean distance from the true to the fitted surface, and back, is below 1 % of the "
      "diagonal; the "
      "same settings for all sets; times are the thread's CPU time");
}

int main_of(const Config& config) {
  Report report;
  Samples times(config.count * kSets.size());
  bool known = false;
  for (const Set& set : kSets) {
    if (config.noise != "all" && config.noise != set.name) continue;
    known = true;
    run_set(set, config, report, times);
  }
  if (!known) {
    std::cerr << "bench_fit: no set '" << config.noise << "': all, noise0, noise1, noise3 or outliers20\n";
    return 1;
  }
  report.metric("fit.ms.median", 1e-3 * times.quantile_us(0.5));
  report.metric("fit.ms.p99", 1e-3 * times.quantile_us(0.99));
  report.metric("fit.count", static_cast<double>(config.count));
  describe_draw(report, config);
  std::cout << report.text() << "\n";
  return 0;
}

}  // namespace
}  // namespace mechane::benchmark

int main(int argc, char** argv) {
  mechane::benchmark::Config config;
  CLI::App app{"Fits superquadrics to points of random superquadrics: how many are found again, and how long it takes"};
  app.add_option("--count", config.count, "shapes of each set")->check(CLI::Range(1, 1'000'000));
  app.add_option("--seed", config.seed, "other shapes");
  app.add_option("--noise", config.noise, "all, noise0, noise1, noise3 or outliers20");
  app.add_flag("--failures", config.failures, "write each shape that was not found to stderr");
  CLI11_PARSE(app, argc, argv);
  return mechane::benchmark::main_of(config);
}
