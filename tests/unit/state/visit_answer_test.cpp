// A visitor's answer is one of those that were asked for, or none.
#include "server/state/visit_answer.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::state {
namespace {

WorldDescription museum() {
  WorldDescription world;
  QuestionDescription why, liked;
  why.name = "why";
  why.answers = {{"pitch", {}}, {"speed=fast", {}}};
  liked.name = "liked";
  liked.kind = QuestionDescription::Kind::scale;
  liked.marks = 5;
  ActivityDescription build, use;
  build.name = "build";
  use.name = "use";
  use.questionnaire = {why, liked};
  world.activities = {build, use};
  return world;
}

TEST(VisitAnswer, IsRead) {
  const auto choice = parse_visit_answer("before:use/why=speed=fast", museum());
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->activity.index(), 1U);
  EXPECT_EQ(choice->question, 0U);
  EXPECT_EQ(choice->answer, 1U);
  EXPECT_EQ(choice->when, AnswerTime::before);
  const auto mark = parse_visit_answer("after:use/liked=5", museum());
  ASSERT_TRUE(mark);
  EXPECT_EQ(mark->question, 1U);
  EXPECT_EQ(mark->answer, 5U);
  EXPECT_EQ(mark->when, AnswerTime::after);
}

TEST(VisitAnswer, WhatNobodyAskedIsRefused) {
  for (const char* wrong :
       {"", "use/why=pitch", "later:use/why=pitch", "before:use/why=", "before:use/why", "before:build/why=pitch",
        "before:use/liked=0", "before:use/liked=6", "before:use/liked=1.5", "before:use/liked=-1",
        "before:use/liked=99999999999", "after:use/liked=4x", "after:use/liked=+4",
        "after:use/liked=", "after:use/why=speed", "after:use/what=pitch", "after:/=", "after:use"})
    EXPECT_FALSE(parse_visit_answer(wrong, museum())) << wrong;
}

RC_GTEST_PROP(VisitAnswer, NoBytesDoHarm, (const std::string& bytes)) {
  const WorldDescription world = museum();
  for (const std::string& argument : {bytes, "before:use/" + bytes, "after:use/liked=" + bytes}) {
    const auto answer = parse_visit_answer(argument, world);
    if (!answer) continue;
    const auto& questions = world.activities[answer->activity.index()].questionnaire;
    RC_ASSERT(answer->question < questions.size());
  }
}

}  // namespace
}  // namespace mechane::state
