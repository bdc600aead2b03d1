// Every visit of several scenarios: each scenario at a kiosk of its own, some or all at once.
#pragma once

#include <csignal>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "client-sdk/visitor/visit_session.hpp"

namespace mechane::visitor {

/// What came of one scenario's visits.
struct TourStop {
  std::filesystem::path scenario;
  Expected<VisitReport> report;
  [[nodiscard]] bool complete() const { return report && report->complete(); }
};

/// The scenario files (*.x3d) among `places` and, in order of their names, in the folders among them, at any depth. Errors: a place
/// that is not there, a folder that cannot be read, no scenario at all, two files of one name: their kiosks would be one.
[[nodiscard]] Expected<std::vector<std::filesystem::path>> find_scenarios(
    std::span<const std::filesystem::path> places);

/// Plays all visits of each scenario at kiosks that are named as the files, `at_once` kiosks at a time (at least one), in a thread
/// for each. `common` holds all but scenario and kiosk. Returns when all are through, in the order of the scenarios. Any thread.
[[nodiscard]] std::vector<TourStop> run_tour(const VisitOptions& common,
                                             std::span<const std::filesystem::path> scenarios, std::size_t at_once,
                                             const volatile std::sig_atomic_t& stop);

/// A line for each visit: scenario, visit, how many steps were done, seconds, and where it stopped if it did.
[[nodiscard]] std::string tour_table(std::span<const TourStop> stops);

/// The stops' reports as JSON, an error in place of a report that is not there.
[[nodiscard]] std::string to_json(std::span<const TourStop> stops);

}  // namespace mechane::visitor
