// The sheet of a visit: what an observer with pencil and stop-watch would note of a visitor at a machine, and what the visitor
// answered. As in the evaluation of the published system (section 6): a questionnaire before and one after, and for the observer "if
// the user performed the task correctly, how long did it take". Nothing in it says who the visitor was.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"
#include "server/state/visit_answer.hpp"

namespace mechane::visits {

using state::AnswerTime;

/// An answer with what is needed to count it without the scenario.
struct SheetAnswer {
  std::string question{};
  AnswerTime when = AnswerTime::after;
  std::string value{};          ///< the chosen answer's name; scale: empty
  int mark = 0;                 ///< scale: 1 .. marks; choice: 0
  int marks = 0;                ///< scale: how many there are; choice: 0
  std::optional<bool> right{};  ///< choice with a right answer: whether it was that
  bool operator==(const SheetAnswer&) const = default;
};

/// How a step ended.
enum class StepEnding : std::uint8_t {
  unfinished,  ///< the visitor is in it, or left there
  done,        ///< what it waits for came
  timed_out,   ///< its time was over
  skipped,     ///< somebody asked for the next step
};

struct SheetStep {
  std::string name{};
  double duration_s = 0;
  StepEnding ending = StepEnding::unfinished;
  bool hint_shown = false;
  bool whole = true;  ///< false: the visitor came when it had begun; its time is not a measure
  bool operator==(const SheetStep&) const = default;
};

/// What went wrong at the visitor's hand, as far as agents and machines can tell.
enum class MistakeKind : std::uint8_t {
  let_go,      ///< a free part was let go where it does not belong; subject: the body
  wrong_part,  ///< a part came to its place before its turn; subject: the body
  broke,       ///< something gave way; subject: the agent
  spilled,     ///< a machine ran over, once a step at most; subject: the machine
  restarted,   ///< the activity was begun anew; no subject
};

struct SheetMistake {
  MistakeKind kind = MistakeKind::let_go;
  std::string subject;
  std::uint32_t count = 0;
  bool operator==(const SheetMistake&) const = default;
};

enum class VisitEnding : std::uint8_t {
  running,  ///< not over yet
  done,     ///< the activity was done
  left,     ///< the visitor went away, or on to something else, before
  cut,      ///< the server stopped: says nothing about the visitor
};

/// An observer's words, written later. Not the server's: it never changes them.
struct SheetRemark {
  std::int64_t minute = 0;  ///< since 1970 UTC
  std::string text;         ///< 1 to kLongestRemark bytes of UTF-8, one line or several
  bool operator==(const SheetRemark&) const = default;
};
inline constexpr std::size_t kLongestRemark = 2000;

/// One visitor, or several at one machine together, in one activity.
struct VisitSheet {
  std::string number;  ///< random: it leads to nobody and tells no order
  std::string kiosk;   ///< the first, where several share a world
  std::string scenario;
  std::string scenario_hash;
  std::string activity;
  std::string language;  ///< "el"; empty: nobody said
  /// When it began, in minutes since 1970 UTC. To the minute: that is enough to compare mornings with afternoons, and too little to
  /// tell from a ticket's or a camera's time who it was.
  std::int64_t minute = 0;
  double duration_s = 0;    ///< to the end of the activity, or to the last that was seen of the visitor
  bool from_start = true;   ///< false: the activity was already under way when the visitor came
  std::uint32_t hands = 0;  ///< how many took part
  VisitEnding ending = VisitEnding::running;
  std::string went_on_to;        ///< the scenario that a sign led to; empty: none
  std::uint32_t notes_lost = 0;  ///< what the server was too busy to note: more than 0 says that counts may be too low
  std::vector<SheetStep> steps;  ///< in the order gone through; a step may come again
  std::vector<SheetMistake> mistakes;
  std::vector<SheetAnswer> answers;
  std::vector<SheetRemark> remarks;
  bool operator==(const VisitSheet&) const = default;

  /// Done, and nobody and nothing had to help: no hint, no time-out, no step skipped, not begun in the midst.
  [[nodiscard]] bool done_alone() const;
  [[nodiscard]] std::uint32_t count_of(MistakeKind kind) const;
};

[[nodiscard]] std::string_view word_of(AnswerTime when);
[[nodiscard]] std::string_view word_of(StepEnding ending);
[[nodiscard]] std::string_view word_of(MistakeKind kind);
[[nodiscard]] std::string_view word_of(VisitEnding ending);
[[nodiscard]] std::optional<AnswerTime> answer_time_of(std::string_view word);
[[nodiscard]] std::optional<StepEnding> step_ending_of(std::string_view word);
[[nodiscard]] std::optional<MistakeKind> mistake_kind_of(std::string_view word);
[[nodiscard]] std::optional<VisitEnding> visit_ending_of(std::string_view word);
inline constexpr std::size_t kMistakeKinds = 5;

/// A new sheet's number: 60 random bits as "k7m2-9qxd-4tz0", in letters that a person reads and types without mistakes.
[[nodiscard]] std::string new_visit_number();
/// Minutes since 1970 UTC, now.
[[nodiscard]] std::int64_t minute_now();
/// "2026-11-22 09:40", UTC.
[[nodiscard]] std::string minute_text(std::int64_t minute);
/// From "2026-11-22" or "2026-11-22 09:40", UTC. Errors: it is neither.
[[nodiscard]] Expected<std::int64_t> minute_of_text(std::string_view text);

}  // namespace mechane::visits
