#include <cstdlib>

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
