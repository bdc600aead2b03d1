// A scripted visitor in a draft that is tried: a child process, and what it reports.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "client-sdk/gateway/drafts/preview_process.hpp"

namespace mechane::gateway {

/// Where it goes, and what it plays there.
struct VisitOrder {
  std::filesystem::path scenario;
  std::uint32_t domain = 0;
  std::string kiosk;
  std::string visit;
};

/// On the loop's thread, as its PreviewDesk.
class PlayedVisit {
 public:
  static constexpr std::size_t kLinesKept = 4000;  ///< a report of the longest visit

  /// `ended` as of PreviewProcess. Errors: failed_process.
  [[nodiscard]] static Expected<PlayedVisit> start(const std::filesystem::path& program, const VisitOrder& order,
                                                   std::function<void()> ended);
  /// Asks it to go, and returns what has to be kept until it has gone; null where it has gone already.
  [[nodiscard]] std::unique_ptr<PreviewProcess> end();
  [[nodiscard]] bool plays() const { return process_ != nullptr; }
  /// It has gone: keeps what it has reported.
  void note_end();
  /// COMMANDS.md: `visit` of a preview.
  [[nodiscard]] nlohmann::json to_json() const;

 private:
  std::string visit_;
  std::unique_ptr<PreviewProcess> process_;  ///< null: it has gone
  std::vector<std::string> said_;
};

/// What the last lines of a visitor tell: {state, moves, reason}; the report follows whatever it said before. Pure.
[[nodiscard]] nlohmann::json read_visit_report(const std::vector<std::string>& said);

}  // namespace mechane::gateway
