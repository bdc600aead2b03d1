#include "server/base/error.hpp"

#include <array>

namespace mechane {

std::string_view name_of(ErrorCode code) {
  static constexpr std::array<std::string_view, static_cast<std::size_t>(kLastErrorCode) + 1> kNames{
      "invalid_value", "missing",   "unknown_name", "duplicate",      "conflict",
      "too_large",     "not_found", "io_failure",   "damaged",        "wrong_version",
      "not_supported", "busy",      "timed_out",    "failed_process", "cancelled"};
  return kNames[static_cast<std::size_t>(code)];
}

}  // namespace mechane
