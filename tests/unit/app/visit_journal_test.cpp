#include "server/app/visit_journal.hpp"

#include <gtest/gtest.h>

#include "server/record/recorder.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::app {
namespace {

using visits::StepEnding;
using visits::VisitRecord;

VisitRecord visit_of_three_steps() {
  VisitRecord visit;
  visit.kiosk = "kiosk-1";
  visit.scenario = "screw";
  visit.minute = 29'922'357;
  visit.duration_s = 10;
  visit.steps = {{"take", 2, StepEnding::done, false, true},
                 {"turn", 3, StepEnding::done, false, true},
                 {"fill", 5, StepEnding::done, false, true}};
  return visit;
}

TEST(VisitJournal, AVisitBeginsWhereItsStepsFitBest) {
  const VisitRecord visit = visit_of_three_steps();
  const std::vector<BegunStep> begun{
      {"take", 1000},   {"turn", 9000},   {"take", 21'000},  // another visitor, who went away
      {"take", 30'010}, {"turn", 32'000}, {"fill", 35'020}, {"take", 50'000}};
  EXPECT_EQ(beginning_of(visit, begun, 0, 70'000, 20'000), 30'000U) << "by its second step, which is exact";
  EXPECT_EQ(beginning_of(visit, begun, 0, 25'000, 20'000), 1000U) << "in this time one step fits: the earliest";
  EXPECT_EQ(beginning_of(visit, begun, 60'000, 70'000, 65'000), 65'000U) << "none fits";
  EXPECT_EQ(beginning_of(visit, {}, 0, 70'000, 20'000), 20'000U);
  EXPECT_EQ(beginning_of(VisitRecord{}, begun, 0, 70'000, 20'000), 20'000U);
}

/// Journals as a server writes them.
class VisitJournalTest : public testing::Test {
 protected:
  std::filesystem::path journal(const std::string& kiosk, std::int64_t minute, std::uint64_t ticks) {
    auto recorder = record::Recorder::create({.folder = scratch_.path()});
    EXPECT_TRUE(recorder);
    record::JournalHeader header;
    header.world_id = kiosk + "-" + std::to_string(minute);
    header.kiosk = kiosk;
    header.scenario_id = "screw";
    header.start_wall_ns = static_cast<std::uint64_t>(minute) * 60'000'000'000U;
    header.first_tick = 1;
    auto world = (*recorder)->open(header, 1024);
    state::TickInputs inputs;
    for (std::uint64_t tick = 1; tick <= ticks; ++tick) {
      // The visit begins seven seconds after its minute did.
      state::Event event{tick, state::EventKind::step_started, 0, 0xffffffffu, 0};
      for (const std::uint64_t at : {7001U, 9001U, 12'001U}) {
        if (tick == at) {
          world.push({tick, &inputs, {&event, 1}, {}});
          break;
        }
        ++event.subject;
      }
      if (event.subject == 3) world.push({tick, &inputs, {}, {}});
    }
    const std::filesystem::path path = world.journal_path();
    world.close();
    return path;
  }
  VisitJournalTest() {
    for (const char* name : {"take", "turn", "fill"}) {
      description_.steps.emplace_back();
      description_.steps.back().name = name;
    }
  }
  test::ScratchFolder scratch_;
  state::WorldDescription description_;
};

TEST_F(VisitJournalTest, ItIsInTheNewestJournalOfItsKioskThatHadBegun) {
  const VisitRecord visit = visit_of_three_steps();
  (void)journal("kiosk-2", visit.minute, 100);
  (void)journal("kiosk-1", visit.minute - 60, 100);
  (void)journal("kiosk-1", visit.minute + 1, 100);
  const auto right = journal("kiosk-1", visit.minute, 30'000);
  const auto found = find_visit(scratch_.path(), visit, description_);
  ASSERT_TRUE(found) << found.error().to_string();
  EXPECT_EQ(found->journal, right);
  EXPECT_EQ(found->first, 7001U);
  EXPECT_EQ(found->last, 7001U + 10'000 + 1500);
}

TEST_F(VisitJournalTest, WhereThereIsNoneItSaysWhy) {
  const VisitRecord visit = visit_of_three_steps();
  for (const char* kiosk : {"kiosk-2", "kiosk-1"}) {
    (void)journal(kiosk, visit.minute - 60, 100);
    const auto found = find_visit(scratch_.path(), visit, description_);
    ASSERT_FALSE(found) << "of another kiosk, or ended long before";
    EXPECT_EQ(found.error().code, ErrorCode::not_found);
    EXPECT_FALSE(found.error().remedy.empty());
  }
}

}  // namespace
}  // namespace mechane::app
