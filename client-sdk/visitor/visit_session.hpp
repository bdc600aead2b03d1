// One visitor at one kiosk: joins, plays the scenario's visits, and reports.
#pragma once

#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "client-sdk/haptic/haptic_loop.hpp"
#include "client-sdk/visitor/visit_player.hpp"
#include "server/state/description.hpp"
#include <mechane/client/client.hpp>

namespace mechane::visitor {

struct VisitOptions {
  client::ClientConfig client;
  std::filesystem::path scenario;       ///< the file that the visit is read from
  std::vector<std::string> visits;      ///< by name, in this order; empty: those of `activities`
  std::vector<std::string> activities;  ///< one visit of each, in this order; empty, and no visits: all visits
  PlayerConfig player;
  haptic::RenderMode render = haptic::RenderMode::server;
  Duration join_within = std::chrono::seconds(20);
  Duration done_within = std::chrono::seconds(60);  ///< how long after its last move an activity may take to be done
  Duration linger = std::chrono::seconds(1);  ///< how long a visitor stays where a sign sent it, before it goes home
  bool names_kiosk = false;                   ///< on stdout, where several play at once
  bool endless = false;                       ///< begins again when it is through: load and attract mode
};

struct StepTime {
  std::string name;
  double seconds = 0;
  bool done = false;
};

struct ActivityReport {
  std::string name;
  std::string visit;  ///< which of its visits
  bool done = false;
  double seconds = 0;
  std::string reason;      ///< why it is not done, with visit and step; empty where it is
  std::string gone_on_to;  ///< the scenario that a sign of the visit opened; empty: none
  std::vector<StepTime> steps;
  std::vector<MoveResult> moves;
};

struct VisitReport {
  std::string kiosk;
  std::string world;
  std::vector<ActivityReport> activities;
  std::vector<std::pair<std::string, double>> quantities;  ///< at the end, by name
  double water_l = 0;  ///< what pumps lifted, the quantity `lifted`, where the world has one
  haptic::LoopStats loop;
  realtime::LatencyHistogram round_trip;
  [[nodiscard]] bool complete() const;
};

/// The report as JSON; the names in it are stable.
[[nodiscard]] std::string to_json(const VisitReport& report);

/// Which visits of the scenario are played. Errors: a name that it does not have, with those that it has; it has none.
[[nodiscard]] Expected<std::vector<const state::VisitDescription*>> choose_visits(const VisitOptions& options,
                                                                                  const state::WorldDescription& world);

/// Plays the visit with a virtual device at 1 kHz, on the calling thread, and tells on stdout where it is. `stop` is looked at in each
/// tick. Errors: the scenario cannot be read, it has no visit for an activity, the kiosk could not be joined or was refused.
[[nodiscard]] Expected<VisitReport> run_visit(const VisitOptions& options, const volatile std::sig_atomic_t& stop);

}  // namespace mechane::visitor
