// The record of a visit: what an observer with a stopwatch would note about a visitor at a machine, and what the visitor answered. As in
// the evaluation of the published system (section 6): a questionnaire before and one after, and for the observer "if the user performed the
// task correctly, how long did it take". It does not say who the visitor was.
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

/// An answer, with all that is needed to count it without the scenario.
struct RecordedAnswer {
  std::string question{};
  AnswerTime when = AnswerTime::after;
  std::string value{};          ///< the chosen answer's name; scale: empty
  int mark = 0;                 ///< scale: 1 .. marks; choice: 0
  int marks = 0;                ///< scale: how many there are; choice: 0
  std::optional<bool> right{};  ///< of a choice that has a right answer: whether this is it
  bool operator==(const RecordedAnswer&) const = default;
};

/// How a step ended.
enum class StepEnding : std::uint8_t {
  unfinished,  ///< the visitor is still in it, or left during it
  done,        ///< what the step asks for was done
  timed_out,   ///< the step's time was over
  skipped,     ///< somebody asked for the next step
};

struct RecordedStep {
  std::string name{};
  double duration_s = 0;
  StepEnding ending = StepEnding::unfinished;
  bool hint_shown = false;
  bool whole = true;  ///< false: the visitor came after it had begun, so that its time says nothing
  bool operator==(const RecordedStep&) const = default;
};

/// What the visitor did wrong, as far as agents and machines can tell.
enum class MistakeKind : std::uint8_t {
  let_go,      ///< a free part was let go where it does not belong; subject: the body
  wrong_part,  ///< a part came to its place before its turn; subject: the body
  broke,       ///< something broke; subject: the agent
  spilled,     ///< water ran over, counted once in a step; subject: the machine
  restarted,   ///< the activity was begun again; no subject
};

struct RecordedMistake {
  MistakeKind kind = MistakeKind::let_go;
  std::string subject;
  std::uint32_t count = 0;
  bool operator==(const RecordedMistake&) const = default;
};

enum class VisitEnding : std::uint8_t {
  running,  ///< not over yet
  done,     ///< the activity was done
  left,     ///< before that, the visitor went away or on to something else
  cut,      ///< the server stopped; this says nothing about the visitor
};

/// An observer's words, written later. The server never changes them.
struct RecordedRemark {
  std::int64_t minute = 0;       ///< since 1970 UTC
  std::string text;              ///< 1 to kLongestRemark bytes of UTF-8, one line or several
  std::string author{};          ///< who wrote it in a console; empty: written with `mechane visits remark`
  std::optional<double> at_s{};  ///< what it is about: seconds since the visit began; none: all of it
  bool operator==(const RecordedRemark&) const = default;
};
inline constexpr std::size_t kLongestRemark = 2000;

/// One activity of one visitor, or of several together at one machine.
struct VisitRecord {
  std::string number;  ///< random: it identifies nobody and has no order
  std::string kiosk;   ///< the first one, where several share a world
  std::string scenario;
  std::string scenario_hash;
  std::string activity;
  std::string language;  ///< "el"; empty: unknown
  /// When it began, in minutes since 1970 UTC. A minute is exact enough to compare mornings with afternoons, and not exact enough to find
  /// out by the time of a ticket or of a camera who it was.
  std::int64_t minute = 0;
  double duration_s = 0;    ///< to the end of the activity, or to the visitor's last sign
  bool from_start = true;   ///< false: the activity had already begun when the visitor came
  std::uint32_t hands = 0;  ///< how many hands took part
  VisitEnding ending = VisitEnding::running;
  std::string went_on_to;  ///< the scenario that a sign led to; empty: none
  std::uint32_t notes_lost =
      0;  ///< events that the server was too busy to note: where this is not 0, counts may be too low
  std::vector<RecordedStep> steps;  ///< in the order gone through; a step may come again
  std::vector<RecordedMistake> mistakes;
  std::vector<RecordedAnswer> answers;
  std::vector<RecordedRemark> remarks;
  bool operator==(const VisitRecord&) const = default;

  /// Done from the start and without help: no hint, no time-out, no step skipped.
  [[nodiscard]] bool done_alone() const;
  [[nodiscard]] std::uint32_t count_of(MistakeKind kind) const;
};

/// "eleni, at 35 s: laughed aloud": as much of it as the remark has.
[[nodiscard]] std::string remark_line(const RecordedRemark& remark);

[[nodiscard]] std::string_view word_of(AnswerTime when);
[[nodiscard]] std::string_view word_of(StepEnding ending);
[[nodiscard]] std::string_view word_of(MistakeKind kind);
[[nodiscard]] std::string_view word_of(VisitEnding ending);
[[nodiscard]] std::optional<AnswerTime> answer_time_of(std::string_view word);
[[nodiscard]] std::optional<StepEnding> step_ending_of(std::string_view word);
[[nodiscard]] std::optional<MistakeKind> mistake_kind_of(std::string_view word);
[[nodiscard]] std::optional<VisitEnding> visit_ending_of(std::string_view word);
inline constexpr std::size_t kMistakeKinds = 5;

/// A new record's number: 60 random bits as "k7m2-9qxd-4tz0", in letters that are not easily confused.
[[nodiscard]] std::string new_visit_number();
/// Whether a text has the form of a whole number of a visit.
[[nodiscard]] bool is_visit_number(std::string_view text);
/// Minutes since 1970 UTC, now.
[[nodiscard]] std::int64_t minute_now();
/// "2026-11-22 09:40", UTC.
[[nodiscard]] std::string minute_text(std::int64_t minute);
/// The minute of "2026-11-22" or "2026-11-22 09:40", UTC. Errors: invalid_value.
[[nodiscard]] Expected<std::int64_t> minute_of_text(std::string_view text);

}  // namespace mechane::visits
