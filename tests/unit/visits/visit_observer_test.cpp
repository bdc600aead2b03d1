#include "server/visits/visit_observer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/error_like.hpp"

namespace mechane::visits {
namespace {

using state::CommandKind;
using state::EventKind;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::uint32_t kNobody = 0xffffffffu;
constexpr std::uint32_t kStone = 0;  // bodies
constexpr std::uint32_t kCrank = 1;
constexpr std::uint32_t kTake = 0;  // steps
constexpr std::uint32_t kTurn = 1;
constexpr std::uint32_t kSign = 2;

/// take (20 s to its hint) -> turn (times out to the end after 40 s); a second activity of one step; a step that opens a scenario.
std::shared_ptr<state::WorldDescription> make_machine() {
  auto world = std::make_shared<state::WorldDescription>();
  world->id = "machine";
  world->content_hash = "hash";
  world->bodies.resize(2);
  world->bodies[kStone].name = "STONE";
  world->bodies[kCrank].name = "CRANK";
  world->machines.push_back({.name = "PUMP", .type = "machine.pump", .parameters = {}});
  world->agents.push_back({.name = "ROPE", .type = "geometry.breakable", .parameters = {}});
  state::StepDescription take;
  take.name = "take";
  take.texts["hint"]["en"] = "Reach for it.";
  take.triggers.resize(1);
  take.triggers[0].next = StepId(kTurn);
  state::StepDescription turn;
  turn.name = "turn";
  turn.timeout_s = 40;
  turn.triggers.resize(1);
  state::StepDescription sign;
  sign.name = "to-the-pump";
  sign.opens = "pump";
  world->steps = {take, turn, sign};
  state::QuestionDescription easy;
  easy.name = "easy";
  easy.kind = state::QuestionDescription::Kind::scale;
  state::QuestionDescription why;
  why.name = "why";
  why.answers = {{"water", {}}, {"wind", {}}};
  why.correct = "water";
  world->activities.push_back(
      {.name = "use", .first = StepId(kTake), .title = {}, .goal = {}, .questionnaire = {easy, why}});
  state::QuestionDescription who;
  who.name = "who";
  who.answers = {{"me", {}}};
  world->activities.push_back(
      {.name = "other", .first = StepId(kTurn), .title = {}, .goal = {}, .questionnaire = {who}});
  return world;
}

/// A world whose loop notes what the test says.
class VisitObserverTest : public testing::Test {
 protected:
  VisitObserverTest() { restart(); }

  void restart(std::optional<VisitRecord> unfinished = {}, std::uint32_t step = kTake, std::uint64_t tick = 0) {
    state::Progress at;
    at.activity = ActivityId(0);
    at.step = StepId(step);
    at.activity_tick = at.step_tick = tick;
    VisitSources sources;
    sources.number = [this] { return "number-" + std::to_string(++numbers_); };
    sources.minute = [] { return 1000; };
    observer_.emplace(description_, "kiosk-1", at, tick, std::move(unfinished), sources);
  }

  state::VisitAnswer given(std::string_view text) const {
    return state::parse_visit_answer(text, *description_).value();
  }
  void start(std::uint64_t tick, std::uint32_t activity, CommandKind by = CommandKind::start_activity) {
    observer_->take({.event = {tick, EventKind::activity_started, activity, kNobody, 0}, .command = by});
  }
  void say(std::uint64_t tick, EventKind kind, std::uint32_t subject, std::uint32_t object = kNobody) {
    observer_->take({.event = {tick, kind, subject, object, 0}});
  }
  void command(std::uint64_t tick, CommandKind kind) {
    observer_->take({.event = {tick, EventKind::command_done, kNobody, kNobody, 1}, .command = kind});
  }
  void let_go(std::uint64_t tick, std::uint32_t body, bool opened = true) {
    observer_->take({.event = {tick, EventKind::released, 0, body, 0}, .opened_hand = opened});
  }
  void begin(std::uint64_t tick = 1000) { say(tick, EventKind::touched, 0, kCrank); }
  /// The newest state of the record that changed last.
  VisitRecord record() {
    const auto changed = observer_->take_changed();
    EXPECT_FALSE(changed.empty());
    return changed.empty() ? VisitRecord() : changed.back();
  }
  VisitRecord left() {
    observer_->close(VisitEnding::left);
    return record();
  }

