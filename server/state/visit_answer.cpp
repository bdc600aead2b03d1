#include "server/state/visit_answer.hpp"

#include <algorithm>
#include <charconv>

namespace mechane::state {
namespace {

/// Removes a beginning from a text. False where the text begins otherwise; it then stays as it was.
bool take(std::string_view& text, std::string_view beginning) {
  if (!text.starts_with(beginning)) return false;
  text.remove_prefix(beginning.size());
  return true;
}

std::optional<std::uint32_t> index_of(const QuestionDescription& question, std::string_view answer) {
  if (question.kind == QuestionDescription::Kind::choice) {
    const auto it = std::find_if(question.answers.begin(), question.answers.end(),
                                 [&](const auto& possible) { return possible.name == answer; });
    if (it == question.answers.end()) return std::nullopt;
    return static_cast<std::uint32_t>(it - question.answers.begin());
  }
  std::uint32_t mark = 0;
  const auto [end, error] = std::from_chars(answer.data(), answer.data() + answer.size(), mark);
  const bool whole = error == std::errc() && end == answer.data() + answer.size();
  if (!whole || mark < 1 || mark > static_cast<std::uint32_t>(question.marks)) return std::nullopt;
  return mark;
}

}  // namespace

std::optional<VisitAnswer> parse_visit_answer(std::string_view argument, const WorldDescription& world) {
  VisitAnswer out;
  const bool after = take(argument, "after:");
  if (!after && !take(argument, "before:")) return std::nullopt;
  out.when = after ? AnswerTime::after : AnswerTime::before;
  // Names may contain "/" and "=": so try each known name, instead of splitting the text at the signs.
  for (std::size_t a = 0; a < world.activities.size(); ++a) {
    std::string_view rest = argument;
    if (!take(rest, world.activities[a].name) || !take(rest, "/")) continue;
    const auto& questions = world.activities[a].questionnaire;
    for (std::size_t q = 0; q < questions.size(); ++q) {
      std::string_view answer = rest;
      if (!take(answer, questions[q].name) || !take(answer, "=")) continue;
      const auto index = index_of(questions[q], answer);
      if (!index) continue;
      out.activity = ActivityId(a);
      out.question = static_cast<std::uint32_t>(q);
      out.answer = *index;
      return out;
    }
  }
  return std::nullopt;
}

}  // namespace mechane::state
