// A visitor's answer to a question of an activity, as it comes with a command.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "server/state/description.hpp"

namespace mechane::state {

/// When a question is asked, seen from the activity.
enum class AnswerTime : std::uint8_t { before, after };

/// What a visitor answered, checked against the scenario: indices are into its description.
struct VisitAnswer {
  ActivityId activity;
  std::uint32_t question = 0;  ///< of the activity's questionnaire
  std::uint32_t answer = 0;    ///< choice: index of the answer; scale: the mark, from 1 on
  AnswerTime when = AnswerTime::after;
};

/// Reads "before:ACTIVITY/QUESTION=ANSWER", or "after:...". None where the scenario has no such activity, question or answer. Any thread.
[[nodiscard]] std::optional<VisitAnswer> parse_visit_answer(std::string_view argument, const WorldDescription& world);

}  // namespace mechane::state
