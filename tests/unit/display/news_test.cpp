#include "client-sdk/display/news.hpp"

#include <gtest/gtest.h>

#include "server/log/log.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/display/scripted_client.hpp"

namespace mechane::display {
namespace {

using client::LinkState;
using recording::RecordKind;

class NewsTest : public testing::Test {
 protected:
  NewsTest() {
    count_from_here();
    auto client = std::make_unique<ScriptedClient>();
    client_ = client.get();
    source_.client = std::move(client);
    options_.language = "en";
  }
  [[nodiscard]] News& news() {
    if (!news_) news_.emplace(options_, source_, scene::AssetSource{folder_.path().string(), nullptr});
    return *news_;
  }
  [[nodiscard]] static TimePoint at(int ms) { return TimePoint(std::chrono::hours(3)) + std::chrono::milliseconds(ms); }
  [[nodiscard]] static client::Frame frame_at(int ms) {
    return recording::frame_of_visit(static_cast<std::uint64_t>(ms), std::chrono::milliseconds(ms), at(ms));
  }
  scene::ShownWorld::News take(int ms) { return news().take(at(ms)); }
  /// A picture, as far as it matters for what is told of it.
  void draw(int ms) {
    (void)take(ms);
    (void)news().world().build(news().frame(), client_->state());
    news().tell_what_is_not_drawn(at(ms));
  }
  /// The well's model is missing, which is logged too.
  static void count_from_here() { log::start("test", log::Level::warning); }
  [[nodiscard]] static std::uint64_t warnings() { return log::trouble().count; }

