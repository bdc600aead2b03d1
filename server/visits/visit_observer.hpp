// VisitObserver: fills in the sheets of one world's visits from what its loop notes.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/state/description.hpp"
#include "server/visits/visit_feed.hpp"
#include "server/visits/visit_sheet.hpp"

namespace mechane::visits {

/// Where numbers and times come from; a test has its own.
struct VisitSources {
  std::function<std::string()> number = new_visit_number;
  std::function<std::int64_t()> minute = minute_now;
};

/// One world's. One thread, not the loop's: it allocates.
///
/// A kiosk's device is there all day, so that a hand that is present is not a visitor. A visit begins with the first
/// touch, grasp, pointing,
/// command or answer, and counts from the start of the activity where that was less than kAway before: reading what to do is part of
/// it. It ends with the activity, or is 'left' where nothing is seen of the visitor for kAway. Answers to the questions after it are
/// taken until the next visit begins. An activity that is restarted by somebody who was there a moment ago is the same visit, with a
/// mistake more; one that is started is another visit, unless nothing but a touch or an answer came before.
class VisitObserver {
 public:
  static constexpr std::uint64_t kAway = 90'000;  ///< ticks without a sign of a visitor
  /// A part that comes to its place, or that the step waited for, within so many ticks after it was let go, was not let go wrongly.
  /// Steps wait for up to 3 s until what they ask for has lasted.
  static constexpr std::uint64_t kSettles = 3'500;
  /// Nor was one that a hand, this or another, holds again so soon.
  static constexpr std::uint64_t kHandsOver = 1'000;
  static constexpr std::size_t kMostSteps = 200;  ///< of one sheet: rules that go in circles must not fill the disk
  static constexpr std::size_t kMostMistakes = 200;

  /// `at` is where the world is in its first tick after `tick`. `unfinished`: the sheet of the visit that a server's stop cut off, which
  /// goes on.
  VisitObserver(std::shared_ptr<const state::WorldDescription> description, std::string kiosk,
                const state::Progress& at, std::uint64_t tick, std::optional<VisitSheet> unfinished = {},
                VisitSources sources = {});

  /// In the order in which the loop noted them.
  void take(const VisitNote& note);
  /// Time has passed: all notes up to `tick` have been taken, and `lost` never came.
  void look(std::uint64_t tick, std::uint32_t lost);
  /// Errors: another activity runs, or nobody was seen at it.
  [[nodiscard]] Expected<void> answer(const state::VisitAnswer& answer);
  /// In which the kiosk speaks from now on. A visit's sheet takes it with the visitor's next sign: a kiosk that goes back to its own
  /// language when the visitor has gone changes nothing.
  void set_language(std::string language) { language_ = std::move(language); }
  /// The world closes. `cut`: the server stops; else the visitor left, for `went_on_to` where that is not empty.
  void close(VisitEnding why, const std::string& went_on_to = {});

  /// The sheets that have changed since the last call, each as it is now.
  [[nodiscard]] std::vector<VisitSheet> take_changed();

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
  void take_up(VisitSheet sheet, std::uint64_t tick);
  [[nodiscard]] bool is_over() const { return !sheet_ || sheet_->ending != VisitEnding::running; }
  [[nodiscard]] const state::StepDescription& description_of(StepId step) const;
  [[nodiscard]] double seconds_from(std::uint64_t tick) const;

  std::shared_ptr<const state::WorldDescription> description_;
  std::string kiosk_;
  VisitSources sources_;
  std::string language_;
  std::uint64_t tick_ = 0;  // the newest that is known
  ActivityId activity_;
  StepId step_;  // none: the activity is done
  std::uint64_t activity_tick_ = 0;
  std::uint64_t step_began_ = 0;  // in the world
  std::uint64_t step_tick_ = 0;   // from which the visitor's time in it counts
  std::vector<SheetStep> steps_;  // of this activity, the current one last; becomes the sheet's
  std::uint64_t step_ended_ = 0;
  bool touched_ = false;  // somebody has been at this activity since it began

  std::optional<VisitSheet> sheet_;
  bool changed_ = false;
  std::vector<VisitSheet> finished_;  // to be handed out, and not ours any more
  std::uint64_t began_ = 0;           // tick from which the visit counts
  std::uint64_t last_sign_ = 0;
  bool did_something_ = false;    // more than answer, or touch a thing
  std::uint32_t hands_seen_ = 0;  // bits
  std::uint32_t holding_ = 0;     // bits: whoever holds something is there
  std::vector<LetGo> let_go_;     // what may still settle
  std::vector<std::uint32_t> spilled_in_step_;
  std::uint32_t lost_before_ = 0;
};

}  // namespace mechane::visits
