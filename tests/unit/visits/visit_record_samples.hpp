// Records of visits for tests.
#pragma once

#include <rapidcheck.h>

#include "server/visits/visit_record.hpp"

namespace mechane::visits {

inline VisitRecord plain_record(std::int64_t minute = 29'000'000) {
  VisitRecord record;
  record.number = new_visit_number();
  record.kiosk = "kiosk-1";
  record.scenario = "machine";
  record.scenario_hash = "hash";
  record.activity = "use";
  record.minute = minute;
  record.duration_s = 12.5;
  record.hands = 1;
  record.ending = VisitEnding::done;
  record.steps = {{"take", 4.5, StepEnding::done, false, true}, {"turn", 8, StepEnding::done, true, true}};
  record.mistakes = {{MistakeKind::let_go, "STONE", 2}};
  record.answers = {{"why", AnswerTime::before, "wind", 0, 0, false}, {"easy", AnswerTime::after, "", 4, 5, {}}};
  return record;
}

/// Any record that a server could write; texts are any bytes.
inline VisitRecord any_record() {
  const auto text = [] { return *rc::gen::container<std::string>(rc::gen::arbitrary<char>()); };
  const auto below = [](int n) { return *rc::gen::inRange(0, n); };
  VisitRecord record;
  record.number = new_visit_number();
  record.kiosk = text();
  record.scenario = text();
  record.scenario_hash = text();
  record.activity = text();
  record.language = text();
  record.minute = below(100'000'000);
  record.duration_s = 1e-3 * below(100'000'000);
  record.from_start = below(2) == 1;
  record.hands = static_cast<std::uint32_t>(below(5));
  record.ending = static_cast<VisitEnding>(below(4));
  record.went_on_to = text();
  record.notes_lost = static_cast<std::uint32_t>(below(1000));
  for (int i = below(4); i > 0; --i)
    record.steps.push_back(
        {text(), 1e-3 * below(1'000'000), static_cast<StepEnding>(below(4)), below(2) == 1, below(2) == 1});
  for (int i = below(4); i > 0; --i)
    record.mistakes.push_back(
        {static_cast<MistakeKind>(below(kMistakeKinds)), text(), static_cast<std::uint32_t>(below(1000))});
  for (int i = below(4); i > 0; --i) {
    const auto when = static_cast<AnswerTime>(below(2));
    const int marks = 1 + below(9);
    if (below(2) == 1) {
      record.answers.push_back({text(), when, "", 1 + below(marks), marks, {}});
    } else {
      record.answers.push_back({text(), when, text(), 0, 0, below(2) == 1});
    }
  }
  return record;
}

}  // namespace mechane::visits
