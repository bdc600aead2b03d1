// Sheets for tests.
#pragma once

#include <rapidcheck.h>

#include "server/visits/visit_sheet.hpp"

namespace mechane::visits {

inline VisitSheet plain_sheet(std::int64_t minute = 29'000'000) {
  VisitSheet sheet;
  sheet.number = new_visit_number();
  sheet.kiosk = "kiosk-1";
  sheet.scenario = "machine";
  sheet.scenario_hash = "hash";
  sheet.activity = "use";
  sheet.minute = minute;
  sheet.duration_s = 12.5;
  sheet.hands = 1;
  sheet.ending = VisitEnding::done;
  sheet.steps = {{"take", 4.5, StepEnding::done, false, true}, {"turn", 8, StepEnding::done, true, true}};
  sheet.mistakes = {{MistakeKind::let_go, "STONE", 2}};
  sheet.answers = {{"why", AnswerTime::before, "wind", 0, 0, false}, {"easy", AnswerTime::after, "", 4, 5, {}}};
  return sheet;
}

/// Any sheet that a server could write; texts are any bytes.
inline VisitSheet any_sheet() {
  const auto text = [] { return *rc::gen::container<std::string>(rc::gen::arbitrary<char>()); };
  const auto below = [](int n) { return *rc::gen::inRange(0, n); };
  VisitSheet sheet;
  sheet.number = new_visit_number();
  sheet.kiosk = text();
  sheet.scenario = text();
  sheet.scenario_hash = text();
  sheet.activity = text();
  sheet.language = text();
  sheet.minute = below(100'000'000);
  sheet.duration_s = 1e-3 * below(100'000'000);
  sheet.from_start = below(2) == 1;
  sheet.hands = static_cast<std::uint32_t>(below(5));
  sheet.ending = static_cast<VisitEnding>(below(4));
  sheet.went_on_to = text();
  sheet.notes_lost = static_cast<std::uint32_t>(below(1000));
  for (int i = below(4); i > 0; --i)
    sheet.steps.push_back(
        {text(), 1e-3 * below(1'000'000), static_cast<StepEnding>(below(4)), below(2) == 1, below(2) == 1});
  for (int i = below(4); i > 0; --i)
    sheet.mistakes.push_back(
        {static_cast<MistakeKind>(below(kMistakeKinds)), text(), static_cast<std::uint32_t>(below(1000))});
  for (int i = below(4); i > 0; --i) {
    const auto when = static_cast<AnswerTime>(below(2));
    const int marks = 1 + below(9);
    if (below(2) == 1) {
      sheet.answers.push_back({text(), when, "", 1 + below(marks), marks, {}});
    } else {
      sheet.answers.push_back({text(), when, text(), 0, 0, below(2) == 1});
    }
  }
  return sheet;
}

}  // namespace mechane::visits
