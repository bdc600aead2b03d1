// VisitObserver: makes the records of one world's visits from what its loop notes.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/state/description.hpp"
#include "server/visits/visit_feed.hpp"
#include "server/visits/visit_record.hpp"

namespace mechane::visits {

/// Where numbers and times come from; tests have their own.
struct VisitSources {
  std::function<std::string()> number = new_visit_number;
  std::function<std::int64_t()> minute = minute_now;
};

/// For one world. One thread, not a loop's: it allocates.
///
/// A kiosk's device is there all day: a hand that is present is not yet a visitor. A visit begins with the first sign: a touch, grasp,
/// pointing, command or answer. It counts from the start of the activity where that was less than kAway before, because reading what to do
/// is part of the visit. It ends with the activity, or is 'left' after kAway without a sign. Answers to the questions after it are taken
/// until the next visit begins. When a visitor restarts the activity, the visit goes on, with one mistake more. When an activity is
/// started, another visit begins, unless there was nothing but a touch or an answer before.
class VisitObserver {
 public:
  static constexpr std::uint64_t kAway = 90'000;  ///< ticks without a sign, after which the visitor has left
  /// Letting go of a part is not a mistake if within this many ticks it comes to its place, or its step ends. What a step asks for may have
  /// to last up to 3 s.
  static constexpr std::uint64_t kSettles = 3'500;
  /// Nor if a hand, this or another, holds the part again within this many ticks.
  static constexpr std::uint64_t kHandsOver = 1'000;
  static constexpr std::size_t kMostSteps = 200;  ///< of one record: steps that go in circles must not fill the disk
  static constexpr std::size_t kMostMistakes = 200;

  /// `at`: the world's progress in its first tick after `tick`. `unfinished`: the record of a visit that was cut off when a server stopped,
  /// and that goes on now.
  VisitObserver(std::shared_ptr<const state::WorldDescription> description, std::string kiosk,
                const state::Progress& at, std::uint64_t tick, std::optional<VisitRecord> unfinished = {},
                VisitSources sources = {});

  /// Notes must come in the loop's order.
  void take(const VisitNote& note);
  /// To be called regularly, after all notes up to `tick` were taken. `lost`: how many notes were lost since the world began.
  void look(std::uint64_t tick, std::uint32_t lost);
  /// Errors: conflict (another activity is running, or there was no visitor).
  [[nodiscard]] Expected<void> answer(const state::VisitAnswer& answer);
  /// The kiosk's language from now on. It comes into a visit's record with the visitor's next sign, so that a kiosk may go back to its
  /// first language when the visitor has gone.
  void set_language(std::string language) { language_ = std::move(language); }
  /// The world closes. `why`: cut, because the server stops, or left. `went_on_to`: the scenario that the visitor went on to, or empty.
  void close(VisitEnding why, const std::string& went_on_to = {});

  /// Whether a visitor is there, as far as can be told: see above.
  [[nodiscard]] bool visit_runs() const { return !is_over(); }
  /// The records that have changed since the last call, each as it is now.
  [[nodiscard]] std::vector<VisitRecord> take_changed();

 private:
  struct LetGo {
    std::uint32_t body;
    std::uint64_t tick;
  };

  void take_event(const state::Event& event);
  void take_release(const VisitNote& note);
  void command_done(const VisitNote& note);
  void activity_started(ActivityId activity, std::uint64_t tick, bool restarted);
  void step_started(StepId step, std::uint64_t tick);
  void activity_done(std::uint64_t tick);
  void sign(std::uint64_t tick);
  void begin(std::uint64_t tick);
  void begin_step(StepId step, std::uint64_t tick);
  void end_step(std::uint64_t tick, StepId next);
  void measure_step(StepId step, std::uint64_t tick);
  void finish(VisitEnding ending, std::uint64_t tick, StepId step);
  void mistake(MistakeKind kind, const std::string& subject);
  void spilled(std::uint32_t machine);
  void count_let_go(std::uint64_t tick);
  void forget_let_go(std::uint32_t body, std::uint64_t since);
  void take_up(VisitRecord record, std::uint64_t tick);
  [[nodiscard]] bool is_over() const { return !record_ || record_->ending != VisitEnding::running; }
  [[nodiscard]] const state::StepDescription& description_of(StepId step) const;
  [[nodiscard]] double seconds_from(std::uint64_t tick) const;

  std::shared_ptr<const state::WorldDescription> description_;
  std::string kiosk_;
  VisitSources sources_;
  std::string language_;
  std::uint64_t tick_ = 0;  // the newest known one
  ActivityId activity_;
  StepId step_;  // none where the activity is done
  std::uint64_t activity_tick_ = 0;
  std::uint64_t step_began_ = 0;     // in the world
  std::uint64_t step_tick_ = 0;      // the visitor's time in the step counts from here
  std::vector<RecordedStep> steps_;  // of this activity, the current one last; copied into the record
  std::uint64_t step_ended_ = 0;
  bool touched_ = false;  // there was a visitor since this activity began

  std::optional<VisitRecord> record_;
  bool changed_ = false;
  std::vector<VisitRecord> finished_;  // for take_changed(); they do not change any more
  std::uint64_t began_ = 0;            // tick from which the visit counts
  std::uint64_t last_sign_ = 0;
  bool did_something_ = false;    // more than an answer or a touch
  std::uint32_t hands_seen_ = 0;  // bits by user
  std::uint32_t holding_ = 0;     // bits by user: hands that hold something
  std::vector<LetGo> let_go_;     // releases that may still turn out to be no mistakes
  std::vector<std::uint32_t> spilled_in_step_;
  std::uint32_t lost_before_ = 0;
};

}  // namespace mechane::visits
