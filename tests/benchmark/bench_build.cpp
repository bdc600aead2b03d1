// How long things take to be built for touch: each exhibit as a server's first start builds it and as its next one reads it, and a closed
// and a scanned ball of ever more triangles.
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "server/app/scenario_store.hpp"
#include "server/collision_build/object_builder.hpp"
#include "server/log/log.hpp"
#include "tests/benchmark/bench_stats.hpp"
#include "tests/support/open_meshes.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::benchmark {
namespace {

constexpr std::array<std::size_t, 7> kTriangles = {1'000, 3'000, 10'000, 30'000, 100'000, 300'000, 1'000'000};
constexpr double kHeld_m = 0.2;   // the diagonal of a ball
constexpr double kNoise = 0.2;    // of the way between neighbours
constexpr double kGaps = 0.02;    // of the triangles of a scan
constexpr double kTurned = 0.05;  // of them
constexpr std::uint64_t kSeed = 1;

struct Took {
  double clock_s = 0, cpu_s = 0;
};

double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <class Work>
Took time_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  const double start_cpu_s = cpu_s();
  work();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), cpu_s() - start_cpu_s};
}

struct TookTwice {
  Took cold, warm;
};

/// Makes all that an exhibit's bodies need: with nothing kept from before, and once more from what that has left.
Expected<TookTwice> build_exhibit(const std::filesystem::path& scenario) {
  const test::ScratchFolder cache;
  app::Settings settings;
  settings.scenarios = {scenario};
  settings.cache = cache.path();
  TookTwice took;
  for (Took* one : {&took.cold, &took.warm}) {
    Expected<void> read;
    *one = time_of([&] {
      if (auto store = app::ScenarioStore::load(settings); !store) read = tl::unexpected(store.error());
    });
    if (!read) return tl::unexpected(read.error());
  }
  return took;
}

geometry::Mesh held(geometry::Mesh mesh) {
  const double scale = kHeld_m / mesh.bounds().diagonal().norm();
  for (Vec3& v : mesh.vertices)
    v *= scale;
  return mesh;
}

/// A ball as a scanner gives it: with noise, gaps and turned faces.
geometry::Mesh scanned(const geometry::Mesh& closed) {
  const double apart_m = kHeld_m / std::sqrt(static_cast<double>(closed.triangles.size()));
  geometry::Mesh scan = test::with_noise(closed, kNoise * apart_m, kSeed);
  return test::with_turned(test::with_gaps(std::move(scan), kGaps, kSeed), kTurned, kSeed);
}

/// `triangles`: about as many as the mesh has.
Expected<void> time_ball(const std::string& kind, std::size_t triangles, const geometry::Mesh& mesh, Report& report) {
  std::vector<geometry::NamedMesh> parts;
  parts.push_back({kind, mesh});
  Expected<collision::Object> object;
  const Took took = time_of([&] { object = collision_build::build_object(parts, {}); });
  if (!object) return tl::unexpected(object.error());
  const std::string name = kind + "." + std::to_string(triangles);
  std::cerr << "bench_build: " << name << " in " << took.clock_s << " s\n";
  report.metric("build_s." + name, took.clock_s);
  report.metric("build_cpu_s." + name, took.cpu_s);
  return {};
}

Expected<void> run(const std::vector<std::filesystem::path>& scenarios, std::size_t most, Report& report) {
  Took all;
  for (const std::filesystem::path& scenario : scenarios) {
    const auto took = build_exhibit(scenario);
    if (!took) return tl::unexpected(took.error());
    const std::string name = scenario.stem().string();
    std::cerr << "bench_build: " << name << " in " << took->cold.clock_s << " s\n";
    report.metric("build_s.exhibit." + name, took->cold.clock_s);
    report.metric("build_cpu_s.exhibit." + name, took->cold.cpu_s);
    report.metric("warm_s.exhibit." + name, took->warm.clock_s);
    all = {all.clock_s + took->cold.clock_s, all.cpu_s + took->cold.cpu_s};
  }
  if (!scenarios.empty()) {
    report.metric("build_s.exhibits", all.clock_s);
    report.metric("build_cpu_s.exhibits", all.cpu_s);
  }
  for (const std::size_t triangles : kTriangles) {
    if (triangles > most) break;
    const auto around = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(triangles))));
    const geometry::Mesh closed = held(test::bumpy_ball(around));
    if (auto ok = time_ball("closed", triangles, closed, report); !ok) return ok;
    if (auto ok = time_ball("scan", triangles, scanned(closed), report); !ok) return ok;
  }
  return {};
}

}  // namespace
}  // namespace mechane::benchmark

int main(int argc, char** argv) {
  std::vector<std::filesystem::path> scenarios;
  std::size_t most = 1'000'000;
  CLI::App app{"Time to build exhibits for touch from nothing, and balls of ever more triangles"};
  app.add_option("scenarios", scenarios, "X3D files of exhibits")->check(CLI::ExistingFile);
  app.add_option("--most", most, "triangles of the largest ball; 0: no balls");
  CLI11_PARSE(app, argc, argv);
  mechane::log::start("bench_build", mechane::log::Level::warning);
  mechane::benchmark::Report report;
  if (const auto ok = mechane::benchmark::run(scenarios, most, report); !ok) {
    std::cerr << "bench_build: " << ok.error().to_string() << "\n";
    return 2;
  }
  std::cout << report.text() << "\n";
  return 0;
}
