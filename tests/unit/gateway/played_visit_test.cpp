#include "client-sdk/gateway/drafts/played_visit.hpp"

#include <atomic>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/scratch_folder.hpp"

namespace mechane::gateway {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::vector<std::string> kReport{
    "[info] joined",
    "{",
    R"(  "complete": false,)",
    R"(  "activities": [)",
    "    {",
    R"(      "done": false, "reason": "in step lift", "moves": [)",
    R"(        {"name": "reach DRUM", "ok": true, "reason": "", "seconds": 2.1},)",
    R"(        {"name": "turn AXLE", "ok": false, "reason": "it slipped", "seconds": 3}]}])",
    "}"};

TEST(VisitReport, IsReadAfterWhateverElseWasSaid) {
  const json told = read_visit_report(kReport);
  EXPECT_EQ(told["state"], "incomplete");
  EXPECT_EQ(told["reason"], "in step lift");
  EXPECT_EQ(told["moves"], json::parse(R"([{"name": "reach DRUM", "ok": true, "reason": ""},
                                           {"name": "turn AXLE", "ok": false, "reason": "it slipped"}])"));
  EXPECT_EQ(read_visit_report({"{", R"("activities": [{"done": true}])", "}"})["state"], "done");
}

TEST(VisitReport, WithoutOneTheLastLinesSayWhy) {
  for (const std::vector<std::string>& said :
       {std::vector<std::string>{}, {"error: no kiosk"}, {"{", "cut short"}, {"{", R"("activities": [])", "}"}}) {
    const json told = read_visit_report(said);
    EXPECT_EQ(told["state"], "failed");
    EXPECT_THAT(told["reason"].get<std::string>(), HasSubstr(said.empty() ? "" : said.back()));
  }
}

TEST(PlayedVisit, IsPlayingUntilItsProgramHasEnded) {
  const test::ScratchFolder folder;
  const auto visitor =
      folder.script("visitor", R"(echo "$*" > "$0.log"; echo '{'; echo '"activities": [{"done": true}]'; echo '}')");
  std::atomic<bool> over{false};
  auto played = PlayedVisit::start(visitor, {"mine.x3d", 57, "studio-mine", "lifting"}, [&over] { over = true; });
  ASSERT_TRUE(played) << played.error().to_string();
  EXPECT_EQ(played->to_json(), (json{{"name", "lifting"}, {"state", "playing"}}));
  while (!over)
    std::this_thread::yield();
  played->note_end();
  EXPECT_EQ(played->to_json()["state"], "done");
  EXPECT_EQ(played->to_json()["name"], "lifting");
  EXPECT_EQ(played->end(), nullptr) << "it has gone";
}

}  // namespace
}  // namespace mechane::gateway
