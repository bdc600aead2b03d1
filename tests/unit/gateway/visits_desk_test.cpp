#include "client-sdk/gateway/operations/visits_desk.hpp"

#include <condition_variable>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "client-sdk/gateway/operations/visits_json.hpp"
#include "server/visits/visit_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::gateway {
namespace {

using testing::ElementsAre;
using testing::SizeIs;
using visits::AnswerTime;
using visits::StepEnding;
using visits::VisitEnding;
using visits::VisitFile;
using visits::VisitRecord;
using Json = nlohmann::json;

VisitRecord visit_now(const std::string& number, const std::string& scenario = "screw",
                      const std::string& language = "el") {
  VisitRecord record;
  record.number = number;
  record.kiosk = "kiosk-1";
  record.scenario = scenario;
  record.activity = "use";
  record.language = language;
  record.minute = visits::minute_now() - 5;
  record.duration_s = 10;
  record.hands = 1;
  record.ending = VisitEnding::done;
  record.steps = {{"take", 4, StepEnding::done, false, true}, {"turn", 6, StepEnding::done, false, true}};
  record.answers = {{"easy", AnswerTime::after, "", 4, 5, {}}};
  return record;
}

/// A desk beside a server's file; the test's thread is the loop's.
class VisitsDeskTest : public testing::Test {
 protected:
  VisitsDeskTest() {
    std::filesystem::create_directory(records_);
    std::filesystem::create_directory(state_);
    desk_ = std::make_unique<VisitsDesk>(records_, state_, [this](std::function<void()> job) {
      const std::lock_guard lock(mutex_);
      jobs_.push_back(std::move(job));
      came_.notify_all();
    });
  }
  void put(const VisitRecord& record) {
    auto file = VisitFile::open(records_ / visits::kVisitFileName, VisitFile::Access::write_new);
    ASSERT_TRUE(file) << file.error().to_string();
    ASSERT_TRUE(file->put(record, true));
  }
  /// Waits for the answer.
  HttpAnswer answer_of(const std::function<void(Site::Done)>& ask) {
    std::optional<HttpAnswer> answer;
    ask([&](HttpAnswer got) { answer = std::move(got); });
    while (!answer) {
      std::function<void()> job;
      {
        std::unique_lock lock(mutex_);
        if (!came_.wait_for(lock, std::chrono::seconds(60), [&] { return !jobs_.empty(); })) break;
        job = std::move(jobs_.front());
        jobs_.erase(jobs_.begin());
      }
      job();
    }
    EXPECT_TRUE(answer);
    return answer.value_or(HttpAnswer{});
  }
  HttpAnswer read(const VisitsQuery& query = {}) {
    return answer_of([&](Site::Done done) {
      desk_->read(
          query, [](const VisitsFound& found) { return answer_with(visits_json(found), "application/json"); },
          std::move(done));
    });
  }
  HttpAnswer remark(const std::string& number, const std::string& text) {
    return answer_of([&](Site::Done done) { desk_->remark(number, {1, text, "eleni", 3.5}, std::move(done)); });
  }
  static Json json(const HttpAnswer& answer) {
    EXPECT_EQ(answer.status, 200U) << *answer.body;
    return Json::parse(*answer.body);
  }

