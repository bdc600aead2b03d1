#include "server/app/world_visits.hpp"

#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "server/app/settings.hpp"
#include "tests/support/crank_world.hpp"
#include "tests/support/error_like.hpp"

namespace mechane::app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using visits::VisitEnding;
using visits::VisitFile;
using visits::VisitRecord;

/// A crank with a questionnaire, and records of visits in a folder of the test.
class WorldVisitsTest : public testing::Test {
 public:
  ~WorldVisitsTest() override { fs::remove_all(folder_); }

 protected:
  WorldVisitsTest() : folder_(fs::path(testing::TempDir()) / fmt::format("world-visits-{}", getpid())) {
    fs::remove_all(folder_);
    const auto world = test::make_crank_description();
    state::QuestionDescription easy;
    easy.name = "easy";
    easy.kind = state::QuestionDescription::Kind::scale;
    world->activities.at(0).questionnaire = {easy};
    description_ = world;
    start();
  }

  /// Starts a server, or the next one.
  void start() {
    writer_.reset();
    visits::VisitWriterConfig config;
    config.file = folder_ / visits::kVisitFileName;
    auto made = visits::VisitWriter::create(config);
    ASSERT_TRUE(made) << made.error().to_string();
    writer_ = std::move(*made);
  }
  /// Does what a loop does in a tick with these events.
  void tick(WorldVisits& visits, state::WorldState& state, std::initializer_list<state::EventKind> kinds) const {
    ++state.tick;
    state.event_count = 0;
    for (const state::EventKind kind : kinds)
      state.emit(kind, 0, 1);
    visits.feed().push(*description_, state, {});
  }
  std::vector<VisitRecord> on_disk() {
    writer_.reset();  // writes what waits
    const auto file = VisitFile::open(folder_ / visits::kVisitFileName, VisitFile::Access::read);
    EXPECT_TRUE(file) << file.error().to_string();
    return file ? file->records({}).value() : std::vector<VisitRecord>();
  }
  [[nodiscard]] state::WorldState begun() const {
    state::WorldState state(*description_);
    state.progress.activity = ActivityId(0);
    state.progress.step = description_->activities[0].first;
    return state;
  }

  fs::path folder_;
  std::shared_ptr<const state::WorldDescription> description_;
  std::unique_ptr<visits::VisitWriter> writer_;
};

TEST_F(WorldVisitsTest, WhatTheLoopNotesAndTheVisitorAnswersIsOnTheDisk) {
  state::WorldState state = begun();
  {
    WorldVisits visits(writer_.get(), description_, "kiosk-1", state, false);
    tick(visits, state, {state::EventKind::touched});
    tick(visits, state, {state::EventKind::activity_done});
    ASSERT_TRUE(visits.answer({ActivityId(0), 0, 5, state::AnswerTime::after}));
    visits.close(VisitEnding::left, "");
  }
  const auto records = on_disk();
  ASSERT_THAT(records, SizeIs(1));
  EXPECT_EQ(records[0].scenario, "crank");
  EXPECT_EQ(records[0].ending, VisitEnding::done);
  ASSERT_THAT(records[0].answers, SizeIs(1));
  EXPECT_EQ(records[0].answers[0].mark, 5);
}

TEST_F(WorldVisitsTest, AWorldThatIsResumedGoesOnWithItsRecordAndANewOneDoesNot) {
  state::WorldState state = begun();
  {
    WorldVisits visits(writer_.get(), description_, "kiosk-1", state, false);
    tick(visits, state, {state::EventKind::touched});
    visits.close(VisitEnding::cut, "");
  }
  start();
  {
    WorldVisits visits(writer_.get(), description_, "kiosk-1", state, true);
    tick(visits, state, {state::EventKind::activity_done});
    visits.close(VisitEnding::left, "");
  }
  ASSERT_THAT(on_disk(), SizeIs(1));
  EXPECT_EQ(on_disk()[0].ending, VisitEnding::done);
  start();
  state = begun();
  {
    WorldVisits visits(writer_.get(), description_, "kiosk-1", state, false);
    tick(visits, state, {state::EventKind::touched});
    visits.close(VisitEnding::left, "elsewhere");
  }
  EXPECT_THAT(on_disk(), SizeIs(2));
}

TEST_F(WorldVisitsTest, AWorldThatNobodyTouchedLeavesNothing) {
  state::WorldState state = begun();
  {
    WorldVisits visits(writer_.get(), description_, "kiosk-1", state, false);
    tick(visits, state, {state::EventKind::user_joined});
    visits.look();
    visits.close(VisitEnding::left, "");
  }
  EXPECT_THAT(on_disk(), IsEmpty());
}

Settings settings_of(const fs::path& records, const fs::path& visits) {
  Settings settings;
  settings.records = records;
  settings.visits = visits;
  return settings;
}

TEST(VisitsSetting, ABareNameLiesInTheFolderOfRecords) {
  EXPECT_EQ(Settings().visits_file(), fs::path("out/records/visits.db"));
  EXPECT_EQ(settings_of("r", "v.db").visits_file(), fs::path("r/v.db"));
  EXPECT_EQ(settings_of("r", "elsewhere/v.db").visits_file(), fs::path("elsewhere/v.db"));
  EXPECT_EQ(settings_of("", "elsewhere/v.db").visits_file(), fs::path("elsewhere/v.db"));
  EXPECT_EQ(settings_of("", "v.db").visits_file(), fs::path());
  EXPECT_EQ(settings_of("r", "none").visits_file(), fs::path());
  EXPECT_EQ(settings_of("r", "").visits_file(), fs::path());
}

TEST(VisitsSetting, FlagsAndFileAreReadAndRangesKept) {
  const fs::path file = fs::path(testing::TempDir()) / fmt::format("visits-{}.toml", getpid());
  std::ofstream(file) << "scenarios = [\"a.x3d\"]\nvisits = \"other.db\"\nvisits_keep_days = 30\nvisits_limit_mb = 5\n";
  const std::string path = file.string();
  std::string help;
  const std::array<const char*, 5> arguments{"server", "--settings", path.c_str(), "--visits-keep-days", "60"};
  const auto read = read_settings(static_cast<int>(arguments.size()), arguments.data(), help);
  ASSERT_TRUE(read) << read.error().to_string();
  EXPECT_EQ(read->visits, fs::path("other.db"));
  EXPECT_EQ(read->visits_keep_days, 60U);
  EXPECT_EQ(read->visits_limit_mb, 5U);
  EXPECT_THAT(to_string(*read), HasSubstr("visits = out/records/other.db\nvisits_keep_days = 60"));
  const std::array<const char*, 5> wrong{"server", "--settings", path.c_str(), "--visits-keep-days", "99999"};
  const auto refused = read_settings(static_cast<int>(wrong.size()), wrong.data(), help);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error(), test::is_error(ErrorCode::invalid_value, 0, {"visits_keep_days is 99999", "36500"}));
  fs::remove(file);
}

}  // namespace
}  // namespace mechane::app
