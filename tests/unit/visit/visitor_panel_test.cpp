#include "client-sdk/visit/visitor_panel.hpp"

#include <gtest/gtest.h>

namespace mechane::visit {
namespace {

using Press = picture::OverlayAction::Kind;
using std::chrono::milliseconds;
using std::chrono::seconds;

client::Question drum_choice() {
  client::Question question;
  question.name = "drum";
  question.text = {{"en", "Which drum?"}, {"el", "Ποιο τύμπανο;"}};
  question.answers = {{"first", {{"en", "The first"}, {"el", "Το πρώτο"}}}, {"last", {{"en", "The last"}}}};
  return question;
}

client::Question clear_scale() {
  client::Question question;
  question.name = "clear";
  question.kind = client::Question::Kind::scale;
  question.text = {{"en", "How clear?"}};
  question.marks = 5;
  question.low = {{"en", "Hard"}};
  question.high = {{"en", "Easy"}};
  return question;
}

/// A visit that a test turns, and the display's clock.
class VisitorPanelTest : public testing::Test {
 protected:
  VisitorPanelTest() {
    status.world = "w1";
    status.scenario = "odometer";
    status.activity = "use";
    status.steps_total = 3;
    auto known = std::make_shared<client::WorldPresentation>();
    known->world = "w1";
    known->languages = {"el", "en"};
    known->activities = {{"use", {{"en", "Measure"}}, {{"en", "See how"}}, {drum_choice(), clear_scale()}},
                         {"rest", {{"en", "Rest"}}, {}, {}}};
    presentation = known;
    frame.hands.resize(1);
  }
  picture::OverlayContent look(VisitorPanel& panel, Duration later = milliseconds(500)) {
    now += later;
    panel.update({&status, presentation, &frame, "village"}, now);
    picture::OverlayContent content;
    panel.write(content, now);
    return content;
  }
  /// The activity is done; the next look is the first at which something may be asked.
  picture::OverlayContent finish(VisitorPanel& panel) {
    status.done = true;
    (void)look(panel);
    return look(panel, VisitorPanel::kAdmires - milliseconds(500));
  }
  void press(VisitorPanel& panel, Press kind, const std::string& value = "") { panel.press({kind, value}, now); }
  void move_hand() { frame.hands[0].X_WS[0].p.x() += 0.05; }