  test::ScratchFolder folder_;
  DisplayOptions options_;
  DisplaySource source_;
  ScriptedClient* client_ = nullptr;
  std::optional<News> news_;
};

TEST_F(NewsTest, APictureIsOfOneMoment) {
  options_.screen = {1.2, 2.0, 0.064};
  client_->enter("world-1");
  client_->between = frame_at(100);
  client_->head = client::ViewerHead{{Vec3(0.3, 0, 2), Quat::Identity()}, true, at(133)};
  EXPECT_TRUE(take(133).another_world);
  EXPECT_EQ(client_->frames_asked, (std::vector{std::pair(at(133), kInterpolationDelay)})) << "33 ms back, and once";
  ASSERT_NE(news().head(), nullptr);
  const Vec3 head_S = news().head()->p_SV;

  client_->status->step = "fill";
  client_->manifest.pop_back();
  client_->between = frame_at(116);
  client_->head->received = at(149);
  EXPECT_EQ(news().world().status()->step, "turn");
  EXPECT_EQ(news().world().objects().size(), 2U);
  EXPECT_EQ(news().frame()->tick, 100U);
  EXPECT_EQ(news().head()->p_SV, head_S);

  EXPECT_FALSE(take(149).another_world);
  EXPECT_EQ(news().world().status()->step, "fill");
  EXPECT_EQ(news().world().objects().size(), 1U);
  EXPECT_EQ(news().frame()->tick, 116U);
  EXPECT_NE(news().head()->p_SV, head_S);
  EXPECT_EQ(log::trouble().last.find("tracker"), std::string::npos) << "the screen's size is known";
}

TEST_F(NewsTest, TheLastFrameStaysWhileTheLinkIsDown) {
  EXPECT_EQ(news().frame(), nullptr);
  client_->enter("world-1");
  (void)take(0);
  EXPECT_FALSE(news().live()) << "its first frame has not come";
  client_->between = frame_at(16);
  (void)take(16);
  EXPECT_TRUE(news().live());

  client_->link = LinkState::lost;
  client_->between = frame_at(32);  // a guess
  (void)take(32);
  ASSERT_NE(news().frame(), nullptr);
  EXPECT_EQ(news().frame()->tick, 16U);
  EXPECT_FALSE(news().live());

  client_->link = LinkState::joined;
  client_->between.reset();
  (void)take(48);
  ASSERT_NE(news().frame(), nullptr) << "until another comes";
  EXPECT_TRUE(news().live());
}

TEST_F(NewsTest, TheStateOfTheKiosksDeviceIsTold) {
  client_->enter("world-1");
  client_->at_hand = {{.state = client::DeviceState::ready}};
  (void)take(0);
  client_->at_hand = {{.state = client::DeviceState::hot}};
  (void)take(500);
  EXPECT_FALSE(news().device_notice(at(1400), "en"));
  EXPECT_TRUE(news().device_notice(at(1500), "en"));
  client_->at_hand.clear();
  (void)take(1520);
  EXPECT_FALSE(news().device_notice(at(9000), "en"));
}

TEST_F(NewsTest, AnotherWorldHasNoFrameOfTheOneBefore) {
  client_->enter("world-1");
  client_->between = frame_at(0);
  (void)take(0);
  client_->enter("world-2");
  EXPECT_TRUE(take(16).another_world);
  EXPECT_EQ(news().frame(), nullptr);
  EXPECT_FALSE(news().live());
}

TEST_F(NewsTest, AVisitIsFinishedWhenItsLastActivityIsDone) {
  const auto finished = [this](const std::string& activity, bool done) {
    client_->status->activity = activity;
    client_->status->done = done;
    (void)take(0);
    return news().finished();
  };
  EXPECT_FALSE(news().finished());
  client_->enter("world-1");
  client_->status->activities = {"assemble", "use"};
  EXPECT_FALSE(finished("assemble", true));
  EXPECT_FALSE(finished("use", false));
  EXPECT_TRUE(finished("use", true));
  client_->status->activities.clear();
  EXPECT_TRUE(finished("", true));
}

TEST_F(NewsTest, WhatComesIsRecordedInOrderAndNothingWhileTheLinkIsDown) {
  const auto file = folder_.path() / "visit.seen";
  source_.recorder.emplace(recording::FrameRecorder::create(file, {}).value());
  (void)take(0);
  client_->enter("world-1");
  client_->newest = frame_at(40);
  client_->between = frame_at(7);
  (void)take(40);
  client_->events = {{1, "placed", "CRANK", "AXLE", 0}};
  EXPECT_EQ(news().take_events(at(50)).size(), 1U) << "recorded, and heard";
  client_->status->step = "fill";
  client_->newest = frame_at(80);
  (void)take(80);
  client_->link = LinkState::lost;
  client_->status->step = "pour";
  client_->newest = frame_at(120);
  (void)take(120);
  source_.recorder.reset();  // ends the file

  const auto written = recording::FrameRecording::open_file(file).value();
  std::vector<RecordKind> kinds;
  std::vector<std::uint64_t> ticks;
  for (const auto& record : written.records()) {
    kinds.push_back(record.kind);
    if (client::Frame frame; record.kind == RecordKind::frame && recording::decode(record.content, frame))
      ticks.push_back(frame.tick);
  }
  using enum RecordKind;
  EXPECT_EQ(kinds, (std::vector{status, presentation, manifest, frame, event, status, frame}));
  EXPECT_EQ(ticks, (std::vector<std::uint64_t>{40, 80})) << "as they came: they can be interpolated again";
}

TEST_F(NewsTest, ARecordingIsPlayedByTheTimeOfThePictures) {
  auto recorded =
      std::make_unique<recording::RecordedClient>(recording::played({0, 40, 80}), recording::PlaySettings{});
  source_.recorded = recorded.get();
  source_.client = std::move(recorded);
  EXPECT_TRUE(take(0).another_world);
  ASSERT_NE(news().frame(), nullptr);
  EXPECT_EQ(news().frame()->tick, 0U);
  (void)take(60);
  EXPECT_EQ(news().frame()->tick, 60U);
  EXPECT_FALSE(news().over());
  (void)take(80);
  EXPECT_TRUE(news().over());
}

TEST_F(NewsTest, ARefusalIsLoggedOnceAndAgainWhenItComesAgain) {
  client_->why_refused = "all worlds are in use";  // a reason that is left over says nothing
  (void)take(0);
  EXPECT_EQ(warnings(), 0U);
  client_->link = LinkState::refused;
  for (int ms = 16; ms < 100; ms += 16)
    (void)take(ms);
  EXPECT_EQ(warnings(), 1U);
  EXPECT_NE(log::trouble().last.find(client_->why_refused), std::string::npos);
  client_->link = LinkState::joined;
  (void)take(100);
  client_->link = LinkState::refused;
  (void)take(116);
  (void)take(132);
  EXPECT_EQ(warnings(), 2U);
}

TEST_F(NewsTest, AnObjectThatNoManifestNamesIsLoggedAfterFiveSecondsAndOnce) {
  client_->enter("world-1");
  client_->between = frame_at(0);
  const auto bodies = client_->between->bodies;
  const auto say_unknown = [&](std::uint32_t object) {
    client_->between->bodies = bodies;
    client_->between->bodies.push_back({object, Pose{}});
  };
  draw(0);
  count_from_here();
  say_unknown(7);
  draw(16);
  draw(4'900);
  client_->between->bodies = bodies;
  draw(4'950);  // the manifest came late
  say_unknown(7);
  draw(5'000);
  draw(9'900);
  EXPECT_EQ(warnings(), 0U);
  draw(10'000);
  EXPECT_EQ(warnings(), 1U);
  EXPECT_NE(log::trouble().last.find("object 7 "), std::string::npos);
  draw(30'000);
  EXPECT_EQ(warnings(), 1U);
  say_unknown(8);
  draw(30'016);
  EXPECT_EQ(warnings(), 2U);
}

TEST_F(NewsTest, AThingThatFliesAwayIsLoggedOnce) {
  client_->enter("world-1");
  client_->between = frame_at(0);
  draw(0);
  count_from_here();
  client_->between->bodies[1].X_WB.p = Vec3(0, -90'000, 0);
  draw(16);
  draw(32);
  EXPECT_EQ(warnings(), 1U);
  EXPECT_NE(log::trouble().last.find("BUCKET"), std::string::npos);
}

TEST_F(NewsTest, ATrackerBeforeAScreenOfUnknownSizeIsLoggedOnce) {
  for (const int seen_ms : {0, 1'000, 2'000}) {  // with pauses
    client_->head = client::ViewerHead{{Vec3(0, 0, 2), Quat::Identity()}, true, at(seen_ms)};
    (void)take(seen_ms);
    (void)take(seen_ms + 900);
  }
  EXPECT_EQ(warnings(), 1U);
  EXPECT_EQ(news().head(), nullptr);
}

}  // namespace
}  // namespace mechane::display
