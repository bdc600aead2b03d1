#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>

#include "tests/support/error_like.hpp"
#include <mechane/proto/entity.hpp>
#include <mechane/proto/names.hpp>

namespace mechane::proto {
namespace {

using test::is_error;

TEST(Names, AreKeptToWhatAPartitionCanHold) {
  EXPECT_TRUE(is_name("kiosk-1"));
  EXPECT_TRUE(is_name(std::string(31, 'a')));
  for (const std::string& bad :
       {std::string(), std::string(32, 'a'), std::string("a*"), std::string("a/b"), std::string("ä")}) {
    EXPECT_FALSE(is_name(bad)) << bad;
  }
  EXPECT_THAT(check_name("a b", "kiosk").error(), is_error(ErrorCode::invalid_value, 0, {"'a b'", "kiosk"}));
}

TEST(Names, LongTextsAreCutAtACharacter) {
  char chars[4];
  set_text(chars, "aéé");
  EXPECT_EQ(text_of(chars), "aé");
  const char open[2] = {'x', 'y'};
  EXPECT_EQ(text_of(open), "xy");
}

TEST(Topics, OneKilohertzTypesAreOfFixedSize) {
  EXPECT_TRUE(TopicOf<HapticInput>::descriptor->m_flagset & DDS_TOPIC_FIXED_SIZE);
  EXPECT_TRUE(TopicOf<HapticOutput>::descriptor->m_flagset & DDS_TOPIC_FIXED_SIZE);
  EXPECT_LT(sizeof(HapticOutput), 1400u);  // one datagram, never fragmented
}

/// What happened to a listener's function.
struct ListenerLife {
  std::mutex mutex;
  std::condition_variable changed;
  bool called = false;
  bool gone = false;
  bool gone_while_called = false;
};

/// A slow listener's function that notes when it is deleted.
struct SlowListener {
  explicit SlowListener(std::shared_ptr<ListenerLife> l) : life(std::move(l)) {}
  SlowListener(const SlowListener& other) = default;
  SlowListener(SlowListener&& other) = default;
  SlowListener& operator=(const SlowListener&) = delete;
  SlowListener& operator=(SlowListener&&) = delete;
  ~SlowListener() {
    if (!life) return;  // moved from
    const std::lock_guard lock(life->mutex);
    life->gone = true;
    life->changed.notify_all();
  }
  void operator()(ReaderView<Command>) const {
    std::unique_lock lock(life->mutex);
    life->called = true;
    life->changed.notify_all();
    // Long enough for a wrong replacement of the reader to delete this function; a right one waits for the end of this call.
    life->changed.wait_for(lock, std::chrono::milliseconds(200), [this] { return life->gone; });
    life->gone_while_called = life->gone;
  }
  std::shared_ptr<ListenerLife> life;
};

TEST(Reader, ThatIsReplacedKeepsItsFunctionUntilTheLastCallIsOver) {
  ::setenv("CYCLONEDDS_URI",
           "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"lo\" multicast=\"true\"/>"
           "</Interfaces></General></Domain></CycloneDDS>",
           1);
  const auto participant = Participant::create(78);
  ASSERT_TRUE(participant) << participant.error().what;
  auto life = std::make_shared<ListenerLife>();
  auto reader = Reader<Command>::create(*participant, "alone", SlowListener(life));
  auto writer = Writer<Command>::create(*participant, "alone");
  ASSERT_TRUE(reader && writer);
  life->gone = false;  // set by copies that are gone already
  // Within one participant, the writer's thread runs the listener.
  std::thread writing([&] { EXPECT_TRUE(writer->write(Command{})); });
  {
    std::unique_lock lock(life->mutex);
    ASSERT_TRUE(life->changed.wait_for(lock, std::chrono::seconds(10), [&] { return life->called; }));
  }
  *reader = {};
  writing.join();
  EXPECT_FALSE(life->gone_while_called);
  EXPECT_TRUE(life->gone);
}

TEST(Participant, SaysWhichInterfaceIsMissingAndWhichThereAre) {
  ::setenv(
      "CYCLONEDDS_URI",
      "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"nosuch0\"/></Interfaces></General>"
      "</Domain></CycloneDDS>",
      1);
  const auto participant = Participant::create(77);
  ASSERT_FALSE(participant);
  EXPECT_THAT(participant.error(), is_error(ErrorCode::unknown_name, 0, {"nosuch0", "lo"}));
  EXPECT_THAT(Participant::create(4000).error(), is_error(ErrorCode::invalid_value, 0, {"4000", "0 to 230"}));
}

}  // namespace
}  // namespace mechane::proto
