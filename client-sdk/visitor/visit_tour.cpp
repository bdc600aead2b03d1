#include "client-sdk/visitor/visit_tour.hpp"

#include <algorithm>
#include <atomic>
#include <system_error>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mechane::visitor {
namespace {

namespace fs = std::filesystem;

Expected<void> add_folder(const fs::path& folder, std::vector<fs::path>& found) {
  std::error_code error;
  const std::size_t before = found.size();
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->path().extension() == ".x3d") found.push_back(it->path());
  }
  if (error)
    return fail(ErrorCode::io_failure, "the folder cannot be read: " + error.message(), folder.string(),
                "check its permissions");
  std::sort(found.begin() + static_cast<std::ptrdiff_t>(before), found.end());
  return {};
}

std::string steps_of(const ActivityReport& activity) {
  const auto done =
      std::count_if(activity.steps.begin(), activity.steps.end(), [](const StepTime& s) { return s.done; });
  return fmt::format("{}/{}", done, activity.steps.size());
}

std::string outcome_of(const ActivityReport& activity) {
  if (activity.done) {
    return activity.warm_share > 0 ? fmt::format("done, motors spared {:.1f} % of the time", 100 * activity.warm_share)
                                   : "done";
  }
  if (!activity.reason.empty()) return activity.reason;
  return activity.steps.empty() ? "not begun" : "stopped at " + activity.steps.back().name;
}

void play(const VisitOptions& common, TourStop& one, const volatile std::sig_atomic_t& stop) {
  VisitOptions options = common;
  options.scenario = one.scenario;
  options.client.kiosk = one.scenario.stem().string();
  options.names_kiosk = true;
  one.report = run_visit(options, stop);
}

}  // namespace

Expected<std::vector<fs::path>> find_scenarios(std::span<const fs::path> places) {
  std::vector<fs::path> found;
  for (const fs::path& place : places) {
    std::error_code error;
    if (fs::is_directory(place, error)) {
      if (auto added = add_folder(place, found); !added) return tl::unexpected(added.error());
    } else if (fs::exists(place, error)) {
      found.push_back(place);
    } else {
      return fail(ErrorCode::not_found, "the file or folder does not exist", place.string(),
                  "name X3D files, or folders that contain them");
    }
  }
  if (found.empty()) {
    return fail(ErrorCode::not_found, "there is no scenario here", places.empty() ? "" : places.front().string(),
                "name X3D files, or folders that contain them");
  }
  std::vector<std::string> names;
  for (const fs::path& file : found) {
    if (std::ranges::find(names, file.stem().string()) != names.end())
      return fail(ErrorCode::duplicate, "another scenario has the same file name", file.string(),
                  "rename one of them: each kiosk is named after its scenario's file");
    names.push_back(file.stem().string());
  }
  return found;
}

std::vector<TourStop> run_tour(const VisitOptions& common, std::span<const fs::path> scenarios, std::size_t at_once,
                               const volatile std::sig_atomic_t& stop) {
  std::vector<TourStop> stops;
  for (const fs::path& scenario : scenarios)
    stops.push_back({scenario, VisitReport{}});
  {
    std::atomic<std::size_t> next = 0;
    std::vector<std::jthread> visitors;
    for (std::size_t i = 0; i < std::max<std::size_t>(1, std::min(at_once, stops.size())); ++i) {
      visitors.emplace_back([&] {
        for (std::size_t mine = next++; mine < stops.size(); mine = next++)
          play(common, stops[mine], stop);
      });
    }
  }
  return stops;
}

std::string tour_table(std::span<const TourStop> stops) {
  std::string table;
  for (const TourStop& stop : stops) {
    const std::string name = stop.scenario.stem().string();
    if (!stop.report) {
      table += fmt::format("{:<22}  {}\n", name, stop.report.error().to_string());
      continue;
    }
    for (const ActivityReport& activity : stop.report->activities) {
      table += fmt::format("{:<22}  {:<22}  {:>5} steps  {:>6.1f} s  {}\n", name, activity.visit, steps_of(activity),
                           activity.seconds, outcome_of(activity));
    }
  }
  return table;
}

std::string to_json(std::span<const TourStop> stops) {
  nlohmann::json all = nlohmann::json::array();
  for (const TourStop& stop : stops) {
    nlohmann::json one = stop.report ? nlohmann::json::parse(to_json(*stop.report))
                                     : nlohmann::json{{"error", stop.report.error().to_string()}, {"complete", false}};
    one["scenario"] = stop.scenario.string();
    all.push_back(std::move(one));
  }
  return all.dump(2) + "\n";
}

}  // namespace mechane::visitor
