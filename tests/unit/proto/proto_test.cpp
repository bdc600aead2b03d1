#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>

#include <mechane/proto/entity.hpp>
#include <mechane/proto/names.hpp>

namespace mechane::proto {
namespace {

TEST(Names, AreKeptToWhatAPartitionCanHold) {
  EXPECT_TRUE(is_name("kiosk-1"));
  EXPECT_TRUE(is_name(std::string(31, 'a')));
  for (const std::string& bad :
       {std::string(), std::string(32, 'a'), std::string("a*"), std::string("a/b"), std::string("ä")}) {
    EXPECT_FALSE(is_name(bad)) << bad;
  }
  EXPECT_FALSE(check_name("a b", "kiosk").error().remedy.empty());
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

/// What a listener's function saw of its own life.
struct ListenerLife {
  std::mutex mutex;
  std::condition_variable changed;
  bool called = false;
  bool gone = false;
  bool gone_while_called = false;
};

/// A listener's function that takes its time, and tells when it is no more.
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
    // Long enough for who replaces the reader to do it wrongly; who does it rightly waits for the end of this call.
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
  life->gone = false;  // of the copies that were made on the way
  // Of one participant, the writer's thread runs the listener.
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
  EXPECT_NE(participant.error().what.find("nosuch0"), std::string::npos);
  EXPECT_NE(participant.error().remedy.find("lo"), std::string::npos);
  EXPECT_FALSE(Participant::create(4000));
}

}  // namespace
}  // namespace mechane::proto