  client::WorldStatus status;
  std::shared_ptr<const client::WorldPresentation> presentation;
  client::Frame frame;
  TimePoint now{seconds(1000)};
};

TEST_F(VisitorPanelTest, questions_say_of_which_exhibit_and_task_they_are) {
  VisitorPanel panel({"en", AskWhen::after, {}});
  (void)finish(panel);
  const auto heading = [&](const client::Texts& exhibit) {
    status.title = exhibit;
    const auto shown = look(panel).panel;
    return shown ? shown->title : "no panel";
  };
  EXPECT_EQ(heading({{"en", "Vitruvius' odometer"}}), "Vitruvius' odometer · Measure");
  EXPECT_EQ(heading({{"en", "Measure"}}), "Measure") << "once";
  EXPECT_EQ(heading({}), "Measure");
}

TEST_F(VisitorPanelTest, the_way_home_is_offered_where_it_leads_elsewhere) {
  VisitorPanel panel({"en", AskWhen::after, {}});
  const picture::OverlayContent away = look(panel);
  ASSERT_EQ(away.corner.size(), 2U);
  EXPECT_EQ(away.corner[0].action.kind, Press::home);
  EXPECT_EQ(away.corner[0].text, "Village");
  press(panel, Press::home);
  EXPECT_TRUE(panel.take_requests().home);
  EXPECT_FALSE(panel.take_requests().home);
  status.scenario = "village";
  const picture::OverlayContent there = look(panel);
  ASSERT_EQ(there.corner.size(), 1U);
  EXPECT_EQ(there.corner[0].action.kind, Press::language);
  press(panel, Press::home);
  EXPECT_FALSE(panel.take_requests().home);
}

TEST_F(VisitorPanelTest, a_message_is_written_in_the_language_of_the_display) {
  client::DisplaySettings settings;
  settings.message_el = "Γεια";
  settings.message_en = "Hello";
  VisitorPanel panel(panel_settings(settings));
  EXPECT_EQ(look(panel).message, "Γεια");
  settings.language = "en";
  panel.change(panel_settings(settings));
  EXPECT_EQ(look(panel).message, "Hello");
  settings.message_en = "";
  panel.change(panel_settings(settings));
  EXPECT_EQ(look(panel).message, "Γεια") << "better than nothing";
}

TEST_F(VisitorPanelTest, a_sign_takes_all_other_words_away) {
  client::DisplaySettings settings;
  settings.language = "en";
  settings.sign = "maintenance";
  EXPECT_TRUE(settings.silent());
  VisitorPanel panel(panel_settings(settings));
  picture::OverlayContent content;
  content.caption = "Turn the crank";
  panel.update({&status, presentation, &frame, "village"}, now);
  panel.write(content, now);
  EXPECT_EQ(content.caption, "");
  EXPECT_TRUE(content.corner.empty());
  ASSERT_TRUE(content.panel);
  EXPECT_EQ(content.panel->title, "Under maintenance");
  EXPECT_TRUE(content.panel->answers.empty() && !content.panel->leave) << "there is nothing to press";
}

TEST_F(VisitorPanelTest, a_kiosk_that_is_left_alone_goes_home_by_itself) {
  VisitorPanel panel({"en", AskWhen::none, {}, seconds(60)});
  look(panel);
  move_hand();
  look(panel, seconds(40));
  EXPECT_EQ(look(panel, seconds(45)).note, "") << "it is counted from the last motion";
  EXPECT_EQ(look(panel, milliseconds(7500)).note, "Is anybody here? Back to the beginning in 8 s");
  panel.touch(now);
  EXPECT_EQ(look(panel, seconds(5)).note, "");
  EXPECT_FALSE(panel.take_requests().home);
  look(panel, seconds(56));
  EXPECT_TRUE(panel.take_requests().home);
  look(panel, seconds(100));
  EXPECT_FALSE(panel.take_requests().home) << "once: who cannot go home is not asked again and again";
  status.world = "w2";
  status.scenario = "village";
  look(panel, seconds(1));
  look(panel, seconds(100));
  EXPECT_FALSE(panel.take_requests().home) << "it is at home";
  VisitorPanel patient({"en", AskWhen::none, {}});
  look(patient, seconds(1));
  look(patient, seconds(100'000));
  EXPECT_FALSE(patient.take_requests().home);
}

TEST_F(VisitorPanelTest, another_language_stays_while_somebody_is_there) {
  VisitorPanel panel({"el", AskWhen::after, {}});
  EXPECT_EQ(look(panel).corner.back().text, "EN");
  press(panel, Press::language, "en");
  EXPECT_EQ(panel.language(), "en");
  EXPECT_EQ(look(panel).corner.back().text, "ΕΛ");
  (void)look(panel, seconds(80));
  move_hand();
  (void)look(panel, seconds(5));
  (void)look(panel, seconds(89));
  EXPECT_EQ(panel.language(), "en");
  (void)look(panel, seconds(1));
  EXPECT_EQ(panel.language(), "el");
}

TEST_F(VisitorPanelTest, a_hand_that_trembles_or_is_stale_is_nobody) {
  VisitorPanel panel({"el", AskWhen::after, {}});
  (void)look(panel);
  panel.next_language(now);
  EXPECT_EQ(panel.language(), "en");
  for (int i = 0; i < 100; ++i) {
    frame.hands[0].X_WS[0].p.x() = i % 2 == 0 ? 0.004 : 0;
    (void)look(panel, seconds(1));
  }
  EXPECT_EQ(panel.language(), "el");
  panel.next_language(now);
  frame.hands[0].stale = true;
  for (int i = 0; i < 100; ++i) {
    move_hand();
    (void)look(panel, seconds(1));
  }
  EXPECT_EQ(panel.language(), "el");
}

TEST_F(VisitorPanelTest, a_language_that_the_world_does_not_have_is_not_taken) {
  VisitorPanel panel({"el", AskWhen::after, {}});
  (void)look(panel);
  press(panel, Press::language, "fr");
  EXPECT_EQ(panel.language(), "el");
}

TEST_F(VisitorPanelTest, questions_come_one_by_one_after_the_activity_with_a_farewell) {
  VisitorPanel panel({"en", AskWhen::after, {}});
  EXPECT_FALSE(look(panel).panel);
  status.steps_done = 3;
  EXPECT_FALSE(finish(panel).panel) << "first the visitor looks at what was done";
  const auto first = look(panel).panel;
  ASSERT_TRUE(first);
  EXPECT_EQ(first->text, "Which drum?");
  ASSERT_EQ(first->answers.size(), 2U);
  EXPECT_EQ(first->answers[1].text, "The last");
  now += milliseconds(500);
  press(panel, Press::answer, "last");
  const auto second = look(panel).panel;
  ASSERT_TRUE(second);
  EXPECT_TRUE(second->scale);
  EXPECT_EQ(second->answers.size(), 5U);
  EXPECT_EQ(second->low, "Hard");
  press(panel, Press::answer, "4");
  const auto farewell = look(panel).panel;
  ASSERT_TRUE(farewell);
  EXPECT_TRUE(farewell->answers.empty());
  EXPECT_EQ(farewell->text, "Thank you!");
  const auto given = panel.take_requests().answers;
  ASSERT_EQ(given.size(), 2U);
  EXPECT_EQ(given[0].activity, "use");
  EXPECT_EQ(given[0].question, "drum");
  EXPECT_EQ(given[0].answer, "last");
  EXPECT_EQ(given[0].when, client::AnswerTime::after);
  EXPECT_EQ(given[1].answer, "4");
  EXPECT_FALSE(look(panel, VisitorPanel::kFarewell).panel);
  EXPECT_FALSE(look(panel).panel) << "nobody is asked twice";
}

TEST_F(VisitorPanelTest, what_is_skipped_is_not_answered_and_not_thanked_for) {
  VisitorPanel panel({"en", AskWhen::after, {}});
  (void)finish(panel);
  for (int i = 0; i < 2; ++i) {
    (void)look(panel);
    press(panel, Press::skip);
  }
  const auto farewell = look(panel).panel;
  ASSERT_TRUE(farewell);
  EXPECT_TRUE(farewell->more.empty());
  EXPECT_TRUE(panel.take_requests().answers.empty());
}

TEST_F(VisitorPanelTest, a_double_tap_answers_once_and_a_wrong_name_never) {
  VisitorPanel panel({"en", AskWhen::after, {}});
  (void)finish(panel);
  (void)look(panel);
  (void)look(panel);
  press(panel, Press::answer, "no such answer");
  press(panel, Press::answer, "first");
  now += milliseconds(200);
  press(panel, Press::skip);
  const auto second = look(panel, milliseconds(10)).panel;
  ASSERT_TRUE(second);
  EXPECT_TRUE(second->scale) << "the second question is still there";
  EXPECT_EQ(panel.take_requests().answers.size(), 1U);
}

TEST_F(VisitorPanelTest, questions_go_when_nobody_clicks_or_the_visit_goes_on) {
  for (const char* reason : {"nobody", "anew", "another"}) {
    VisitorPanel panel({"en", AskWhen::after, {}});
    status.activity = "use";
    (void)finish(panel);
    ASSERT_TRUE(look(panel).panel) << reason;
    panel.touch(now += seconds(40));
    EXPECT_TRUE(look(panel, seconds(44)).panel) << reason;
    if (reason == std::string("nobody")) {
      EXPECT_FALSE(look(panel, seconds(1)).panel);
      continue;
    }
    status.done = false;
    if (reason == std::string("another")) status.activity = "rest";
    EXPECT_FALSE(look(panel).panel) << reason;
    status.activity = "use";
    (void)finish(panel);
    EXPECT_TRUE(look(panel).panel) << "the next visitor is asked";
  }
}

TEST_F(VisitorPanelTest, questions_do_not_stay_for_a_visitor_who_does_something_else) {
  VisitorPanel panel({"en", AskWhen::after, {}});
  (void)finish(panel);
  ASSERT_TRUE(look(panel).panel);
  for (Duration waited{0}; waited < VisitorPanel::kQuestionsWait; waited += seconds(1)) {
    panel.notice_visitor(now);
    (void)look(panel, seconds(1));
  }
  EXPECT_FALSE(look(panel).panel);
  EXPECT_LT(panel.alone_for(now), seconds(2));
}

TEST_F(VisitorPanelTest, asks_before_only_where_told_and_when_somebody_is_there) {
  VisitorPanel after({"en", AskWhen::after, {}});
  VisitorPanel both({"en", AskWhen::both, {}});
  (void)look(after);
  EXPECT_FALSE(look(both).panel);
  move_hand();
  EXPECT_FALSE(look(after).panel);
  const auto panel = look(both).panel;
  ASSERT_TRUE(panel);
  EXPECT_EQ(panel->goal, "See how");
  (void)look(both);
  press(both, Press::answer, "first");
  const auto given = both.take_requests().answers;
  ASSERT_EQ(given.size(), 1U);
  EXPECT_EQ(given[0].when, client::AnswerTime::before);
  status.steps_done = 1;
  EXPECT_FALSE(look(both).panel) << "who works is not asked";
  (void)finish(both);
  EXPECT_TRUE(look(both).panel);
  VisitorPanel none({"en", AskWhen::none, {}});
  (void)finish(none);
  EXPECT_FALSE(look(none).panel);
}

TEST_F(VisitorPanelTest, the_goal_stands_at_the_beginning_and_for_who_comes_late) {
  VisitorPanel panel({"en", AskWhen::after, {}});
  EXPECT_EQ(look(panel).goal, "See how");
  EXPECT_EQ(look(panel, milliseconds(7900)).goal, "See how");
  EXPECT_EQ(look(panel, milliseconds(100)).goal, "");
  move_hand();
  EXPECT_EQ(look(panel, seconds(60)).goal, "See how");
  status.steps_done = 1;
  EXPECT_EQ(look(panel).goal, "");
}

TEST_F(VisitorPanelTest, a_presentation_of_another_world_asks_nothing) {
  VisitorPanel panel({"en", AskWhen::after, {}});
  status.world = "w2";
  (void)finish(panel);
  EXPECT_FALSE(look(panel).panel);
  status.world = "w1";
  (void)finish(panel);
  EXPECT_TRUE(look(panel).panel);
}

TEST_F(VisitorPanelTest, keys_change_how_words_look) {
  VisitorPanel panel({"en", AskWhen::after, {}});
  panel.toggle_large_text();
  panel.toggle_high_contrast();
  picture::OverlayContent content = look(panel);
  EXPECT_FLOAT_EQ(content.style.text_scale, picture::kLargeText);
  EXPECT_TRUE(content.style.high_contrast);
  panel.toggle_large_text();
  EXPECT_FLOAT_EQ(look(panel).style.text_scale, 1);
}

TEST_F(VisitorPanelTest, who_presses_or_grasps_without_moving_is_somebody) {
  VisitorPanel panel({"en", AskWhen::none, {}, seconds(60)});
  look(panel);
  EXPECT_EQ(panel.alone_for(now), Duration{0}) << "it is counted from the display's start";
  look(panel, seconds(30));
  EXPECT_EQ(panel.alone_for(now), seconds(30));
  frame.hands[0].force_W = Vec3(0, 2, 0);
  look(panel, seconds(1));
  EXPECT_EQ(panel.alone_for(now), Duration{0}) << "it pushes";
  look(panel, seconds(30));
  EXPECT_EQ(panel.alone_for(now), seconds(30)) << "a device in its rest pushes for ever";
  frame.hands[0].holding = true;
  look(panel, seconds(1));
  EXPECT_EQ(panel.alone_for(now), Duration{0}) << "it grasps";
  look(panel, seconds(5));
  frame.hands[0].force_W = Vec3(0, 2.3, 0);
  look(panel, seconds(5));
  EXPECT_EQ(panel.alone_for(now), seconds(10)) << "a small change is the device's own";
  panel.touch(now);
  EXPECT_EQ(panel.alone_for(now), Duration{0});
}

TEST_F(VisitorPanelTest, from_afar_the_language_of_a_visitor_is_not_taken_away) {
  VisitorPanel panel({"el", AskWhen::none, {}});
  look(panel);
  panel.change({"en", AskWhen::both, {picture::kLargeText, true}, seconds(30)});
  EXPECT_EQ(panel.language(), "en") << "nobody is there: at once";
  EXPECT_EQ(look(panel).style.text_scale, picture::kLargeText);
  EXPECT_TRUE(look(panel).style.high_contrast);
  move_hand();
  look(panel);
  panel.change({"el", AskWhen::none, {}, seconds(1000)});
  EXPECT_EQ(look(panel).corner.back().text, "ΕΛ") << "somebody reads";
  look(panel, seconds(91));
  EXPECT_EQ(panel.language(), "el");
}

TEST(AskWhen, each_has_a_name) {
  for (const AskWhen when : {AskWhen::none, AskWhen::after, AskWhen::both})
    EXPECT_EQ(ask_when(ask_name(when)), when);
}

}  // namespace
}  // namespace mechane::visit
