// What displays are told of a world at its start is limited: they refuse a world that has more of a kind.
#include <fmt/format.h>

#include "server/scenario/compilation.hpp"
#include "server/state/limits.hpp"

namespace mechane::scenario {
namespace {

using state::kMaxPresented;

/// `line_of` gives the line of the first that is too many.
template <class LineOf>
void check_count(Compilation& c, std::size_t count, const LineOf& line_of, const std::string& where, const char* what) {
  if (count <= kMaxPresented) return;
  c.problems.error(ErrorCode::too_large, line_of(kMaxPresented), where,
                   fmt::format("{} {} are too many: displays take {}", count, what, kMaxPresented),
                   fmt::format("remove {}", count - kMaxPresented));
}

/// More ropes act, and are not seen.
void check_ropes(Compilation& c) {
  std::size_t ropes = 0;
  for (const state::ComponentDescription& agent : c.world.agents) {
    if (agent.type != "geometry.rope" || ++ropes <= state::kMaxShownRopes) continue;
    c.problems.warning(ErrorCode::too_large, agent.line, "agent " + agent.name,
                       fmt::format("displays draw {} ropes, and this one is not seen", state::kMaxShownRopes),
                       "make one rope of several, or show it by a mesh");
  }
}

}  // namespace

void check_presented(Compilation& c) {
  const auto view_line = [&](std::size_t i) { return c.document[c.document.elements("Viewpoint")[i]].line; };
  const auto effect_line = [&](std::size_t i) { return tree_set(c, "effects")->children[i].line; };
  check_count(c, c.world.viewpoints.size(), view_line, "Viewpoint", "viewpoints");
  check_count(c, c.world.effects.size(), effect_line, "effects", "effects");
  const auto activity_line = [&](std::size_t i) { return c.activity_lines[i]; };
  check_count(c, c.world.activities.size(), activity_line, "activities", "activities");
  check_ropes(c);
  for (std::size_t a = 0; a < c.world.activities.size(); ++a) {
    const std::string where = "activity " + c.world.activities[a].name;
    const std::vector<state::QuestionDescription>& questions = c.world.activities[a].questionnaire;
    const std::vector<int>& lines = c.question_lines[a];
    check_count(
        c, questions.size(), [&](std::size_t i) { return lines[i]; }, where, "questions");
    for (std::size_t q = 0; q < questions.size(); ++q)
      check_count(
          c, questions[q].answers.size(), [&](std::size_t) { return lines[q]; },
          fmt::format("{}, question {}", where, questions[q].name), "answers");
  }
}

}  // namespace mechane::scenario
