// What operators have ordered and what must outlast a restart: opening hours, messages to visitors, maintenance, changes
// that end by themselves. One JSON file. Times are seconds since 1970.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client-sdk/gateway/operations/opening_hours.hpp"
#include "server/base/error.hpp"

namespace mechane::gateway {

struct VisitorMessage {
  std::uint64_t id = 0;
  std::vector<std::string> kiosks;           ///< empty: all of them
  std::map<std::string, std::string> texts;  ///< by language: "el", "en"
  std::int64_t until = 0;
  friend bool operator==(const VisitorMessage&, const VisitorMessage&) = default;
};

/// One setting of a kiosk's displays, or its exhibit, that returns to what was before.
struct TimedChange {
  std::uint64_t id = 0;
  std::string kiosk;
  std::string name;                           ///< of the setting; "exhibit": the kiosk's exhibit
  std::string value;                          ///< until then
  std::map<std::string, std::string> before;  ///< by display; of an exhibit, by ""
  std::int64_t until = 0;
  friend bool operator==(const TimedChange&, const TimedChange&) = default;
};

struct OperationsState {
  static constexpr std::size_t kMostMessages = 50;
  static constexpr std::size_t kMostChanges = 500;
  static constexpr std::size_t kMostInMaintenance = 200;
  std::uint64_t next_id = 1;
  OpeningHours hours;
  std::vector<VisitorMessage> messages;                            ///< oldest first
  std::map<std::string, std::optional<std::int64_t>> maintenance;  ///< by kiosk: its end; none: by hand
  std::vector<TimedChange> changes;
  friend bool operator==(const OperationsState&, const OperationsState&) = default;
};

/// Errors: damaged.
[[nodiscard]] Expected<OperationsState> parse_operations(std::string_view text);
[[nodiscard]] std::string operations_text(const OperationsState& state);

/// When something ends: {"minutes": 30} or {"until": "18:30"} (the next time that the clock shows it) of a request; none
/// where it has neither. Errors: invalid_value, with the field.
[[nodiscard]] Expected<std::optional<std::int64_t>> parse_end(std::string_view json, std::int64_t now);
/// {"texts": {"el": ..., "en": ...}, "kiosks": [...], "minutes" or "until"} of a request, without an id. Errors:
/// invalid_value, with the field.
[[nodiscard]] Expected<VisitorMessage> parse_visitor_message(std::string_view json, std::int64_t now);

/// What the displays of a kiosk should show now, as settings by name.
struct KioskTarget {
  bool open = true;           ///< by the opening hours
  std::string sign = "none";  ///< none, closed, maintenance
  std::string message_el, message_en;
  friend bool operator==(const KioskTarget&, const KioskTarget&) = default;
};
[[nodiscard]] KioskTarget target_of(const OperationsState& state, const std::string& kiosk, std::int64_t now);
[[nodiscard]] bool in_maintenance(const OperationsState& state, const std::string& kiosk, std::int64_t now);

/// Adds a change. It replaces one of the same kiosk and name, and keeps that one's value to return to.
[[nodiscard]] Expected<void> add_change(OperationsState& state, TimedChange change);
/// Without messages and maintenance that have ended; changes stay until they were taken back.
[[nodiscard]] OperationsState without_ended(OperationsState state, std::int64_t now);

/// The store. Not thread-safe: on the loop's thread.
class Operations {
 public:
  /// Errors: io_failure, damaged.
  [[nodiscard]] static Expected<Operations> open(const std::filesystem::path& folder);
  [[nodiscard]] const OperationsState& state() const { return state_; }
  /// Writes the file in one step, where something is different. Errors, with nothing changed: io_failure.
  [[nodiscard]] Expected<void> change(OperationsState next);

 private:
  explicit Operations(std::filesystem::path file) : file_(std::move(file)) {}
  std::filesystem::path file_;
  OperationsState state_;
};

}  // namespace mechane::gateway
