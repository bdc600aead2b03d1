#include "server/visits/visit_observer.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include <fmt/format.h>

#include "server/base/clock.hpp"

namespace mechane::visits {
namespace {

using state::EventKind;

template <class List>
std::string name_of(const List& list, std::uint32_t index) {
  return index < list.size() ? list[index].name : std::string();
}

constexpr double kHalfTick_s = 0.5 * kTickSeconds;

RecordedAnswer recorded_answer(const state::QuestionDescription& question, const state::VisitAnswer& given) {
  RecordedAnswer answer{.question = question.name, .when = given.when};
  if (question.kind == state::QuestionDescription::Kind::scale) {
    answer.marks = question.marks;
    answer.mark = static_cast<int>(given.answer);
    return answer;
  }
  answer.value = question.answers[given.answer].name;
  if (!question.correct.empty()) answer.right = answer.value == question.correct;
  return answer;
}

}  // namespace

VisitObserver::VisitObserver(std::shared_ptr<const state::WorldDescription> description, std::string kiosk,
                             const state::Progress& at, std::uint64_t tick, std::optional<VisitRecord> unfinished,
                             VisitSources sources)
    : description_(std::move(description)),
      kiosk_(std::move(kiosk)),
      sources_(std::move(sources)),
      tick_(tick),
      activity_(at.activity),
      activity_tick_(at.activity_tick) {
  if (at.step && !at.done) begin_step(at.step, at.step_tick);
  if (unfinished) take_up(std::move(*unfinished), tick);
}

/// The resumed world may be a second older than the record: steps that it has not reached yet will come again, so that they are removed
/// from the record.
void VisitObserver::take_up(VisitRecord record, std::uint64_t tick) {
  if (!activity_ || record.activity != description_->activities[activity_.index()].name || !step_) return;
  const std::string& now = description_of(step_).name;
  const auto last = std::find_if(record.steps.rbegin(), record.steps.rend(),
                                 [&](const RecordedStep& step) { return step.name == now; });
  if (last != record.steps.rend()) {
    record.steps.erase(last.base() - 1, record.steps.end());
  } else if (!record.steps.empty() && record.steps.back().ending == StepEnding::unfinished) {
    record.steps.pop_back();
  }
  record.steps.push_back(steps_.back());
  steps_ = record.steps;
  const auto spent = static_cast<std::uint64_t>(record.duration_s / kTickSeconds);
  began_ = tick - std::min(tick, spent);
  last_sign_ = tick;
  touched_ = true;
  did_something_ = true;
  hands_seen_ = record.hands == 0 ? 0 : (1U << std::min<std::uint32_t>(record.hands, hand::kMaxUsers)) - 1;
  record.ending = VisitEnding::running;
  lost_before_ = 0;
  record_ = std::move(record);
  changed_ = true;
}

const state::StepDescription& VisitObserver::description_of(StepId step) const {
  return description_->steps[step.index()];
}

double VisitObserver::seconds_from(std::uint64_t tick) const {
  return static_cast<double>(tick_ - std::min(tick, tick_)) * kTickSeconds;
}

void VisitObserver::take(const VisitNote& note) {
  tick_ = std::max(tick_, note.event.tick);
  count_let_go(note.event.tick);
  if (note.event.kind == EventKind::command_done) {
    command_done(note);
  } else if (note.event.kind == EventKind::activity_started) {
    activity_started(ActivityId(note.event.subject), note.event.tick,
                     note.command == state::CommandKind::restart_activity);
  } else if (note.event.kind == EventKind::released) {
    take_release(note);
  } else {
    take_event(note.event);
  }
}

void VisitObserver::take_event(const state::Event& event) {
  const bool is_user = event.subject < hand::kMaxUsers;
  switch (event.kind) {
    case EventKind::touched:
    case EventKind::grasped:
      if (is_user) hands_seen_ |= 1U << event.subject;
      if (is_user && event.kind == EventKind::grasped) holding_ |= 1U << event.subject;
      if (event.kind == EventKind::grasped) forget_let_go(event.object, event.tick - std::min(event.tick, kHandsOver));
      sign(event.tick);
      did_something_ = did_something_ || event.kind == EventKind::grasped;
      return;
    case EventKind::user_left:
      if (is_user) holding_ &= ~(1U << event.subject);
      return;
    case EventKind::pulled:
    case EventKind::pushed:
    case EventKind::pointed:
      sign(event.tick);
      did_something_ = true;
      return;
    case EventKind::lit:
      // A torch that lies in the coals may catch fire without a visitor.
      if (holding_ == 0) return;
      sign(event.tick);
      did_something_ = true;
      return;
    case EventKind::placed:
      return forget_let_go(event.object, 0);
    case EventKind::part_refused:
      sign(event.tick);
      return mistake(MistakeKind::wrong_part, name_of(description_->bodies, event.object));
    case EventKind::broke:
      return mistake(MistakeKind::broke, name_of(description_->agents, event.subject));
    case EventKind::spilled:
      return spilled(event.subject);
    case EventKind::step_started:
      return step_started(StepId(event.subject), event.tick);
    case EventKind::activity_done:
      return activity_done(event.tick);
    default:
      return;
  }
}

void VisitObserver::take_release(const VisitNote& note) {
  const state::Event& event = note.event;
  if (event.subject < hand::kMaxUsers) holding_ &= ~(1U << event.subject);
  if (is_over()) return;
  last_sign_ = event.tick;
  if (note.opened_hand && let_go_.size() < kMostMistakes) let_go_.push_back({event.object, event.tick});
}

/// Forgets releases of `body` in the tick `since` or later: they were no mistakes.
void VisitObserver::forget_let_go(std::uint32_t body, std::uint64_t since) {
  std::erase_if(let_go_, [=](const LetGo& one) { return one.body == body && one.tick >= since; });
}

void VisitObserver::count_let_go(std::uint64_t tick) {
  for (const LetGo& one : let_go_) {
    if (tick > one.tick + kSettles) mistake(MistakeKind::let_go, name_of(description_->bodies, one.body));
  }
  std::erase_if(let_go_, [tick](const LetGo& one) { return tick > one.tick + kSettles; });
}

/// The event of what the command did has come before this one.
void VisitObserver::command_done(const VisitNote& note) {
  const std::uint64_t tick = note.event.tick;
  if (note.command == state::CommandKind::click) return sign(tick);
  if (note.command != state::CommandKind::next_step || step_ended_ != tick) return;
  const auto ended = std::find_if(steps_.rbegin(), steps_.rend(),
                                  [](const RecordedStep& step) { return step.ending != StepEnding::unfinished; });
  if (ended != steps_.rend()) ended->ending = StepEnding::skipped;
  if (record_) record_->steps = steps_;
  changed_ = record_.has_value();
}

void VisitObserver::activity_started(ActivityId activity, std::uint64_t tick, bool restarted) {
  if (activity.index() >= description_->activities.size()) return;
  let_go_.clear();
  const StepId left_step = std::exchange(step_, StepId::none());
  const bool was_here = !is_over() && (holding_ != 0 || tick - last_sign_ < kAway);
  if (was_here && did_something_ && restarted && activity == activity_) {
    activity_tick_ = tick;
    last_sign_ = tick;
    measure_step(left_step, tick);
    return mistake(MistakeKind::restarted, "");
  }
  const bool goes_on = was_here && !did_something_;  // so far only answers, or a touch in passing
  if (!goes_on) finish(VisitEnding::left, last_sign_, left_step);
  activity_ = activity;
  activity_tick_ = tick;
  steps_.clear();
  touched_ = goes_on;
  did_something_ = false;
  hands_seen_ = holding_;
  if (!goes_on) {
    if (record_) finished_.push_back(std::move(*record_));
    return record_.reset();
  }
  record_->activity = description_->activities[activity.index()].name;
  record_->from_start = true;
  began_ = last_sign_ = tick;
  changed_ = true;
}

/// Notes how long the visitor has been in a step that has not ended.
void VisitObserver::measure_step(StepId id, std::uint64_t tick) {
  if (!id || steps_.empty() || steps_.back().ending != StepEnding::unfinished) return;
  const state::StepDescription& step = description_of(id);
  const auto since = [tick](std::uint64_t from) {
    return static_cast<double>(tick - std::min(tick, from)) * kTickSeconds;
  };
  steps_.back().duration_s = since(step_tick_);
  // Hints follow the world's time in the step: a visitor who comes late sees the hint at once.
  steps_.back().hint_shown = step.texts.contains("hint") && since(step_began_) >= step.hint_after_s;
}

void VisitObserver::step_started(StepId step, std::uint64_t tick) {
  if (step.index() >= description_->steps.size()) return;
  let_go_.clear();  // letting go may be what the step asked for
  if (step_) end_step(tick, step);
  begin_step(step, tick);
  const std::string& opens = description_of(step).opens;
  if (opens.empty() || is_over()) return;
  record_->went_on_to = opens;  // the visitor touched a sign, and that is all there was to do
  activity_done(tick);
}

void VisitObserver::begin_step(StepId step, std::uint64_t tick) {
  step_ = step;
  step_tick_ = step_began_ = tick;
  spilled_in_step_.clear();
  if (steps_.size() < kMostSteps) steps_.push_back({.name = description_of(step).name});
  if (is_over()) return;
  record_->steps = steps_;
  changed_ = true;
}

void VisitObserver::end_step(std::uint64_t tick, StepId next) {
  const state::StepDescription& step = description_of(step_);
  did_something_ = true;
  measure_step(step_, tick);
  step_ended_ = tick;
  step_ = StepId::none();
  if (steps_.empty() || steps_.back().ending != StepEnding::unfinished) return;  // it is beyond kMostSteps
  const double whole_s = static_cast<double>(tick - std::min(tick, step_began_)) * kTickSeconds;
  const bool late = step.timeout_s > 0 && whole_s + kHalfTick_s >= step.timeout_s;
  steps_.back().ending = late && next == step.timeout_next ? StepEnding::timed_out : StepEnding::done;
}

void VisitObserver::activity_done(std::uint64_t tick) {
  let_go_.clear();
  if (step_) end_step(tick, StepId::none());
  if (is_over()) return;
  last_sign_ = tick;
  record_->steps = steps_;
  record_->duration_s = seconds_from(began_);
  record_->ending = VisitEnding::done;
  changed_ = true;
}

void VisitObserver::sign(std::uint64_t tick) {
  if (!activity_ || (!step_ && is_over())) return;  // no activity is running: what follows is not part of a visit
  if (is_over()) begin(tick);
  last_sign_ = tick;
  touched_ = true;
  const auto hands = static_cast<std::uint32_t>(std::popcount(hands_seen_));
  const std::string& language = language_.empty() ? record_->language : language_;
  changed_ = changed_ || hands != record_->hands || language != record_->language;
  record_->hands = hands;
  record_->language = language;
}

void VisitObserver::begin(std::uint64_t tick) {
  if (record_) finished_.push_back(std::move(*record_));
  const bool at_first = !step_ || step_ == description_->activities[activity_.index()].first;
  const bool just_begun = !touched_ && tick - std::min(tick, activity_tick_) < kAway;
  if (!just_begun) {  // nobody was there until now: the time before does not count
    steps_.clear();
    if (step_) steps_.push_back({.name = description_of(step_).name, .whole = at_first});
    step_tick_ = tick;
  }
  began_ = just_begun ? activity_tick_ : tick;
  record_.emplace();
  record_->number = sources_.number();
  record_->minute = sources_.minute();
  record_->kiosk = kiosk_;
  record_->scenario = description_->id;
  record_->scenario_hash = description_->content_hash;
  record_->activity = description_->activities[activity_.index()].name;
  record_->language = language_;
  record_->from_start = just_begun || at_first;
  record_->steps = steps_;
  did_something_ = false;
  changed_ = true;
}

void VisitObserver::finish(VisitEnding ending, std::uint64_t tick, StepId step) {
  if (is_over()) return;
  count_let_go(tick + kSettles + 1);
  record_->duration_s = static_cast<double>(tick - std::min(tick, began_)) * kTickSeconds;
  measure_step(step, tick);
  record_->steps = steps_;
  record_->ending = ending;
  hands_seen_ = 0;
  finished_.push_back(std::move(*record_));
  record_.reset();
  changed_ = false;
}

void VisitObserver::mistake(MistakeKind kind, const std::string& subject) {
  if (is_over()) return;
  changed_ = true;
  const auto known = std::ranges::find_if(
      record_->mistakes, [&](const RecordedMistake& one) { return one.kind == kind && one.subject == subject; });
  if (known != record_->mistakes.end()) {
    ++known->count;
  } else if (record_->mistakes.size() < kMostMistakes) {
    record_->mistakes.push_back({kind, subject, 1});
  }
}

void VisitObserver::spilled(std::uint32_t machine) {
  if (std::ranges::find(spilled_in_step_, machine) != spilled_in_step_.end()) return;
  spilled_in_step_.push_back(machine);
  mistake(MistakeKind::spilled, name_of(description_->machines, machine));
}

void VisitObserver::look(std::uint64_t tick, std::uint32_t lost) {
  tick_ = std::max(tick_, tick);
  count_let_go(tick_);
  if (is_over()) {
    lost_before_ = lost;
    return;
  }
  if (lost != lost_before_) {
    record_->notes_lost += lost - lost_before_;
    lost_before_ = lost;
    changed_ = true;
  }
  if (holding_ != 0) last_sign_ = tick_;
  if (tick_ - std::min(tick_, last_sign_) >= kAway) finish(VisitEnding::left, last_sign_, step_);
}

Expected<void> VisitObserver::answer(const state::VisitAnswer& given) {
  const state::ActivityDescription& asked = description_->activities[given.activity.index()];
  if (given.activity != activity_) {
    return fail(ErrorCode::conflict,
                fmt::format("a question of activity {} was answered while {} is running", asked.name,
                            activity_ ? "activity " + description_->activities[activity_.index()].name : "no activity"),
                description_->id, "ask the question before another activity begins");
  }
  RecordedAnswer answer = recorded_answer(asked.questionnaire[given.question], given);
  if (!record_ && given.when == AnswerTime::after) {
    return fail(ErrorCode::conflict, "there was no visitor whom this question could be about",
                "question " + answer.question, "ask it after a visit and before the activity begins again");
  }
  if (!record_ || (is_over() && given.when == AnswerTime::before)) begin(tick_);
  if (!is_over()) last_sign_ = tick_;
  const auto known = std::ranges::find_if(record_->answers, [&](const RecordedAnswer& one) {
    return one.question == answer.question && one.when == answer.when;
  });
  if (known != record_->answers.end()) {
    *known = std::move(answer);  // the visitor has changed the answer
  } else {
    record_->answers.push_back(std::move(answer));
  }
  changed_ = true;
  return {};
}

void VisitObserver::close(VisitEnding why, const std::string& went_on_to) {
  if (is_over()) {
    if (record_ && changed_) finished_.push_back(*record_);
    record_.reset();
    changed_ = false;
    return;
  }
  record_->went_on_to = went_on_to;
  // A visitor who goes on to another exhibit was there until now.
  finish(why, why == VisitEnding::cut || !went_on_to.empty() ? tick_ : std::max(last_sign_, began_), step_);
}

std::vector<VisitRecord> VisitObserver::take_changed() {
  std::vector<VisitRecord> changed = std::exchange(finished_, {});
  if (record_ && changed_) {
    if (!is_over()) record_->duration_s = seconds_from(began_);
    changed.push_back(*record_);
  }
  changed_ = false;
  return changed;
}

}  // namespace mechane::visits
