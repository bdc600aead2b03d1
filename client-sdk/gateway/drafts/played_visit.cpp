#include "client-sdk/gateway/drafts/played_visit.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace mechane::gateway {
namespace {

using ReportJson = nlohmann::json;

constexpr std::size_t kLastLines = 5;
/// After its last move, for an exhibit that goes on by itself.
constexpr const char* kPatience_s = "20";

ReportJson without_report(const std::vector<std::string>& said) {
  const auto from = said.end() - static_cast<std::ptrdiff_t>(std::min(kLastLines, said.size()));
  return {{"state", "failed"},
          {"moves", ReportJson::array()},
          {"reason", fmt::format("{}", fmt::join(from, said.end(), "\n"))}};
}

}  // namespace

Expected<PlayedVisit> PlayedVisit::start(const std::filesystem::path& program, const VisitOrder& order,
                                         std::function<void()> ended) {
  const std::vector<std::string> arguments{"--scenario", order.scenario.string(),
                                           "--domain",   std::to_string(order.domain),
                                           "--kiosk",    order.kiosk,
                                           "--visit",    order.visit,
                                           "--patience", kPatience_s};
  auto process = PreviewProcess::start(program, arguments, std::move(ended), kLinesKept);
  if (!process) return tl::unexpected(process.error());
  PlayedVisit played;
  played.visit_ = order.visit;
  played.process_ = std::move(*process);
  return played;
}

std::unique_ptr<PreviewProcess> PlayedVisit::end() {
  if (process_) process_->end();
  return std::move(process_);
}

void PlayedVisit::note_end() {
  if (!process_) return;
  said_ = process_->said();
  process_.reset();
}

nlohmann::json PlayedVisit::to_json() const {
  ReportJson out = process_ ? ReportJson{{"state", "playing"}} : read_visit_report(said_);
  out["name"] = visit_;
  return out;
}

nlohmann::json read_visit_report(const std::vector<std::string>& said) {
  const auto begin = std::find(said.rbegin(), said.rend(), "{");
  if (begin == said.rend()) return without_report(said);
  const ReportJson report =
      ReportJson::parse(fmt::format("{}", fmt::join(begin.base() - 1, said.end(), "\n")), nullptr, false);
  if (!report.is_object() || !report.contains("activities") || report["activities"].empty())
    return without_report(said);
  const ReportJson& activity = report["activities"].front();
  ReportJson moves = ReportJson::array();
  for (const ReportJson& move : activity.value("moves", ReportJson::array()))
    moves.push_back(
        {{"name", move.value("name", "")}, {"ok", move.value("ok", false)}, {"reason", move.value("reason", "")}});
  return {{"state", activity.value("done", false) ? "done" : "incomplete"},
          {"moves", std::move(moves)},
          {"reason", activity.value("reason", "")}};
}

}  // namespace mechane::gateway
