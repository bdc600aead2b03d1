// What a visitor is offered over the picture, and what follows from pressing it: the way home, another language, questions about an
// activity, how large and how plain the words are. No clock, no window, no network of its own: all that is timed takes the display's steady clock as an argument.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client-sdk/picture/overlay_content.hpp"
#include <mechane/client/client.hpp>

namespace mechane::visit {

/// When an activity's questions are asked.
enum class AskWhen : std::uint8_t { none, after, both };
[[nodiscard]] std::string ask_name(AskWhen when);
/// What no name is means `after`.
[[nodiscard]] AskWhen ask_when(const std::string& name);

struct VisitorPanelSettings {
  std::string language = "el";  ///< what the display comes back to
  AskWhen ask = AskWhen::after;
  picture::OverlayStyle style;
  Duration home_after{0};  ///< without a hand's motion or a click: back to where exhibits are chosen; 0: never
};

/// What is known now. Null: nothing is.
struct VisitorNews {
  const client::WorldStatus* status = nullptr;
  std::shared_ptr<const client::WorldPresentation> presentation{};
  const client::Frame* frame = nullptr;
  std::string home{};  ///< id of the scenario that Home leads to; empty: not known
};

/// What the display has to do for the visitor.
struct VisitorRequests {
  bool home = false;
  std::vector<client::VisitAnswer> answers;  ///< oldest first
};

class VisitorPanel {
 public:
  static constexpr Duration kQuestionsWait =
      std::chrono::seconds(45);  ///< without a click: then nobody is there who answers
  static constexpr Duration kFarewell = std::chrono::seconds(6);
  static constexpr Duration kAdmires =
      std::chrono::seconds(4);  ///< what was done is looked at before anything is asked about it
  static constexpr Duration kSettles =
      std::chrono::milliseconds(400);  ///< the second tap of a double one answers nothing
  static constexpr Duration kGoal = std::chrono::seconds(8);
  static constexpr Duration kAlone =
      std::chrono::seconds(90);  ///< without a hand's motion or a click: the visitor has gone
  static constexpr Duration kWarning = std::chrono::seconds(10);  ///< before it goes home by itself
  static constexpr double kHandMoved_m = 0.005;                   ///< less is a device that trembles
  static constexpr double kContact_n = 0.5;                       ///< less of a change is a hand that lies still

  explicit VisitorPanel(VisitorPanelSettings settings);

  /// Once a picture.
  void update(const VisitorNews& news, TimePoint now);
  /// A button was pressed. One that is no longer offered does nothing.
  void press(const picture::OverlayAction& action, TimePoint now);
  /// A click beside all buttons: somebody is there.
  void touch(TimePoint now);
  /// To the world's next language.
  void next_language(TimePoint now);
  void toggle_large_text();
  void toggle_high_contrast();
  /// From afar: by who looks after the kiosk. The language at once where nobody is there, else when the visitor has gone.
  void change(const VisitorPanelSettings& settings);
  [[nodiscard]] const VisitorPanelSettings& settings() const { return settings_; }
  /// How long nobody has done anything: moved a hand, touched a thing, clicked.
  [[nodiscard]] Duration alone_for(TimePoint now) const { return began_ ? now - stirred_ : Duration{0}; }

  /// Code of the language that all words are in now.
  [[nodiscard]] const std::string& language() const { return language_; }
  /// Adds what is offered now.
  void write(picture::OverlayContent& content, TimePoint now) const;
  [[nodiscard]] VisitorRequests take_requests() { return std::exchange(requests_, {}); }

 private:
  /// One going-through of an activity.
  struct Run {
    std::string world;
    std::string activity;
    std::uint32_t steps_done = 0;
    bool done = false;
    TimePoint done_from;
  };
  struct Asking {
    client::AnswerTime when = client::AnswerTime::after;
    std::size_t next = 0;  ///< index of the question; all behind: the farewell
    bool answered = false;
    TimePoint shown;  ///< this question
    TimePoint touched;
  };
  /// What a hand did last that was somebody's doing.
  struct KnownHand {
    Vec3 p_W;
    Vec3 f_W;
    bool holding = false;
  };
  void notice_hands(const client::Frame* frame, TimePoint now);
  void notice_visitor(TimePoint now);
  void follow_run(const client::WorldStatus& status, TimePoint now);
  void ask_or_end(TimePoint now);
  void answer(const std::string& value, TimePoint now);
  void go_on(TimePoint now);
  void leave_alone(TimePoint now);
  [[nodiscard]] const client::Activity* activity() const;
  [[nodiscard]] std::vector<std::string> other_languages() const;
  [[nodiscard]] bool at_beginning() const { return run_ && run_->steps_done == 0 && !run_->done; }
  [[nodiscard]] picture::OverlayPanel panel_of(const client::Activity& activity) const;

  VisitorPanelSettings settings_;
  std::string language_;
  std::shared_ptr<const client::WorldPresentation> presentation_;
  client::Texts exhibit_;  ///< its title
  std::string home_;       ///< empty: the visitor is there, or it is not known
  std::optional<Run> run_;
  TimePoint goal_from_;
  std::optional<Asking> asking_;
  bool asked_before_ = false;  ///< in this run
  bool asked_after_ = false;
  std::optional<TimePoint> last_sign_;  ///< of a visitor; none: there is nobody
  TimePoint stirred_;                   ///< somebody did something last, or this world began
  bool home_requested_ = false;         ///< in this world
  std::map<std::pair<std::string, std::uint32_t>, KnownHand> hands_;  ///< by kiosk and user
  bool began_ = false;
  VisitorRequests requests_;
};

}  // namespace mechane::visit