  std::shared_ptr<state::WorldDescription> description_ = make_machine();
  std::optional<VisitObserver> observer_;
  int numbers_ = 0;
};

TEST_F(VisitObserverTest, WhatLightsItselfIsNobodysVisit) {
  say(1000, EventKind::lit, 0);
  observer_->look(3000, 0);
  EXPECT_THAT(observer_->take_changed(), IsEmpty());
  say(4000, EventKind::grasped, 0, kCrank);
  say(5000, EventKind::lit, 0);
  EXPECT_EQ(record().ending, VisitEnding::running);
}

TEST_F(VisitObserverTest, AVisitThatGoesWellIsDoneStepByStepWithItsTimes) {
  begin(2000);
  say(5000, EventKind::step_started, kTurn);
  say(9000, EventKind::activity_done, 0);
  const VisitRecord s = record();
  EXPECT_EQ(s.number, "number-1");
  EXPECT_EQ(s.minute, 1000);
  EXPECT_EQ(s.kiosk, "kiosk-1");
  EXPECT_EQ(s.scenario, "machine");
  EXPECT_EQ(s.scenario_hash, "hash");
  EXPECT_EQ(s.activity, "use");
  EXPECT_EQ(s.ending, VisitEnding::done);
  EXPECT_EQ(s.hands, 1U);
  EXPECT_DOUBLE_EQ(s.duration_s, 9);  // reading what to do is part of it
  EXPECT_THAT(s.steps, ElementsAre(RecordedStep{"take", 5, StepEnding::done, false, true},
                                   RecordedStep{"turn", 4, StepEnding::done, false, true}));
  EXPECT_THAT(s.mistakes, IsEmpty());
  EXPECT_TRUE(s.done_alone());
}

TEST_F(VisitObserverTest, TheLanguageIsTheLastThatTheVisitorSawAndNotTheOneThatTheKioskGoesBackTo) {
  observer_->set_language("el");
  begin(2000);
  EXPECT_EQ(record().language, "el");
  observer_->set_language("en");
  say(5000, EventKind::touched, 0);
  EXPECT_EQ(record().language, "en");
  observer_->set_language("el");
  say(9000, EventKind::activity_done, 0);
  EXPECT_EQ(record().language, "en");
}

TEST_F(VisitObserverTest, NobodyIsNoVisit) {
  say(1, EventKind::user_joined, 0);
  observer_->look(500'000, 0);
  EXPECT_THAT(observer_->take_changed(), IsEmpty());
  observer_->close(VisitEnding::left);
  EXPECT_THAT(observer_->take_changed(), IsEmpty());
}

TEST_F(VisitObserverTest, WhoComesLateIsTimedFromTheFirstTouchAndHasSeenTheHint) {
  begin(300'000);
  say(303'000, EventKind::step_started, kTurn);
  const VisitRecord s = left();
  EXPECT_TRUE(s.from_start);
  EXPECT_EQ(s.steps.front(), (RecordedStep{"take", 3, StepEnding::done, true, true}));
  EXPECT_FALSE(s.done_alone());
}

TEST_F(VisitObserverTest, WhoGoesAwayLeftAndTheNextOneIsAnotherVisitInTheMidst) {
  begin(1000);
  say(2000, EventKind::step_started, kTurn);
  say(12'000, EventKind::touched, 0, kCrank);
  observer_->look(12'000 + VisitObserver::kAway - 1, 0);
  EXPECT_EQ(record().ending, VisitEnding::running);
  observer_->look(12'000 + VisitObserver::kAway, 0);
  const VisitRecord first = record();
  EXPECT_EQ(first.ending, VisitEnding::left);
  EXPECT_DOUBLE_EQ(first.duration_s, 12);
  EXPECT_EQ(first.steps.back(), (RecordedStep{"turn", 10, StepEnding::unfinished, false, true}));
  begin(200'000);
  const VisitRecord second = record();
  EXPECT_NE(second.number, first.number);
  EXPECT_FALSE(second.from_start);
  EXPECT_THAT(second.steps, ElementsAre(RecordedStep{"turn", 0, StepEnding::unfinished, false, false}));
}

TEST_F(VisitObserverTest, WhoHoldsSomethingIsThere) {
  say(1000, EventKind::grasped, 0, kCrank);
  observer_->look(1000 + 3 * VisitObserver::kAway, 0);
  EXPECT_EQ(record().ending, VisitEnding::running);
  let_go(1000 + 3 * VisitObserver::kAway, kCrank, false);
  observer_->look(1000 + 4 * VisitObserver::kAway, 0);
  EXPECT_EQ(record().ending, VisitEnding::left);
}

TEST_F(VisitObserverTest, ASkippedAndATimedOutStepAreNotDone) {
  begin();
  say(3000, EventKind::step_started, kTurn);
  command(3000, CommandKind::next_step);
  say(43'000, EventKind::activity_done, 0);
  const VisitRecord s = record();
  EXPECT_EQ(s.steps[0].ending, StepEnding::skipped);
  EXPECT_EQ(s.steps[1].ending, StepEnding::timed_out);
  EXPECT_EQ(s.ending, VisitEnding::done);
  EXPECT_FALSE(s.done_alone());
}

TEST_F(VisitObserverTest, AnActivityThatIsSkippedToItsEndIsNotDoneAlone) {
  begin();
  say(2000, EventKind::step_started, kTurn);
  say(3000, EventKind::activity_done, 0);
  command(3000, CommandKind::next_step);
  EXPECT_EQ(record().steps[1].ending, StepEnding::skipped);
}

TEST_F(VisitObserverTest, LettingGoIsAMistakeUnlessThePartSettles) {
  say(1000, EventKind::grasped, 0, kStone);
  let_go(2000, kStone);
  say(2500, EventKind::grasped, 1, kStone);  // from hand to hand
  let_go(4000, kStone);
  say(4000 + VisitObserver::kSettles, EventKind::placed, 0, kStone);  // where it belongs
  say(10'000, EventKind::grasped, 0, kStone);
  let_go(11'000, kStone);
  say(11'500, EventKind::touched, 0, kStone);
  say(12'001, EventKind::grasped, 0, kStone);  // picked up again
  observer_->look(11'000 + VisitObserver::kSettles, 0);
  EXPECT_THAT(record().mistakes, IsEmpty());
  observer_->look(11'001 + VisitObserver::kSettles, 0);
  EXPECT_THAT(record().mistakes, ElementsAre(RecordedMistake{MistakeKind::let_go, "STONE", 1}));
  let_go(19'000, kCrank, false);  // a joint has it
  let_go(19'500, kStone);
  say(19'600, EventKind::step_started, kTurn);  // that was what the step waited for
  EXPECT_THAT(left().mistakes, ElementsAre(RecordedMistake{MistakeKind::let_go, "STONE", 1}));
}

TEST_F(VisitObserverTest, WhoLeavesWithAFallingPartHasLetItGo) {
  say(1000, EventKind::grasped, 0, kStone);
  let_go(2000, kStone);
  EXPECT_THAT(left().mistakes, ElementsAre(RecordedMistake{MistakeKind::let_go, "STONE", 1}));
}

TEST_F(VisitObserverTest, AgentsAndMachinesSayTheOtherMistakes) {
  begin();
  say(2000, EventKind::part_refused, 0, kStone);
  say(3000, EventKind::part_refused, 0, kStone);
  say(3500, EventKind::broke, 0);
  say(4000, EventKind::spilled, 0);
  say(5000, EventKind::spilled, 0);
  say(6000, EventKind::step_started, kTurn);
  say(7000, EventKind::spilled, 0);
  EXPECT_THAT(left().mistakes, ElementsAre(RecordedMistake{MistakeKind::wrong_part, "STONE", 2},
                                           RecordedMistake{MistakeKind::broke, "ROPE", 1},
                                           RecordedMistake{MistakeKind::spilled, "PUMP", 2}));
}

TEST_F(VisitObserverTest, RestartedByWhoWasHereIsTheSameVisitAndLaterAnother) {
  begin(1000);
  say(2000, EventKind::step_started, kTurn);
  start(4000, 0, CommandKind::restart_activity);
  say(4000, EventKind::step_started, kTake);
  const VisitRecord again = record();
  EXPECT_THAT(again.mistakes, ElementsAre(RecordedMistake{MistakeKind::restarted, "", 1}));
  EXPECT_THAT(again.steps, SizeIs(3));
  EXPECT_EQ(again.steps[1], (RecordedStep{"turn", 2, StepEnding::unfinished, false, true}));
  start(5000 + VisitObserver::kAway, 0, CommandKind::restart_activity);
  say(5000 + VisitObserver::kAway, EventKind::step_started, kTake);
  const VisitRecord first = record();
  EXPECT_EQ(first.ending, VisitEnding::left);
  begin(6000 + VisitObserver::kAway);
  const VisitRecord next = record();
  EXPECT_NE(next.number, first.number);
  EXPECT_TRUE(next.from_start);
  EXPECT_THAT(next.mistakes, IsEmpty());
}

TEST_F(VisitObserverTest, StartedIsAnotherVisitOnceSomethingWasDone) {
  begin(1000);
  say(2000, EventKind::grasped, 0, kCrank);
  start(3000, 0);
  say(3000, EventKind::step_started, kTake);
  const VisitRecord first = record();
  EXPECT_EQ(first.ending, VisitEnding::left);
  EXPECT_THAT(first.mistakes, IsEmpty());
  begin(4000);
  EXPECT_NE(record().number, first.number);
}

TEST_F(VisitObserverTest, ATouchOnTheWayToTheStartIsNoVisitOfItsOwn) {
  begin(1000);
  const std::string number = record().number;
  start(5000, 1);
  say(5000, EventKind::step_started, kTurn);
  say(7000, EventKind::activity_done, 1);
  const VisitRecord s = record();
  EXPECT_EQ(s.number, number);
  EXPECT_EQ(s.activity, "other");
  EXPECT_DOUBLE_EQ(s.duration_s, 2);
  EXPECT_THAT(s.mistakes, IsEmpty());
  EXPECT_THAT(s.steps, SizeIs(1));
}

TEST_F(VisitObserverTest, AnotherActivityIsAnotherVisit) {
  begin(1000);
  say(1500, EventKind::grasped, 0, kCrank);
  start(2000, 1, CommandKind::start_activity);
  say(2000, EventKind::step_started, kTurn);
  EXPECT_EQ(record().ending, VisitEnding::left);
  begin(3000);
  EXPECT_EQ(record().activity, "other");
}

TEST_F(VisitObserverTest, PlayingOnAfterTheEndIsNoNewVisitNorAMistake) {
  begin(1000);
  say(2000, EventKind::activity_done, 0);
  (void)observer_->take_changed();
  begin(3000);
  say(3500, EventKind::grasped, 0, kStone);
  let_go(4000, kStone);
  observer_->look(9000, 0);
  EXPECT_THAT(observer_->take_changed(), IsEmpty());
}

TEST_F(VisitObserverTest, ASignThatLeadsOnIsDone) {
  begin(1000);
  say(2000, EventKind::step_started, kSign);
  const VisitRecord s = record();
  EXPECT_EQ(s.ending, VisitEnding::done);
  EXPECT_EQ(s.went_on_to, "pump");
  observer_->close(VisitEnding::left, "pump");
  EXPECT_THAT(observer_->take_changed(), IsEmpty());
}

TEST_F(VisitObserverTest, WhoIsLedElsewhereHasLeft) {
  begin(1000);
  observer_->look(3000, 0);
  observer_->close(VisitEnding::left, "village");
  const VisitRecord s = record();
  EXPECT_EQ(s.ending, VisitEnding::left);
  EXPECT_EQ(s.went_on_to, "village");
  EXPECT_DOUBLE_EQ(s.duration_s, 3);
}

TEST_F(VisitObserverTest, AnswersAreCounted) {
  ASSERT_TRUE(observer_->answer(given("before:use/why=wind")));
  begin(1000);
  say(2000, EventKind::activity_done, 0);
  ASSERT_TRUE(observer_->answer(given("after:use/why=wind")));
  ASSERT_TRUE(observer_->answer(given("after:use/why=water")));  // the visitor changes the answer
  ASSERT_TRUE(observer_->answer(given("after:use/easy=4")));
  EXPECT_THAT(record().answers, ElementsAre(RecordedAnswer{"why", AnswerTime::before, "wind", 0, 0, false},
                                            RecordedAnswer{"why", AnswerTime::after, "water", 0, 0, true},
                                            RecordedAnswer{"easy", AnswerTime::after, "", 4, 5, {}}));
  EXPECT_THAT(observer_->answer(given("after:other/who=me")).error(),
              test::is_error(ErrorCode::conflict, 0, {"activity other", "activity use"}));
  EXPECT_THAT(observer_->take_changed(), IsEmpty());
}

TEST_F(VisitObserverTest, WhatWasAskedBeforeTheActivityBelongsToItsVisit) {
  ASSERT_TRUE(observer_->answer(given("before:use/why=wind")));
  const std::string number = record().number;
  start(50'000, 0);
  say(50'000, EventKind::step_started, kTake);
  begin(51'000);
  say(52'000, EventKind::activity_done, 0);
  const VisitRecord s = record();
  EXPECT_EQ(s.number, number);
  EXPECT_DOUBLE_EQ(s.duration_s, 2);
  EXPECT_THAT(s.answers, SizeIs(1));
  EXPECT_THAT(s.steps, SizeIs(1));
}

TEST_F(VisitObserverTest, AnAnswerAfterNoVisitIsRefused) {
  EXPECT_THAT(observer_->answer(given("after:use/easy=4")).error(),
              test::is_error(ErrorCode::conflict, 0, {"question easy", "no visitor"}));
}

TEST_F(VisitObserverTest, AVisitThatAServersStopCutOffGoesOn) {
  begin(1000);
  say(4000, EventKind::step_started, kTurn);
  say(4500, EventKind::part_refused, 0, kStone);
  observer_->look(6000, 0);
  observer_->close(VisitEnding::cut);
  const VisitRecord cut = record();
  EXPECT_EQ(cut.ending, VisitEnding::cut);
  restart(cut, kTurn, 4800);
  say(9000, EventKind::activity_done, 0);
  const VisitRecord s = record();
  EXPECT_EQ(s.number, cut.number);
  EXPECT_EQ(s.ending, VisitEnding::done);
  EXPECT_THAT(s.steps, SizeIs(2));
  EXPECT_THAT(s.mistakes, SizeIs(1));
  EXPECT_EQ(s.steps[0], cut.steps[0]);
}

TEST_F(VisitObserverTest, AStepThatTheWorldHasNotDoneYetIsTakenBack) {
  begin(1000);
  say(4000, EventKind::step_started, kTurn);
  observer_->close(VisitEnding::cut);
  restart(record(), kTake, 0);  // the snapshot is older
  say(5000, EventKind::step_started, kTurn);
  EXPECT_THAT(left().steps, SizeIs(2));
}

TEST_F(VisitObserverTest, WhatWasLostIsSaid) {
  observer_->look(500, 3);  // before the visit: not counted
  begin(1000);
  observer_->look(1500, 5);
  EXPECT_EQ(record().notes_lost, 2U);
}

TEST_F(VisitObserverTest, RulesThatGoInCirclesDoNotFillARecord) {
  begin(1000);
  for (std::uint64_t i = 0; i < 10'000; ++i)
    say(2000 + i, EventKind::step_started, i % 2 == 0 ? kTurn : kTake);
  EXPECT_THAT(left().steps, SizeIs(VisitObserver::kMostSteps));
}

TEST(VisitFeed, NotesOfATickComeWithWhatOnlyTheLoopKnows) {
  const auto world = make_machine();
  world->joints.resize(1);
  world->joints[0].body2 = BodyId(kCrank);
  state::WorldState state(*world);
  state.joints[0].enabled = true;
  state.users[0].present = state.users[1].present = true;
  state.users[1].jumped = true;
  state.tick = 7;
  state.emit(EventKind::turned, 0);  // no record needs it
  state.emit(EventKind::released, 0, kStone);
  state.emit(EventKind::released, 0, kCrank);
  state.emit(EventKind::released, 1, kStone);
  state.emit(EventKind::command_done, kNobody, kNobody, 42);
  state.emit(EventKind::activity_started, 0);
  state::TickInputs inputs;
  inputs.command_count = 2;
  inputs.commands[0] = {.id = 42, .kind = CommandKind::next_step};
  inputs.commands[1] = {.id = 43, .kind = CommandKind::restart_activity};
  VisitFeed feed;
  feed.push(*world, state, inputs);
  EXPECT_EQ(feed.tick(), 7U);
  std::vector<VisitNote> notes(6);
  std::size_t count = 0;
  while (count < notes.size() && feed.take(notes[count]))
    ++count;
  ASSERT_EQ(count, 5U);
  EXPECT_TRUE(notes[0].opened_hand);
  EXPECT_FALSE(notes[1].opened_hand);  // the joint holds it
  EXPECT_FALSE(notes[2].opened_hand);  // the device jumped
  EXPECT_EQ(notes[3].command, CommandKind::next_step);
  EXPECT_EQ(notes[4].command, CommandKind::restart_activity);
}

TEST(VisitFeed, WhatHangsOnARopeIsNotLetGo) {
  const auto world = make_machine();
  state::WorldState state(*world);
  state.users[0].present = true;
  state.couplings.resize(1);
  state.couplings[0].kind = state::CouplingKind::rope;
  state.couplings[0].node_count = 2;
  state.couplings[0].nodes[1].body = BodyId(kStone);
  VisitFeed feed;
  VisitNote note;
  for (const bool tied : {false, true}) {
    state.couplings[0].enabled = tied;
    state.event_count = 0;
    state.emit(EventKind::released, 0, kStone);
    feed.push(*world, state, {});
    ASSERT_TRUE(feed.take(note));
    EXPECT_EQ(note.opened_hand, !tied);
  }
}

TEST(VisitFeed, WhatAnotherHandHoldsIsNotLetGo) {
  const auto world = make_machine();
  state::WorldState state(*world);
  state.users[0].present = state.users[1].present = true;
  VisitFeed feed;
  VisitNote note;
  for (const BodyId held : {BodyId(kCrank), BodyId(kStone)}) {
    state.users[1].grasp.active = true;
    state.users[1].grasp.body = held;
    state.event_count = 0;
    state.emit(EventKind::released, 0, kStone);
    feed.push(*world, state, {});
    ASSERT_TRUE(feed.take(note));
    EXPECT_EQ(note.opened_hand, held != BodyId(kStone));
  }
}

TEST(VisitFeed, AFullOneLosesAndCounts) {
  const auto world = make_machine();
  state::WorldState state(*world);
  for (std::size_t i = 0; i < state::kMaxEventsPerTick; ++i)
    state.emit(EventKind::touched, 0, kStone);
  VisitFeed feed;
  for (std::size_t i = 0; i < VisitFeed::kCapacity / state::kMaxEventsPerTick + 1; ++i)
    feed.push(*world, state, {});
  EXPECT_EQ(feed.lost(), state::kMaxEventsPerTick);
}

}  // namespace
}  // namespace mechane::visits
