// The buttons and panels over the picture, and what follows from pressing them: going home, another language, questions
// about an activity, text size and contrast. Without a clock, a window or a network of its own: the display passes the
// time of its steady clock.
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
/// An unknown name means `after`.
[[nodiscard]] AskWhen ask_when(const std::string& name);

struct VisitorPanelSettings {
  std::string language = "el";  ///< the display returns to it when a visitor has gone
  AskWhen ask = AskWhen::after;
  picture::OverlayStyle style;
  Duration home_after{0};     ///< goes home after this time without a hand's motion or a click; 0: never
  std::string sign = "none";  ///< none, closed, maintenance
  std::map<std::string, std::string> message{};  ///< the museum's words to visitors, by language; empty: none
};

/// As a technician has set them for a display.
[[nodiscard]] VisitorPanelSettings panel_settings(const client::DisplaySettings& settings);

/// What is known now. Null: not known yet.
struct VisitorNews {
  const client::WorldStatus* status = nullptr;
  std::shared_ptr<const client::WorldPresentation> presentation{};
  const client::Frame* frame = nullptr;
  std::string home{};  ///< id of the home scenario; empty: not known
};

/// What the display must do for the visitor.
struct VisitorRequests {
  bool home = false;
  std::vector<client::VisitAnswer> answers;  ///< oldest first
};

class VisitorPanel {
 public:
  /// After this time without a click, nobody is answering.
  static constexpr Duration kQuestionsWait = std::chrono::seconds(45);
  static constexpr Duration kFarewell = std::chrono::seconds(6);
  /// Time to look at the result before questions about it.
  static constexpr Duration kAdmires = std::chrono::seconds(4);
  /// The second tap of a double tap does not count as an answer.
  static constexpr Duration kSettles = std::chrono::milliseconds(400);
  static constexpr Duration kGoal = std::chrono::seconds(8);
  /// After this time without a hand's motion or a click, the visitor has gone.
  static constexpr Duration kAlone = std::chrono::seconds(90);
  static constexpr Duration kWarning = std::chrono::seconds(10);  ///< shown before it goes home by itself
  static constexpr double kHandMoved_m = 0.005;                   ///< smaller motions are a device's trembling
  static constexpr double kContact_n = 0.5;                       ///< smaller changes of force are a resting hand's

  explicit VisitorPanel(VisitorPanelSettings settings);

  /// Call it once a picture.
  void update(const VisitorNews& news, TimePoint now);
  /// A button was pressed. One that is no longer offered does nothing.
  void press(const picture::OverlayAction& action, TimePoint now);
  /// A click outside all buttons shows that somebody is there.
  void touch(TimePoint now);
  /// Somebody is there, but not at the questions: these do not stay longer for it.
  void notice_visitor(TimePoint now);
  /// Changes to the world's next language.
  void next_language(TimePoint now);
  void toggle_large_text();
  void toggle_high_contrast();
  /// Settings from a technician at another machine. The language changes at once if nobody is there, else when the
  /// visitor has gone.
  void change(const VisitorPanelSettings& settings);
  [[nodiscard]] const VisitorPanelSettings& settings() const { return settings_; }
  /// How long nobody has moved a hand, touched a thing or clicked.
  [[nodiscard]] Duration alone_for(TimePoint now) const { return began_ ? now - stirred_ : Duration{0}; }

  /// Code of the present language of all texts.
  [[nodiscard]] const std::string& language() const { return language_; }
  /// A sign stands instead of all other words: no visitor can do anything here.
  [[nodiscard]] bool has_sign() const { return settings_.sign != "none"; }
  /// The museum's words to visitors, in the present language; empty: none.
  [[nodiscard]] std::string message() const;
  /// Adds what is offered now, and the museum's message or sign. Call it last: a sign takes other words away.
  void write(picture::OverlayContent& content, TimePoint now) const;
  [[nodiscard]] VisitorRequests take_requests() { return std::exchange(requests_, {}); }

 private:
  /// One run of an activity.
  struct Run {
    std::string world;
    std::string activity;
    std::uint32_t steps_done = 0;
    bool done = false;
    TimePoint done_from;
  };
  struct Asking {
    client::AnswerTime when = client::AnswerTime::after;
    std::size_t next = 0;  ///< index of the question; after the last one comes the farewell
    bool answered = false;
    TimePoint shown;  ///< when this question was first shown
    TimePoint touched;
  };
  /// The last state of a hand that showed somebody's presence.
  struct KnownHand {
    Vec3 p_W;
    Vec3 f_W;
    bool holding = false;
  };
  void notice_hands(const client::Frame* frame, TimePoint now);
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
  std::string home_;       ///< empty: the visitor is at home, or it is not known
  std::optional<Run> run_;
  TimePoint goal_from_;
  std::optional<Asking> asking_;
  bool asked_before_ = false;  ///< in this run
  bool asked_after_ = false;
  std::optional<TimePoint> last_sign_;  ///< last sign of a visitor; none: nobody is there
  TimePoint stirred_;                   ///< when somebody last did something, or this world began
  bool home_requested_ = false;         ///< in this world
  std::map<std::pair<std::string, std::uint32_t>, KnownHand> hands_;  ///< by kiosk and user
  bool began_ = false;
  VisitorRequests requests_;
};

}  // namespace mechane::visit
