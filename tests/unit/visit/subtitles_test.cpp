#include "client-sdk/visit/subtitles.hpp"

#include <gtest/gtest.h>

namespace mechane::visit {
namespace {

TEST(Subtitles, go_sentence_by_sentence_and_know_abbreviations) {
  EXPECT_EQ(sentences_of("Each blade scoops water from the river. The water lies at the bottom of every turn."),
            (std::vector<std::string>{"Each blade scoops water from the river.",
                                      "The water lies at the bottom of every turn."}));
  EXPECT_EQ(sentences_of("Ποιος ανεβάζει το νερό εδώ; Ο κοχλίας."),
            (std::vector<std::string>{"Ποιος ανεβάζει το νερό εδώ;", "Ο κοχλίας."}));
  EXPECT_EQ(sentences_of("Ktesibios lived in Alexandria in the 3rd c. B.C. with his father, a barber.").size(), 1U);
  EXPECT_EQ(sentences_of("Turn. The water comes, and then it falls into the basin.").size(), 1U) << "few words stay";
  EXPECT_TRUE(sentences_of("").empty());
  EXPECT_EQ(sentences_of("Ends without a full stop").size(), 1U);
}

client::WorldStatus speaking(const std::string& step) {
  client::WorldStatus status;
  status.step = step;
  status.narration = {{"en", "Each blade scoops water from the river. The water rises with every turn."},
                      {"el", "Κάθε έλικα παίρνει νερό από το ποτάμι."}};
  return status;
}

TEST(Subtitles, last_as_long_as_the_voice_and_begin_anew_with_each_step_and_language) {
  const TimePoint begin{};
  Subtitles subtitles;
  EXPECT_EQ(subtitles.at(begin), "");
  subtitles.hear(nullptr, "en", begin);
  const client::WorldStatus turn = speaking("turn");
  const std::string first = "Each blade scoops water from the river.", second = "The water rises with every turn.";
  const Duration instant = std::chrono::milliseconds(1);
  subtitles.hear(&turn, "en", begin);
  EXPECT_EQ(subtitles.at(begin), first);
  subtitles.hear(&turn, "en", begin + time_to_say(first) - instant);
  EXPECT_EQ(subtitles.at(begin + time_to_say(first) - instant), first);
  EXPECT_EQ(subtitles.at(begin + time_to_say(first)), second);
  EXPECT_EQ(subtitles.at(begin + time_to_say(first) + time_to_say(second)), "") << "nobody speaks any more";
  EXPECT_GT(time_to_say(first), std::chrono::seconds(3));
  const TimePoint later = begin + std::chrono::minutes(1);
  subtitles.hear(&turn, "el", later);
  EXPECT_EQ(subtitles.at(later), turn.narration.at("el"));
  const client::WorldStatus fill = speaking("fill");
  subtitles.hear(&fill, "el", later + std::chrono::minutes(1));
  EXPECT_EQ(subtitles.at(later + std::chrono::minutes(1)), fill.narration.at("el"));
  client::WorldStatus done = fill;
  done.done = true;
  subtitles.hear(&done, "el", later + std::chrono::minutes(1));
  EXPECT_EQ(subtitles.at(later + std::chrono::minutes(1)), "");
}

TEST(Subtitles, a_letter_of_two_bytes_takes_no_longer) {
  EXPECT_EQ(time_to_say("νερό"), time_to_say("nero"));
}

TEST(NarrationId, each_step_has_an_id_of_its_own) {
  client::WorldStatus status;
  EXPECT_EQ(narration_id(status), "");
  status.world = "world-1";
  status.activity = "use";
  status.step = "turn";
  const std::string id = narration_id(status);
  EXPECT_EQ(narration_id(status), id);
  status.step = "fill";
  EXPECT_NE(narration_id(status), id);
}

}  // namespace
}  // namespace mechane::visit
