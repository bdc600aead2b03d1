// Drafts that are tried, with a script in the server's place and a network that is not opened.
#include "client-sdk/gateway/drafts/preview_desk.hpp"

#include <deque>
#include <mutex>
#include <optional>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "client-sdk/gateway/preview_api.hpp"
#include "client-sdk/studio/draft/preview_file.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/held_worker.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_files.hpp"
#include <mechane/proto/names.hpp>

namespace mechane::gateway {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using std::chrono::minutes;
using test::is_error;
using testing::ElementsAre;
using testing::HasSubstr;

/// Says its arguments and its orders, and ends with its input.
constexpr const char* kServer =
    R"(trap '' TERM; echo "$*" >> "$0.log"; while read line; do echo "$line" >> "$0.log"; done; echo over >> "$0.log")";

class PreviewDeskTest : public testing::Test {
 protected:
  explicit PreviewDeskTest(const char* server = kServer) : server_(folder_.script("server", server)) {
    left_ = lay("left").file;
    desk_.emplace(PreviewDesk::Places{server_, server_, folder_.path(), studio::remove_preview}, backstage_);
  }
  void TearDown() override { desk_.reset(); }

  studio::PreviewDraft lay(const std::string& draft, std::int64_t revision = 3) {
    const auto file = studio::write_preview(folder_.path() / draft, "<X3D/>");
    return {std::make_shared<const state::WorldDescription>(), *file, revision};
  }
  void start(const std::string& draft, std::int64_t revision = 3, const std::string& step = "") {
    const auto ready = desk_->prepare(draft);
    ASSERT_TRUE(ready) << ready.error().to_string();
    studio::PreviewDraft laid = lay(draft, revision);
    laid.step = step;
    desk_->start(draft, &laid, now_);
  }
  json look(const std::string& draft) { return json::parse(desk_->look(draft, now_)); }
  /// What was posted to the loop's thread.
  void run_posted() {
    for (;;) {
      std::function<void()> job;
      {
        const std::lock_guard lock(mutex_);
        if (jobs_.empty()) return;
        job = std::move(jobs_.front());
        jobs_.pop_front();
      }
      job();
    }
  }
  template <class Condition>
  [[nodiscard]] bool eventually(Condition holds) {
    const TimePoint until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!holds()) {
      if (std::chrono::steady_clock::now() > until) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));  // sleeps: between two looks
      run_posted();
    }
    return true;
  }
  [[nodiscard]] std::string log() const {
    return fs::exists(server_.string() + ".log") ? test::text_of(server_.string() + ".log") : "";
  }
  [[nodiscard]] bool says(const std::string& words) {
    return eventually([&] { return log().find(words) != std::string::npos; });
  }

  const test::ScratchFolder folder_;
  const fs::path server_;
  fs::path left_;
  std::mutex mutex_;
  std::deque<std::function<void()>> jobs_;
  KnownContent content_;
  KioskTokens tokens_{minutes(30)};
  test::HeldWorker slow_;
  const Backstage backstage_{7,
                             *slow_.get(),
                             [this](std::function<void()> job) {
                               const std::lock_guard lock(mutex_);
                               jobs_.push_back(std::move(job));
                             },
                             nullptr,
                             content_,
                             tokens_};
  TimePoint now_ = std::chrono::steady_clock::now();
  std::optional<PreviewDesk> desk_;
};

TEST_F(PreviewDeskTest, WhatAnEarlierGatewayLeftIsRemoved) {
  EXPECT_FALSE(fs::exists(left_));
}

TEST_F(PreviewDeskTest, ADraftRunsInADomainOfItsOwnAndTakesOrders) {
  EXPECT_EQ(look("mine")["state"], "none");
  start("mine");
  const json preview = look("mine");
  EXPECT_EQ(preview["state"], "starting");
  EXPECT_EQ(preview["revision"], 3);
  EXPECT_EQ(preview["pace"], 1);
  EXPECT_TRUE(says("--domain 57 --name studio-mine --worlds 1 --records  --fifo-priority 0 --paced"));
  EXPECT_THAT(log(), HasSubstr("mine/.preview.x3d"));
  ASSERT_TRUE(desk_->set_pace("mine", 0.25));
  EXPECT_THAT(desk_->step("mine", 10).error(), is_error(ErrorCode::conflict, 0, {"pause"}));
  ASSERT_TRUE(desk_->set_pace("mine", 0));
  ASSERT_TRUE(desk_->step("mine", 10));
  EXPECT_TRUE(says("pace 0.25\npace 0\nstep 10\n"));
  EXPECT_EQ(look("mine")["pace"], 0);
  EXPECT_FALSE(look("mine").contains("begins"));
  start("mine", 4, "use/lift");
  EXPECT_EQ(look("mine")["begins"], "use/lift");
}

TEST_F(PreviewDeskTest, WhatDoesNotRunTakesNoOrders) {
  EXPECT_THAT(desk_->set_pace("mine", 0).error(), is_error(ErrorCode::conflict, 0, {"start"}));
  EXPECT_THAT(desk_->step("mine", 1).error(), is_error(ErrorCode::conflict, 0));
  EXPECT_THAT(desk_->play("mine", "lifting").error(), is_error(ErrorCode::conflict, 0, {"start"}));
  desk_->stop("mine");
}