  test::ScratchFolder scratch_;
  std::filesystem::path records_ = scratch_.path() / "records";
  std::filesystem::path state_ = scratch_.path() / "state";
  std::mutex mutex_;
  std::condition_variable came_;
  std::vector<std::function<void()>> jobs_;
  std::unique_ptr<VisitsDesk> desk_;
};

TEST_F(VisitsDeskTest, FiguresAreOfTheVisitsThatFitAndNamesOfAll) {
  put(visit_now("0000-0000-0000"));
  VisitRecord left = visit_now("0000-0000-0001");
  left.ending = VisitEnding::left;
  left.steps.back().ending = StepEnding::unfinished;
  put(left);
  put(visit_now("0000-0000-0002", "crane", "en"));
  VisitRecord old = visit_now("0000-0000-0003", "pump");
  old.minute -= 30 * 24 * 60;
  put(old);
  const Json all = json(read());
  EXPECT_EQ(all["visits"], 3);
  EXPECT_THAT(all["exhibitNames"], ElementsAre("crane", "screw"));
  EXPECT_THAT(all["languageNames"], ElementsAre("el", "en"));
  EXPECT_THAT(all["perDay"], SizeIs(8));
  EXPECT_EQ(all["satisfaction"]["satisfied"], 3);
  const Json screw = json(read({.days = 7, .exhibit = "screw"}));
  EXPECT_EQ(screw["visits"], 2);
  EXPECT_EQ(screw["activities"][0]["steps"][1]["left"], 1);
  EXPECT_EQ(screw["activities"][0]["steps"][0]["time"]["p90S"], 4);
  EXPECT_THAT(screw["exhibitNames"], ElementsAre("crane", "screw"));
  EXPECT_EQ(json(read({.days = 7, .language = "en"}))["recent"][0]["visit"], "0000-0000-0002");
  EXPECT_EQ(json(read({.days = 60}))["visits"], 4);
}

TEST_F(VisitsDeskTest, ARemarkIsKeptBesideTheRecordsWhichStayAsTheyAre) {
  put(visit_now("0000-0000-0000"));
  const auto file = records_ / visits::kVisitFileName;
  const auto before = std::filesystem::last_write_time(file);
  const Json kept = json(remark("0000-0000-0000", "laughed"));
  EXPECT_EQ(kept["remarks"],
            Json::parse(R"([{"when":"1970-01-01 00:01","author":"eleni","text":"laughed","at":3.5}])"));
  EXPECT_EQ(json(read())["recent"][0]["remarks"], kept["remarks"]);
  EXPECT_EQ(std::filesystem::last_write_time(file), before);
  EXPECT_EQ(remark("0000-0000-0009", "x").status, 404U);
  EXPECT_EQ(remark("0000", "x").status, 404U) << "a number's first letters are not enough here";
  EXPECT_EQ(remark("../../../../et", "x").status, 404U);
}

TEST_F(VisitsDeskTest, WhatTheServerForgotIsForgottenHere) {
  put(visit_now("0000-0000-0000"));
  put(visit_now("0000-0000-0001"));
  (void)json(remark("0000-0000-0000", "laughed"));
  auto file = VisitFile::open(records_ / visits::kVisitFileName, VisitFile::Access::write);
  ASSERT_TRUE(file);
  ASSERT_EQ(file->forget({.number = "0000-0000-0000"}).value(), 1U);
  EXPECT_EQ(json(read({.days = 8}))["visits"], 1);
  EXPECT_TRUE(visits::RemarkBook::open(state_ / visits::kRemarkBookName)->remarks().empty());
}

TEST_F(VisitsDeskTest, WithoutAFileItSaysSoAndManyQuestionsDoNotPileUp) {
  EXPECT_EQ(read().status, 404U);
  std::ofstream(records_ / visits::kVisitFileName) << "no database";
  EXPECT_GE(read().status, 400U);
  VisitsDesk none({}, state_, [](const std::function<void()>& job) { job(); });
  HttpAnswer answer;
  none.read({}, {}, [&](HttpAnswer got) { answer = std::move(got); });
  EXPECT_EQ(answer.status, 404U);
  std::size_t refused = 0, answered = 0;
  for (int i = 0; i < 100; ++i)
    desk_->read(
        {}, [](const VisitsFound&) { return HttpAnswer{}; },
        [&](const HttpAnswer& got) { ++(got.status == 503 ? refused : answered); });
  EXPECT_EQ(refused, 84U) << "sixteen may wait for the loop's thread, which took no answer yet";
}

TEST(VisitsQuery, IsReadOrRefusedWithARemedy) {
  EXPECT_EQ(parse_visits_query({})->days, 7);
  const auto query = parse_visits_query({{"days", "30"}, {"exhibit", "screw"}, {"language", "el"}});
  ASSERT_TRUE(query);
  EXPECT_EQ(query->days, 30);
  EXPECT_EQ(query->exhibit + query->language, "screwel");
  for (const char* days : {"0", "-1", "x", "7x", "3661", "99999999999999999999", " 7"})
    EXPECT_FALSE(parse_visits_query({{"days", days}})) << days;
  EXPECT_FALSE(parse_visits_query({{"exhibit", std::string(101, 'x')}}));
}

TEST(RemarkMessage, IsReadOrRefusedWithARemedy) {
  const auto remark = parse_remark(R"({"text":"laughed","at":35.5})", "eleni");
  ASSERT_TRUE(remark);
  EXPECT_EQ(remark_line(*remark), "eleni, at 36 s: laughed");
  EXPECT_FALSE(parse_remark(R"({"text":"laughed","at":null})", "eleni")->at_s);
  for (const char* body : {"", "[]", "{}", R"({"text":1})", R"({"text":""})", R"({"text":"x","at":"1"})",
                           R"({"text":"x","at":-1})", R"({"text":"x","at":1e99})", "{\"text\":\"\xff\"}"}) {
    const auto wrong = parse_remark(body, "eleni");
    ASSERT_FALSE(wrong) << body;
    EXPECT_FALSE(wrong.error().remedy.empty());
  }
}

}  // namespace
}  // namespace mechane::gateway
