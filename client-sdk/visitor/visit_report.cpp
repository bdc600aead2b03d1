// The visitor's report as JSON.
#include <nlohmann/json.hpp>

#include "client-sdk/visitor/visit_session.hpp"
#include "server/realtime/quantiles_json.hpp"

namespace mechane::visitor {
namespace {

nlohmann::json activity_json(const ActivityReport& activity, const std::string& kiosk) {
  nlohmann::json steps = nlohmann::json::array();
  for (const StepTime& step : activity.steps)
    steps.push_back({{"name", step.name}, {"seconds", step.seconds}, {"done", step.done}});
  nlohmann::json moves = nlohmann::json::array();
  for (const MoveResult& move : activity.moves)
    moves.push_back({{"name", move.name}, {"seconds", move.seconds}, {"ok", move.ok}, {"reason", move.reason}});
  return {{"kiosk", kiosk},
          {"name", activity.name},
          {"visit", activity.visit},
          {"done", activity.done},
          {"reason", activity.reason},
          {"seconds", activity.seconds},
          {"warm_share", activity.warm_share},
          {"steps", std::move(steps)},
          {"moves", std::move(moves)},
          {"gone_on_to", activity.gone_on_to}};
}

}  // namespace

std::string to_json(const VisitReport& report) {
  nlohmann::json activities = nlohmann::json::array();
  for (const ActivityReport& activity : report.activities)
    activities.push_back(activity_json(activity, report.kiosk));
  nlohmann::json quantities = nlohmann::json::object();
  for (const auto& [name, value] : report.quantities)
    quantities[name] = value;
  const haptic::LoopStats& loop = report.loop;
  nlohmann::json force_n = {{"ticks", loop.ticks_with_force}};
  if (loop.ticks > 0) force_n["max"] = loop.force_max_n;
  if (loop.ticks_with_force > 0) force_n["mean"] = loop.force_sum_n / static_cast<double>(loop.ticks_with_force);
  nlohmann::json json = {{"kiosk", report.kiosk},
                         {"world", report.world},
                         {"complete", report.complete()},
                         {"activities", std::move(activities)},
                         {"quantities", std::move(quantities)},
                         {"force_n", std::move(force_n)},
                         {"holding_ticks", loop.holding_ticks},
                         {"samples", {{"sent", loop.sent}, {"answers", loop.answers}, {"ticks", loop.ticks}}},
                         {"rtt_us", realtime::quantiles_json(report.round_trip)}};
  if (report.water_l) json["water_l"] = *report.water_l;
  return json.dump(2) + "\n";
}

}  // namespace mechane::visitor
