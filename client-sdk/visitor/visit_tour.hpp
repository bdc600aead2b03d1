// Plays every visit of several scenarios, each scenario at a kiosk of its own, some or all at once.
#pragma once

#include <csignal>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "client-sdk/visitor/visit_session.hpp"

namespace mechane::visitor {

/// The result of one scenario's visits.
struct TourStop {
  std::filesystem::path scenario;
  Expected<VisitReport> report;
  [[nodiscard]] bool complete() const { return report && report->complete(); }
};

/// The scenario files (*.x3d) among `places` and, in order of their names, in the folders among them, at any depth.
/// Errors: a place that is not there, a folder that cannot be read, no scenario at all, two files of the same name,
/// which would share a kiosk.
[[nodiscard]] Expected<std::vector<std::filesystem::path>> find_scenarios(
    std::span<const std::filesystem::path> places);

/// Plays all visits of each scenario at a kiosk named after its file, `at_once` (at least one) at a time, each in a
/// thread of its own. `common` holds all options but scenario and kiosk. Returns when all have ended, in the order of
/// the scenarios. Any thread.
[[nodiscard]] std::vector<TourStop> run_tour(const VisitOptions& common,
                                             std::span<const std::filesystem::path> scenarios, std::size_t at_once,
                                             const volatile std::sig_atomic_t& stop);

/// A line for each visit: scenario, visit, how many steps were done, seconds, and where it stopped if it did.
[[nodiscard]] std::string tour_table(std::span<const TourStop> stops);

/// The stops' reports as JSON; in place of a missing report, its error.
[[nodiscard]] std::string to_json(std::span<const TourStop> stops);

}  // namespace mechane::visitor
