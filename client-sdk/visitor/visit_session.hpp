// One visitor at one kiosk: joins, plays the scenario's visits, and reports.
#pragma once

#include <csignal>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client-sdk/haptic/haptic_loop.hpp"
#include "client-sdk/haptic/virtual_hand.hpp"
#include "client-sdk/visitor/visit_player.hpp"
#include "server/state/description.hpp"
#include <mechane/client/client.hpp>

namespace mechane::visitor {

struct VisitOptions {
  client::ClientConfig client;
  std::filesystem::path scenario;       ///< the file with the visits
  std::vector<std::string> visits;      ///< names, in order; empty: those of `activities`
  std::vector<std::string> activities;  ///< one visit of each, in order; all visits where this and `visits` are empty
  PlayerConfig player;
  haptic::VirtualChoice device;  ///< of the kind that `player` moves
  bool pointer = false;          ///< by a mouse before a display's picture, without any device
  haptic::RenderMode render = haptic::RenderMode::local;
  Duration join_within = std::chrono::seconds(20);
  Duration done_within = std::chrono::seconds(60);  ///< how long to wait after an activity's last move until it is done
  Duration linger = std::chrono::seconds(1);  ///< how long to stay at an exhibit that a sign opened, before going home
  bool names_kiosk = false;                   ///< lines on stdout begin with the kiosk, for several at once
  bool endless = false;                       ///< starts again after the last visit: for load tests and demonstrations
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
  double warm_share = 0;   ///< of the time, in which the force was lowered to spare the device's motors
  std::string reason;      ///< why it is not done, with visit and step; empty where it is done
  std::string gone_on_to;  ///< the scenario that a sign of the visit opened; empty: none
  std::vector<StepTime> steps;
  std::vector<MoveResult> moves;
};

struct VisitReport {
  std::string kiosk;
  std::string world;
  std::vector<ActivityReport> activities;
  std::vector<std::pair<std::string, double>> quantities;  ///< at the end, by name
  std::optional<double> water_l;  ///< what pumps lifted, the quantity `lifted`, where the world has one
  haptic::LoopStats loop;
  realtime::LatencyHistogram round_trip;
  [[nodiscard]] bool complete() const;
};

/// The report as JSON; the names in it are stable. What was not measured is left out.
[[nodiscard]] std::string to_json(const VisitReport& report);

/// Which visits of the scenario are played. Errors: an unknown name (the remedy lists the known ones), no visits at
/// all.
[[nodiscard]] Expected<std::vector<const state::VisitDescription*>> choose_visits(const VisitOptions& options,
                                                                                  const state::WorldDescription& world);

/// Plays the visits with a virtual device at 1 kHz or with a mouse, on the calling thread, and reports its progress on stdout. `stop`
/// is checked in each tick. Errors: the scenario cannot be read, it has no visit for an activity, the kiosk could not
/// be joined or was refused.
[[nodiscard]] Expected<VisitReport> run_visit(const VisitOptions& options, const volatile std::sig_atomic_t& stop);

}  // namespace mechane::visitor
