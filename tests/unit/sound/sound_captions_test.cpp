#include "client-sdk/sound/sound_captions.hpp"

#include <set>

#include <gtest/gtest.h>

namespace mechane::sound {
namespace {

std::vector<SoundSource> sounding(SoundKind kind, double gain = 1) {
  return {{"a", kind, Vec3::Zero(), gain, 1, 2, true}};
}

TEST(SoundCaptions, say_what_begins_and_not_what_goes_on) {
  const TimePoint begin{};
  SoundCaptions captions;
  EXPECT_EQ(captions.at(begin, "en"), "");
  captions.hear(sounding(SoundKind::creak, 0.25), begin);
  EXPECT_EQ(captions.at(begin, "en"), "") << "hardly to be heard";
  for (int i = 0; i <= 60; ++i)
    captions.hear(sounding(SoundKind::creak), begin + std::chrono::seconds(i));
  EXPECT_EQ(captions.at(begin, "en"), "[wood creaking]");
  EXPECT_EQ(captions.at(begin, "el"), "[τρίξιμο ξύλου]");
  EXPECT_EQ(captions.at(begin + std::chrono::milliseconds(2999), "en"), "[wood creaking]");
  EXPECT_EQ(captions.at(begin + std::chrono::seconds(3), "en"), "");
  EXPECT_EQ(captions.at(begin + std::chrono::seconds(60), "en"), "") << "it has gone on all the time";
}

TEST(SoundCaptions, say_it_again_after_a_silence) {
  const TimePoint begin{};
  SoundCaptions captions;
  captions.hear(sounding(SoundKind::water), begin);
  captions.hear({}, begin + std::chrono::seconds(10));
  captions.hear(sounding(SoundKind::water), begin + std::chrono::seconds(20));
  EXPECT_EQ(captions.at(begin + std::chrono::seconds(20), "en"), "") << "a pause";
  captions.hear(sounding(SoundKind::water), begin + std::chrono::seconds(41));
  captions.hear(sounding(SoundKind::bow), begin + std::chrono::seconds(42));
  EXPECT_EQ(captions.at(begin + std::chrono::seconds(42), "en"), "[water running] [bowstring snapping]");
}

TEST(SoundCaptions, have_words_of_their_own_for_every_sound) {
  for (const std::string language : {"en", "el"}) {
    std::set<std::string> all;
    for (const SoundKind kind : kSoundKinds) {
      SoundCaptions captions;
      captions.hear(sounding(kind), TimePoint{});
      EXPECT_GT(captions.at(TimePoint{}, language).size(), 5U);
      all.insert(captions.at(TimePoint{}, language));
    }
    EXPECT_EQ(all.size(), kSoundKinds.size());
  }
}

}  // namespace
}  // namespace mechane::sound
