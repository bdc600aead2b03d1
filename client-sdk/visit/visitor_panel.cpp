#include "client-sdk/visit/visitor_panel.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "client-sdk/visit/overlay_text.hpp"

namespace mechane::visit {
namespace {

struct PanelWords {
  std::string_view village, home, skip, close, thanks, farewell, going_home;
  std::string_view closed, closed_more, maintenance, maintenance_more;
};

/// The display's own texts, in two languages; a world may have more.
const PanelWords& words_in(const std::string& language) {
  static const PanelWords kEnglish{"Village",
                                   "Home",
                                   "Skip",
                                   "Close",
                                   "Thank you!",
                                   "Your answers help us to make this exhibit better.",
                                   "Is anybody here? Back to the beginning in {} s",
                                   "Closed",
                                   "This exhibit is closed now. Thank you for your visit!",
                                   "Under maintenance",
                                   "This exhibit is being looked after. Please come back later."};
  static const PanelWords kGreek{"Χωριό",
                                 "Αρχή",
                                 "Παράλειψη",
                                 "Κλείσιμο",
                                 "Ευχαριστούμε!",
                                 "Οι απαντήσεις σας μας βοηθούν να κάνουμε το έκθεμα καλύτερο.",
                                 "Είναι κανείς εδώ; Επιστροφή στην αρχή σε {} δ.",
                                 "Κλειστό",
                                 "Αυτό το έκθεμα είναι τώρα κλειστό. Ευχαριστούμε για την επίσκεψή σας!",
                                 "Υπό συντήρηση",
                                 "Αυτό το έκθεμα συντηρείται. Παρακαλούμε ελάτε ξανά αργότερα."};
  return language == "el" ? kGreek : kEnglish;
}

/// The language's own name, short.
std::string language_label(const std::string& code) {
  if (code == "el") return "ΕΛ";
  std::string label = code;
  std::ranges::transform(label, label.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return label;
}

picture::OverlayButton panel_button(picture::OverlayAction::Kind kind, std::string_view text,
                                    const std::string& value = {}) {
  picture::OverlayButton button;
  button.action.kind = kind;
  button.action.value = value;
  button.text = text;
  return button;
}

std::vector<picture::OverlayButton> answer_buttons(const client::Question& question, const std::string& language) {
  std::vector<picture::OverlayButton> buttons;
  const auto add = [&](const std::string& value, const std::string& text) {
    buttons.push_back(panel_button(picture::OverlayAction::Kind::answer, text, value));
  };
  if (question.kind == client::Question::Kind::choice) {
    for (const client::Question::Answer& answer : question.answers)
      add(answer.name, text_in(answer.text, language));
    return buttons;
  }
  for (std::uint32_t mark = 1; mark <= question.marks; ++mark)
    add(std::to_string(mark), std::to_string(mark));
  return buttons;
}

}  // namespace

std::string ask_name(AskWhen when) {
  return when == AskWhen::none ? "none" : when == AskWhen::both ? "both" : "after";
}

AskWhen ask_when(const std::string& name) {
  return name == "none" ? AskWhen::none : name == "both" ? AskWhen::both : AskWhen::after;
}

VisitorPanelSettings panel_settings(const client::DisplaySettings& settings) {
  VisitorPanelSettings out{settings.language,
                           ask_when(settings.ask),
                           {settings.large_text ? picture::kLargeText : 1.0F, settings.high_contrast},
                           std::chrono::duration_cast<Duration>(std::chrono::duration<double>(settings.home_after_s)),
                           settings.sign};
  if (!settings.message_el.empty()) out.message["el"] = settings.message_el;
  if (!settings.message_en.empty()) out.message["en"] = settings.message_en;
  return out;
}

VisitorPanel::VisitorPanel(VisitorPanelSettings settings)
    : settings_(std::move(settings)), language_(settings_.language) {}

const client::Activity* VisitorPanel::activity() const {
  if (!run_ || !presentation_ || presentation_->world != run_->world) return nullptr;
  const auto found = std::ranges::find(presentation_->activities, run_->activity, &client::Activity::name);
  return found == presentation_->activities.end() ? nullptr : &*found;
}

/// The next language, in the world's order.
std::vector<std::string> VisitorPanel::other_languages() const {
  if (!presentation_) return {};
  std::vector<std::string> others = presentation_->languages;
  const auto here = std::ranges::find(others, language_);
  if (here != others.end()) {
    std::rotate(others.begin(), here, others.end());
    others.erase(others.begin());
  }
  return others;
}

void VisitorPanel::notice_visitor(TimePoint now) {
  // A visitor who arrives later at the beginning reads the same as the first one.
  if (!last_sign_ && at_beginning()) goal_from_ = now;
  last_sign_ = stirred_ = now;
}

void VisitorPanel::notice_hands(const client::Frame* frame, TimePoint now) {
  if (frame == nullptr) return;
  for (const client::HandPose& hand : frame->hands) {
    if (hand.stale) continue;
    const KnownHand here{hand.X_WS.front().p, hand.force_W, hand.holding};
    const auto [at, fresh] = hands_.try_emplace({hand.kiosk, hand.user}, here);
    KnownHand& known = at->second;
    // A device in its holder may touch something all the time: only changes show that somebody is there.
    const bool moved = (here.p_W - known.p_W).norm() >= kHandMoved_m;
    const bool felt = (here.f_W - known.f_W).norm() >= kContact_n || here.holding != known.holding;
    if (fresh || !(moved || felt)) continue;
    known = here;
    notice_visitor(now);
  }
}

void VisitorPanel::follow_run(const client::WorldStatus& status, TimePoint now) {
  const bool anew = !run_ || run_->world != status.world || run_->activity != status.activity ||
                    status.steps_done < run_->steps_done || (run_->done && !status.done);
  if (!run_ || run_->world != status.world) {
    hands_.clear();
    stirred_ = now;
    home_requested_ = false;
  }
  if (anew) {
    asking_.reset();
    asked_before_ = asked_after_ = false;
    goal_from_ = now;
  }
  const bool was_done = run_ && run_->done && !anew;
  run_ = Run{status.world, status.activity, status.steps_done, status.done, was_done ? run_->done_from : now};
  if (!at_beginning() && asking_ && asking_->when == client::AnswerTime::before) asking_.reset();
}

/// Asks questions after an activity, when its result has been looked at; before it, as soon as somebody is there.
void VisitorPanel::ask_or_end(TimePoint now) {
  const client::Activity* what = activity();
  if (asking_) {
    const bool farewell = what == nullptr || asking_->next >= what->questions.size();
    if (now - asking_->touched >= (farewell ? kFarewell : kQuestionsWait)) asking_.reset();
    return;
  }
  if (what == nullptr || what->questions.empty()) return;
  if (run_->done && now - run_->done_from >= kAdmires && !asked_after_ && settings_.ask != AskWhen::none) {
    asked_after_ = true;
    asking_ = Asking{client::AnswerTime::after, 0, false, now, now};
  } else if (at_beginning() && !asked_before_ && settings_.ask == AskWhen::both && last_sign_) {
    asked_before_ = true;
    asking_ = Asking{client::AnswerTime::before, 0, false, now, now};
  }
}

void VisitorPanel::update(const VisitorNews& news, TimePoint now) {
  if (!std::exchange(began_, true)) stirred_ = now;
  presentation_ = news.presentation;
  if (news.status != nullptr) exhibit_ = news.status->title;
  home_ = news.status != nullptr && news.home != news.status->scenario ? news.home : std::string();
  if (news.status != nullptr) follow_run(*news.status, now);
  notice_hands(news.frame, now);
  if (last_sign_ && now - *last_sign_ >= kAlone) {
    last_sign_.reset();
    language_ = settings_.language;
    asked_before_ = false;
  }
  ask_or_end(now);
  leave_alone(now);
}

/// Goes home when nobody is there, so that the next visitor can choose an exhibit. Requested once per world.
void VisitorPanel::leave_alone(TimePoint now) {
  if (settings_.home_after <= Duration{0} || home_.empty() || home_requested_ || !run_) return;
  if (now - stirred_ < settings_.home_after) return;
  requests_.home = home_requested_ = true;
}

void VisitorPanel::touch(TimePoint now) {
  notice_visitor(now);
  if (asking_) asking_->touched = now;
}

void VisitorPanel::press(const picture::OverlayAction& action, TimePoint now) {
  touch(now);
  const bool settled = asking_ && now - asking_->shown >= kSettles;
  switch (action.kind) {
    case picture::OverlayAction::Kind::home:
      requests_.home = requests_.home || !home_.empty();
      return;
    case picture::OverlayAction::Kind::language:
      if (std::ranges::count(other_languages(), action.value) > 0) language_ = action.value;
      return;
    case picture::OverlayAction::Kind::answer:
      if (settled) answer(action.value, now);
      return;
    case picture::OverlayAction::Kind::skip:
      if (settled) go_on(now);
      return;
    case picture::OverlayAction::Kind::close:
      if (settled) asking_.reset();
      return;
    case picture::OverlayAction::Kind::activity:
      return;  // handled by the display, which can begin an activity
  }
}

void VisitorPanel::answer(const std::string& value, TimePoint now) {
  const client::Activity* what = activity();
  if (!asking_ || what == nullptr || asking_->next >= what->questions.size()) return;
  const client::Question& question = what->questions[asking_->next];
  const auto is_this = [&](const picture::OverlayButton& button) { return button.action.value == value; };
  if (std::ranges::none_of(answer_buttons(question, language_), is_this)) return;
  asking_->answered = true;
  requests_.answers.push_back({asking_->when, what->name, question.name, value});
  go_on(now);
}

/// The farewell is shown at the end only; before an activity the exhibit simply continues.
void VisitorPanel::go_on(TimePoint now) {
  const client::Activity* what = activity();
  ++asking_->next;
  asking_->shown = asking_->touched = now;
  const bool last = what == nullptr || asking_->next >= what->questions.size();
  if (last && asking_->when == client::AnswerTime::before) asking_.reset();
}

void VisitorPanel::next_language(TimePoint now) {
  touch(now);
  if (const auto others = other_languages(); !others.empty()) language_ = others.front();
}

void VisitorPanel::toggle_large_text() {
  settings_.style.text_scale = settings_.style.text_scale > 1 ? 1 : picture::kLargeText;
}

void VisitorPanel::toggle_high_contrast() {
  settings_.style.high_contrast = !settings_.style.high_contrast;
}

void VisitorPanel::change(const VisitorPanelSettings& settings) {
  settings_ = settings;
  if (!last_sign_) language_ = settings_.language;
}

picture::OverlayPanel VisitorPanel::panel_of(const client::Activity& activity) const {
  const PanelWords& words = words_in(language_);
  picture::OverlayPanel panel;
  panel.title = text_in(exhibit_, language_);
  const std::string task = text_in(activity.title, language_);
  if (!task.empty() && task != panel.title) panel.title += (panel.title.empty() ? "" : " · ") + task;
  panel.questions = static_cast<std::uint32_t>(activity.questions.size());
  panel.asked = static_cast<std::uint32_t>(asking_->next);
  if (asking_->next >= activity.questions.size()) {
    panel.text = words.thanks;
    if (asking_->answered) panel.more = words.farewell;
    panel.leave = panel_button(picture::OverlayAction::Kind::close, words.close);
    return panel;
  }
  const client::Question& question = activity.questions[asking_->next];
  if (asking_->when == client::AnswerTime::before) panel.goal = text_in(activity.goal, language_);
  panel.text = text_in(question.text, language_);
  panel.answers = answer_buttons(question, language_);
  panel.scale = question.kind == client::Question::Kind::scale;
  if (panel.scale) {
    panel.low = text_in(question.low, language_);
    panel.high = text_in(question.high, language_);
  }
  panel.leave = panel_button(picture::OverlayAction::Kind::skip, words.skip);
  return panel;
}

std::string VisitorPanel::message() const {
  return text_in(settings_.message, language_);
}

void VisitorPanel::write(picture::OverlayContent& content, TimePoint now) const {
  content.style = settings_.style;
  const PanelWords& words = words_in(language_);
  if (has_sign()) {
    picture::OverlayPanel panel;
    panel.title = settings_.sign == "closed" ? words.closed : words.maintenance;
    panel.text = settings_.sign == "closed" ? words.closed_more : words.maintenance_more;
    panel.more = message();
    content = {};
    content.style = settings_.style;
    content.panel = std::move(panel);
    return;
  }
  content.message = message();
  if (!home_.empty()) {
    const std::string_view word = home_ == "village" ? words.village : words.home;
    content.corner.push_back(panel_button(picture::OverlayAction::Kind::home, word));
  }
  for (const std::string& code : other_languages())
    content.corner.push_back(panel_button(picture::OverlayAction::Kind::language, language_label(code), code));
  const Duration left = settings_.home_after - (now - stirred_);
  const bool warns = settings_.home_after > Duration{0} && left > Duration{0} && left <= kWarning;
  if (warns && !home_.empty() && run_ && content.note.empty())
    content.note = fmt::format(fmt::runtime(words.going_home), std::chrono::ceil<std::chrono::seconds>(left).count());
  const client::Activity* what = activity();
  if (what == nullptr) return;
  if (asking_) {
    content.panel = panel_of(*what);
  } else if (at_beginning() && now - goal_from_ < kGoal) {
    content.goal = text_in(what->goal, language_);
  }
}

}  // namespace mechane::visit