TEST_F(PreviewDeskTest, OnlyAVisitOfWhatRunsIsPlayedAndOnlyOnceItRuns) {
  auto world = std::make_shared<state::WorldDescription>();
  world->visits.push_back({"lifting", {}, {}});
  ASSERT_TRUE(desk_->prepare("mine"));
  studio::PreviewDraft laid = lay("mine");
  laid.world = world;
  desk_->start("mine", &laid, now_);
  EXPECT_THAT(desk_->play("mine", "shown").error(), is_error(ErrorCode::unknown_name, 0, {"anew"}));
  EXPECT_THAT(desk_->play("mine", "lifting").error(), is_error(ErrorCode::conflict, 0, {"moment"}));
  EXPECT_TRUE(desk_->play("mine", "")) << "nobody has to go";
  EXPECT_FALSE(look("mine").contains("visit"));
}

TEST_F(PreviewDeskTest, AStopEndsTheServerAndRemovesTheFileAndItsFolder) {
  start("mine");
  ASSERT_TRUE(says("--paced"));
  desk_->stop("mine");
  EXPECT_EQ(look("mine")["state"], "none");
  EXPECT_FALSE(fs::exists(folder_.path() / "mine"));
  EXPECT_TRUE(says("over"));
}

TEST_F(PreviewDeskTest, AFurtherStartTakesThePlaceOfTheFirst) {
  start("mine");
  ASSERT_TRUE(says("--domain 57"));
  start("mine", 4);
  EXPECT_TRUE(says("--domain 58")) << "the first one may still be there";
  EXPECT_TRUE(says("over"));
  EXPECT_EQ(look("mine")["revision"], 4);
  EXPECT_TRUE(fs::exists(folder_.path() / "mine/.preview.x3d"));
}

TEST_F(PreviewDeskTest, FourRunAtATime) {
  for (const char* draft : {"a", "b", "c", "d"})
    start(draft);
  EXPECT_THAT(desk_->prepare("e").error(), is_error(ErrorCode::busy, 0, {"4 drafts", "stop"}));
  start("a");
  desk_->stop("b");
  EXPECT_TRUE(desk_->prepare("e"));
  EXPECT_THAT(desk_->prepare("e").error(), is_error(ErrorCode::busy, 0)) << "it is being prepared";
  EXPECT_FALSE(desk_->prepare("f")) << "it counts, too";
  EXPECT_EQ(look("e")["state"], "starting");
  desk_->start("e", nullptr, now_);
  EXPECT_EQ(look("e")["state"], "none");
}

TEST_F(PreviewDeskTest, WhatNobodyLooksAtEnds) {
  start("mine");
  now_ += minutes(14);
  desk_->tick(now_);
  EXPECT_EQ(look("mine")["state"], "starting");
  now_ += minutes(14);
  desk_->tick(now_);
  EXPECT_EQ(look("mine")["state"], "starting");
  now_ += minutes(16);
  desk_->tick(now_);
  EXPECT_EQ(look("mine")["state"], "none");
  EXPECT_FALSE(fs::exists(folder_.path() / "mine"));
}

TEST_F(PreviewDeskTest, TheGatewaysEndEndsAll) {
  start("mine");
  ASSERT_TRUE(says("--paced"));
  desk_.reset();
  EXPECT_THAT(log(), HasSubstr("over"));
  EXPECT_FALSE(fs::exists(folder_.path() / "mine"));
}

TEST_F(PreviewDeskTest, ANameOfAKioskFits) {
  EXPECT_EQ(PreviewDesk::kiosk_of("mine"), "studio-mine");
  const std::string one = PreviewDesk::kiosk_of(std::string(30, 'x') + "1"),
                    other = PreviewDesk::kiosk_of(std::string(30, 'x') + "2");
  EXPECT_TRUE(proto::check_name(one, "kiosk")) << one;
  EXPECT_NE(one, other);
}

class FailingPreviewTest : public PreviewDeskTest {
 protected:
  FailingPreviewTest() : PreviewDeskTest("echo reading the exhibit; echo error: it cannot be >&2; exit 1") {}
};

TEST_F(FailingPreviewTest, OneThatEndsByItselfHasFailedWithWhatItSaid) {
  start("mine");
  ASSERT_TRUE(eventually([&] { return look("mine")["state"] == "failed"; }));
  EXPECT_THAT(look("mine")["said"], ElementsAre("reading the exhibit", "error: it cannot be"));
  EXPECT_FALSE(look("mine").contains("address"));
  EXPECT_FALSE(fs::exists(folder_.path() / "mine"));
  EXPECT_THAT(desk_->set_pace("mine", 0).error(), is_error(ErrorCode::conflict, 0));
  desk_->stop("mine");
  EXPECT_EQ(look("mine")["state"], "none");
}

