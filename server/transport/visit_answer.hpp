// A visitor's answer to a question of an activity, as it comes with a command.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "server/state/description.hpp"

namespace mechane::transport {

/// Held against the scenario; indices are into its description.
struct VisitAnswer {
  ActivityId activity;
  std::uint32_t question = 0;  ///< of the activity
  std::uint32_t answer = 0;    ///< choice: index of the answer; scale: the mark, from 1 on
  bool after = false;          ///< the activity; else before it
};

/// Reads "WHEN:ACTIVITY/QUESTION=ANSWER". None where the scenario has no such activity, question or answer. Any thread.
[[nodiscard]] std::optional<VisitAnswer> read_answer(std::string_view argument, const state::WorldDescription& world);

}  // namespace mechane::transport
