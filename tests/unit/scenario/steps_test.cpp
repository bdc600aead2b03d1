// Triggers with several rules, time-outs, sounds, learning goals and questions, from the file to the world.
#include <gtest/gtest.h>

#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::scenario {
namespace {

std::string text_key(const std::string& name, const std::string& words) {
  return "<MetadataString containerField='value' name='" + name + "' value='\"" + words + "\"'/>\n";
}
std::string number_key(const std::string& name, const std::string& number) {
  return "<MetadataDouble containerField='value' name='" + name + "' value='" + number + "'/>\n";
}
std::string set_key(const std::string& name, const std::string& inside) {
  return "<MetadataSet containerField='value' name='" + name + "'>\n" + inside + "</MetadataSet>\n";
}
std::string rule(const std::string& quantity, const std::string& op, const std::string& value) {
  return text_key("quantity", quantity) + text_key("op", op) + number_key("value", value);
}

const std::string kFill = "<MetadataSet containerField='value' name='fill'>\n";

/// The shipped file with more keys in its step 'fill'.
Outcome with_fill(const std::string& keys) {
  return compile_text(edited(kFill, kFill + keys));
}

const state::StepDescription& fill_of(const Outcome& outcome) {
  return outcome.world->steps[outcome.world->find_step("fill").index()];
}

TEST(Steps, ATriggerMayHaveSeveralRules) {
  const Outcome outcome =
      with_fill(set_key("trigger:2", set_key("rule:1", rule("speed", "&lt;", "5") + number_key("tolerance", "0.5")) +
                                         set_key("rule:2", rule("turns", "=", "3")) + text_key("match", "any") +
                                         number_key("holdSeconds", "2") + text_key("next", "turn")));
  ASSERT_TRUE(outcome.world) << outcome.world.error().to_string();
  EXPECT_TRUE(outcome.problems.empty()) << to_string(outcome.problems[0]);
  const state::TriggerDescription& trigger = fill_of(outcome).triggers.front();
  EXPECT_TRUE(trigger.any);
  EXPECT_EQ(trigger.hold_s, 2);
  EXPECT_EQ(trigger.quantity, outcome.world->find_quantity("speed"));
  EXPECT_EQ(trigger.comparison, state::Comparison::less);
  EXPECT_EQ(trigger.tolerance, 0.5);
  ASSERT_EQ(trigger.more.size(), 1u);
  EXPECT_EQ(trigger.more[0].quantity, outcome.world->find_quantity("turns"));
  EXPECT_EQ(trigger.more[0].comparison, state::Comparison::equal);
  EXPECT_EQ(trigger.next, outcome.world->find_step("turn"));
}

TEST(Steps, ARuleOfItsOwnCountsBesideTheOthers) {
  const Outcome outcome =
      with_fill(set_key("trigger:2", rule("speed", "&lt;", "5") + set_key("rule:1", rule("turns", ">", "3"))));
  ASSERT_TRUE(outcome.world) << outcome.world.error().to_string();
  EXPECT_FALSE(fill_of(outcome).triggers.front().any) << "all must hold, where nothing is said";
  EXPECT_EQ(fill_of(outcome).triggers.front().more.size(), 1u);
}

TEST(Steps, ATimeOutLeadsOn) {
  const Outcome outcome = with_fill(number_key("timeoutSeconds", "45") + text_key("timeoutNext", "turn"));
  ASSERT_TRUE(outcome.world) << outcome.world.error().to_string();
  EXPECT_EQ(fill_of(outcome).timeout_s, 45);
  EXPECT_EQ(fill_of(outcome).timeout_next, outcome.world->find_step("turn"));
  const Outcome end = with_fill(number_key("timeoutSeconds", "45"));
  ASSERT_TRUE(end.world);
  EXPECT_FALSE(fill_of(end).timeout_next);
  EXPECT_EQ(fill_of(compile_text(text_of(shipped_file()))).timeout_s, 0);
}

TEST(Steps, AStepMayOpenAnotherScenario) {
  const Outcome outcome = with_fill(text_key("opens", "catapult"));
  ASSERT_TRUE(outcome.world) << outcome.world.error().to_string();
  EXPECT_EQ(fill_of(outcome).opens, "catapult");
  EXPECT_EQ(fill_of(compile_text(text_of(shipped_file()))).opens, "");
}

TEST(Steps, SoundsAreNamedByLanguage) {
  const Outcome outcome =
      compile_text(edited("<MetadataString containerField='value' name='hint.el' value='\"Το νερό βγαίνει",
                          text_key("audio.el", "audio/fill.el.ogg") + text_key("audio.en", "audio/fill.en.ogg") +
                              "<MetadataString containerField='value' name='hint.el' value='\"Το νερό βγαίνει"));
  ASSERT_TRUE(outcome.world) << outcome.world.error().to_string();
  EXPECT_EQ(fill_of(outcome).texts.at("audio").at("en"), "audio/fill.en.ogg");
}

std::string yes_no(const std::string& name, bool value) {
  return "<MetadataBoolean containerField='value' name='" + name + "' value='" + (value ? "true" : "false") + "'/>\n";
}

TEST(Steps, AStepGivesABodyItsWeight) {
  const Outcome outcome = with_fill(set_key("object:INNER", yes_no("useGlobalGravity", true)));
  ASSERT_TRUE(outcome.world) << outcome.world.error().to_string();
  ASSERT_EQ(fill_of(outcome).bodies.size(), 1u);
  EXPECT_EQ(fill_of(outcome).bodies[0].use_gravity, std::optional(true));
  EXPECT_FALSE(fill_of(outcome).bodies[0].movable) << "the rest is as it was";
  EXPECT_FALSE(fill_of(with_fill(set_key("object:INNER", yes_no("movable", true)))).bodies[0].use_gravity);
}

TEST(Steps, WeightForWhatCannotFallIsToldToItsAuthor) {
  const Outcome fixed = with_fill(set_key("object:OUTER", yes_no("useGlobalGravity", true)));
  EXPECT_EQ(fixed.find(ErrorCode::conflict, kAnyLine, "cannot fall").severity, x3d::Severity::error);
  EXPECT_TRUE(with_fill(set_key("object:OUTER", yes_no("useGlobalGravity", false))).world) << "it does not anyway";
  const std::string text = with_edits({{kFill, kFill + set_key("object:INNER", yes_no("useGlobalGravity", true))},
                                       {"gravity='0 -9.81 0'", "gravity='0 0 0'"}});
  EXPECT_EQ(compile_text(text).find(ErrorCode::conflict, line_of(text, "useGlobalGravity' value"), "0 0 0").severity,
            x3d::Severity::warning);
}

/// The shipped file, with more questions before those of 'use'.
Outcome with_questions(const std::string& more) {
  const std::string first = "<MetadataSet containerField='value' name='lifts'>\n";
  return compile_text(edited(first, more + first));
}

TEST(Activities, HaveAGoalAndQuestions) {
  const Outcome outcome = with_questions(
      set_key("why",
              text_key("kind", "choice") +
                  "<MetadataString containerField='value' name='answers' value='\"tilt\" \"speed\"'/>\n" +
                  text_key("correct", "tilt") +
                  set_key("text", text_key("question.el", "Γιατί;") + text_key("question.en", "Why?") +
                                      text_key("answer:tilt.el", "κλίση") + text_key("answer:tilt.en", "tilt") +
                                      text_key("answer:speed.el", "ταχύτητα") + text_key("answer:speed.en", "speed"))) +
      set_key("liked",
              text_key("kind", "scale") + number_key("steps", "7") +
                  set_key("text", text_key("question.el", "Σας άρεσε;") + text_key("question.en", "Did you like it?") +
                                      text_key("low.el", "όχι") + text_key("low.en", "no") +
                                      text_key("high.el", "ναι") + text_key("high.en", "yes"))));
  ASSERT_TRUE(outcome.world) << outcome.world.error().to_string();
  EXPECT_TRUE(outcome.problems.empty()) << to_string(outcome.problems[0]);
  const auto& use = outcome.world->activities[outcome.world->find_activity("use").index()];
  EXPECT_EQ(use.goal.at("en"), "To see how plain turning lifts water: each turn brings it a little higher.");
  ASSERT_EQ(use.questionnaire.size(), 4u);
  const auto& why = use.questionnaire[0];
  EXPECT_EQ(why.kind, state::QuestionDescription::Kind::choice);
  ASSERT_EQ(why.answers.size(), 2u);
  EXPECT_EQ(why.answers[1].name, "speed");
  EXPECT_EQ(why.answers[1].text.at("el"), "ταχύτητα");
  EXPECT_EQ(why.correct, "tilt");
  const auto& liked = use.questionnaire[1];
  EXPECT_EQ(liked.kind, state::QuestionDescription::Kind::scale);
  EXPECT_EQ(liked.marks, 7);
  EXPECT_EQ(liked.high.at("en"), "yes");
}

TEST(Steps, FaultsHaveCodeAndRemedy) {
  using enum ErrorCode;
  const x3d::Severity error = x3d::Severity::error, warning = x3d::Severity::warning;
  const auto key = [](const std::string& name, const std::string& words) { return text_key(name, words); };
  const auto expect = [](const Outcome& outcome, ErrorCode code, const std::string& name, x3d::Severity severity) {
    const x3d::Problem problem = outcome.find(code, kAnyLine, name);
    EXPECT_EQ(problem.severity, severity) << to_string(problem);
  };
  expect(with_fill(number_key("timeoutSeconds", "45") + key("timeoutNext", "trun")), unknown_name,
         "did you mean 'turn'?", error);
  expect(with_fill(key("timeoutNext", "turn")), conflict, "timeoutNext", warning);
  expect(with_fill(text_key("opens", "../village/village.x3d")), invalid_value, "'../village/village.x3d'", error);
  expect(with_fill(text_key("opens", "")), invalid_value, "'' cannot be", error);
  const std::string first = "<MetadataSet containerField='value' name='grasp'>\n";
  expect(compile_text(edited(first, first + text_key("opens", "catapult"))), conflict, "step grasp", error);
  expect(with_fill(number_key("timeoutSecond", "4")), unknown_name, "did you mean 'timeoutSeconds'?", error);
  expect(with_fill(set_key("trigger:2", set_key("rule:1", rule("trns", ">", "1")))), unknown_name,
         "did you mean 'turns'?", error);
  expect(with_fill(set_key("trigger:2", rule("turns", ">", "1") + key("match", "any"))), conflict, "match", warning);
  expect(with_fill(set_key("trigger:2", set_key("rule:1", key("quantity", "turns")))), missing, "'op'", error);
  expect(with_fill(set_key("trigger:2", key("next", "turn"))), missing, "'quantity'", error);
  expect(with_fill(set_key("triger:2", rule("turns", ">", "1"))), unknown_name, "did you mean 'trigger:2'?", error);
  expect(with_questions(set_key("q", key("kind", "multiple") + set_key("text", key("question.en", "Why?")))),
         invalid_value, "'multiple' is not one of: choice scale", error);
  expect(with_questions(set_key("q", key("kind", "choice") + set_key("text", key("question.en", "Why?")))), missing,
         "answers", error);
}

TEST(Steps, ARuleThatCanNeverHoldIsAnError) {
  // The hinge gets stops, so that its angle has a range; the pump's basin has one of its own (see check_nodes_test).
  const std::string text =
      edited("<SingleAxisHingeJoint DEF='AXLE'", "<SingleAxisHingeJoint minAngle='-1' maxAngle='6.2831853' DEF='AXLE'");
  const std::string turns = "value='\"COUNTER.turns\"'";
  std::string stopped = text;
  stopped.replace(stopped.find(turns), turns.size(), "value='\"AXLE.turns\"'");
  const Outcome outcome = compile_text(stopped);
  EXPECT_FALSE(outcome.world);
  EXPECT_EQ(outcome.find(ErrorCode::conflict, kAnyLine, "'turns' goes from").severity, x3d::Severity::error);
  const Outcome placed =
      compile_text(edited("name='value' value='1'/>\n                  <MetadataDouble "
                          "containerField='value' name='holdSeconds' value='0.3'/>",
                          "name='value' value='2'/>\n"));
  EXPECT_FALSE(placed.world);
  static_cast<void>(placed.find(ErrorCode::conflict, kAnyLine, "'seated' goes from 0 to 1"));
}

TEST(Steps, OnlyAnAgentThatSwitchesAJointOpensItAtTheStart) {
  std::string text = edited(
      "<MetadataSet containerField='value' name='SEATED'>",
      set_key("PAWL", text_key("type", "geometry.ratchet") + text_key("joint", "SPIN") + number_key("teeth", "12")) +
          "<MetadataSet containerField='value' name='SEATED'>");
  const std::string end = "</RigidBodyCollection>";
  text.replace(text.find(end), end.size(),
               "<SingleAxisHingeJoint DEF='SPIN' axis='0 0 1'><RigidBody containerField='body1' USE='OUTER'/>"
               "<RigidBody containerField='body2' USE='INNER'/></SingleAxisHingeJoint></RigidBodyCollection>");
  text.replace(text.find(kFill), kFill.size(), kFill + text_key("enable", "PAWL"));
  const Outcome outcome = compile_text(text);
  ASSERT_TRUE(outcome.world) << outcome.world.error().to_string();
  const auto on_at_start = [&](const std::string& name) {
    return outcome.world->joints[outcome.world->find_joint(name).index()].enabled_at_start;
  };
  EXPECT_TRUE(on_at_start("SPIN")) << "a ratchet holds its joint, and does not switch it";
  EXPECT_FALSE(on_at_start("AXLE")) << "a step enables its hinge";
}

}  // namespace
}  // namespace mechane::scenario
