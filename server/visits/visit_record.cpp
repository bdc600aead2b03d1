#include "server/visits/visit_record.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <random>

#include <fmt/chrono.h>
#include <fmt/format.h>

namespace mechane::visits {
namespace {

constexpr std::array<std::string_view, 2> kAnswerTimes{"before", "after"};
constexpr std::array<std::string_view, 4> kStepEndings{"unfinished", "done", "timed out", "skipped"};
constexpr std::array<std::string_view, kMistakeKinds> kMistakes{"let go", "wrong part", "broke", "spilled",
                                                                "restarted"};
constexpr std::array<std::string_view, 4> kVisitEndings{"running", "done", "left", "cut"};

template <class Enum, std::size_t n>
std::optional<Enum> value_of_word(const std::array<std::string_view, n>& words, std::string_view word) {
  const auto it = std::ranges::find(words, word);
  if (it == words.end()) return {};
  return static_cast<Enum>(it - words.begin());
}

// Crockford's base 32: no i, l, o, u.
constexpr std::string_view kLetters = "0123456789abcdefghjkmnpqrstvwxyz";
constexpr int kNumberLetters = 12;
constexpr int kGroup = 4;

/// The number that `text` is; nothing where it has anything but digits.
std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty() || text.front() == '-') return {};
  return value;
}

}  // namespace

std::string_view word_of(AnswerTime when) {
  return kAnswerTimes[static_cast<std::size_t>(when)];
}
std::string_view word_of(StepEnding ending) {
  return kStepEndings[static_cast<std::size_t>(ending)];
}
std::string_view word_of(MistakeKind kind) {
  return kMistakes[static_cast<std::size_t>(kind)];
}
std::string_view word_of(VisitEnding ending) {
  return kVisitEndings[static_cast<std::size_t>(ending)];
}
std::optional<AnswerTime> answer_time_of(std::string_view word) {
  return value_of_word<AnswerTime>(kAnswerTimes, word);
}
std::optional<StepEnding> step_ending_of(std::string_view word) {
  return value_of_word<StepEnding>(kStepEndings, word);
}
std::optional<MistakeKind> mistake_kind_of(std::string_view word) {
  return value_of_word<MistakeKind>(kMistakes, word);
}
std::optional<VisitEnding> visit_ending_of(std::string_view word) {
  return value_of_word<VisitEnding>(kVisitEndings, word);
}

bool VisitRecord::done_alone() const {
  return ending == VisitEnding::done && from_start && std::ranges::all_of(steps, [](const RecordedStep& step) {
           return !step.hint_shown && step.ending != StepEnding::timed_out && step.ending != StepEnding::skipped;
         });
}

std::uint32_t VisitRecord::count_of(MistakeKind kind) const {
  std::uint32_t count = 0;
  for (const RecordedMistake& mistake : mistakes)
    count += mistake.kind == kind ? mistake.count : 0;
  return count;
}

std::string remark_line(const RecordedRemark& remark) {
  std::string head = remark.author;
  if (remark.at_s) head += fmt::format("{}at {:.0f} s", head.empty() ? "" : ", ", *remark.at_s);
  return head.empty() ? remark.text : head + ": " + remark.text;
}

std::string new_visit_number() {
  std::random_device random;  // the kernel's: no number follows from another one
  std::string number;
  for (int i = 0; i < kNumberLetters; ++i) {
    if (i > 0 && i % kGroup == 0) number += '-';
    number += kLetters[random() % kLetters.size()];
  }
  return number;
}

bool is_visit_number(std::string_view text) {
  if (text.size() != 14) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool dash = i % (kGroup + 1) == kGroup;
    if (dash ? text[i] != '-' : kLetters.find(text[i]) == std::string_view::npos) return false;
  }
  return true;
}

std::int64_t minute_now() {
  using std::chrono::system_clock;
  return std::chrono::floor<std::chrono::minutes>(system_clock::now().time_since_epoch()).count();
}

std::string minute_text(std::int64_t minute) {
  // To the end of the year 9999: fmt does not print later dates.
  const std::int64_t last = 253402300799 / 60;
  const auto seconds = static_cast<std::time_t>(std::clamp<std::int64_t>(minute, 0, last) * 60);
  return fmt::format("{:%Y-%m-%d %H:%M}", fmt::gmtime(seconds));
}

Expected<std::int64_t> minute_of_text(std::string_view text) {
  const auto wrong = [&] {
    return fail(ErrorCode::invalid_value, "this is not a date", std::string(text),
                "write it as 2026-11-22, or \"2026-11-22 09:40\" (UTC)");
  };
  const bool has_time = text.size() == 16;
  if ((text.size() != 10 && !has_time) || text[4] != '-' || text[7] != '-') return wrong();
  if (has_time && ((text[10] != ' ' && text[10] != 'T') || text[13] != ':')) return wrong();
  const auto year = whole_number(text.substr(0, 4));
  const auto month = whole_number(text.substr(5, 2));
  const auto day = whole_number(text.substr(8, 2));
  const auto hour = has_time ? whole_number(text.substr(11, 2)) : 0;
  const auto minute = has_time ? whole_number(text.substr(14, 2)) : 0;
  if (!year || !month || !day || !hour || !minute || *hour > 23 || *minute > 59) return wrong();
  const std::chrono::year_month_day date{std::chrono::year(*year), std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!date.ok() || *year < 1970) return wrong();
  const std::int64_t days = std::chrono::sys_days(date).time_since_epoch().count();
  return (days * 24 + *hour) * 60 + *minute;
}

}  // namespace mechane::visits