TEST_F(FailingPreviewTest, AFileThatWasJustWrittenForTheNextOneStays) {
  start("mine");
  ASSERT_TRUE(desk_->prepare("mine"));
  const studio::PreviewDraft next = lay("mine", 4);
  ASSERT_TRUE(eventually([&] { return look("mine")["state"] == "failed"; }));
  EXPECT_TRUE(fs::exists(next.file));
  desk_->start("mine", &next, now_);
  EXPECT_EQ(look("mine")["revision"], 4);
}

TEST(PreviewMotion, IsToldByTheWorldsOwnTime) {
  state::WorldDescription world;
  world.bodies.resize(2);
  client::Frame frame;
  frame.visible = {1, 1};
  frame.bodies.push_back({1, Pose{}});
  MotionWatch watch;
  const auto moves = [&](std::uint64_t tick, double x) {
    frame.tick = tick;
    frame.bodies[0].X_WB.p.x() = x;
    watch.look(world, frame);
    studio::SeenWorld seen;
    watch.tell(seen);
    EXPECT_EQ(seen.X_WB[1].p.x(), x);
    return seen.moves;
  };
  EXPECT_THAT(moves(1000, 0), ElementsAre(1, 1)) << "nothing is known yet";
  EXPECT_THAT(moves(1050, 0.1), ElementsAre(1, 1));
  EXPECT_THAT(moves(1100, 0.1), ElementsAre(0, 1));
  EXPECT_THAT(moves(1150, 0.1), ElementsAre(0, 1)) << "paused, it moves on";
  EXPECT_THAT(moves(1200, 0.1005), ElementsAre(0, 0));
}

TEST(PreviewPace, IsReadOrRefused) {
  EXPECT_EQ(parse_pace(R"({"pace": 0.1})")->pace, 0.1);
  EXPECT_EQ(parse_pace(R"({"pace": 1})")->ticks, 0U);
  EXPECT_EQ(parse_pace(R"({"ticks": 10000})")->ticks, 10'000U);
  for (const char* wrong : {"", "{}", "[]", "1", R"({"pace": 1.5})", R"({"pace": -1})", R"({"pace": "1"})",
                            R"({"pace": null})", R"({"ticks": 0})", R"({"ticks": 10001})", R"({"ticks": 1.5})",
                            R"({"ticks": -1})", R"({"pace": 0, "ticks": 1})"})
    EXPECT_FALSE(parse_pace(wrong)) << wrong;
}

TEST(PreviewVisit, IsNamedOrRefused) {
  EXPECT_EQ(*parse_visit_order(R"({"visit": "lifting"})"), "lifting");
  EXPECT_EQ(*parse_visit_order(R"({"visit": ""})"), "");
  for (const char* wrong : {"", "[]", "{}", R"({"visit": 3})", R"({"visit": "a", "pace": 1})", R"("a")"})
    EXPECT_FALSE(parse_visit_order(wrong)) << wrong;
}

TEST(PreviewDevice, IsAskedForWhatItDoesOrNothing) {
  const auto test = parse_device_order(R"({"user": 1, "action": "test"})");
  ASSERT_TRUE(test);
  EXPECT_EQ(test->user, 1U);
  EXPECT_EQ(test->action, client::DeviceAction::test);
  EXPECT_EQ(parse_device_order(R"({"user": 0, "action": "end-test"})")->action, client::DeviceAction::end_test);
  EXPECT_EQ(parse_device_order(R"({"user": 0, "action": "calibrate"})")->action, client::DeviceAction::calibrate);
  const auto put = parse_device_order(
      R"({"user": 0, "action": "place", "place": {"center_m": [1, 2.5, -3], "turn_rad": 0.5, "scale": 2}})");
  ASSERT_TRUE(put);
  EXPECT_EQ(put->place, (client::DevicePlace{Vec3(1, 2.5, -3), 0.5, 2}));
  for (const char* wrong :
       {"", "[]", "{}", R"({"user": 0})", R"({"action": "test"})", R"({"user": 4, "action": "test"})",
        R"({"user": -1, "action": "test"})", R"({"user": 0, "action": "burn"})", R"({"user": 0, "action": 2})",
        R"({"user": 0, "action": "place"})", R"({"user": 0, "action": "test", "place": {}})",
        R"({"user": 0, "action": "place", "place": {"center_m": [1, 2], "turn_rad": 0, "scale": 1}})",
        R"({"user": 0, "action": "place", "place": {"center_m": [1, 2, "3"], "turn_rad": 0, "scale": 1}})",
        R"({"user": 0, "action": "place", "place": {"center_m": [1, 2, 3], "turn_rad": 0}})",
        R"({"user": 0, "action": "place", "place": {"center_m": [1, 2, 3], "turn_rad": 0, "scale": 0.5}})",
        R"({"user": 0, "action": "place", "place": {"center_m": [1e9, 2, 3], "turn_rad": 0, "scale": 1}})"})
    EXPECT_FALSE(parse_device_order(wrong)) << wrong;
}

}  // namespace
}  // namespace mechane::gateway
