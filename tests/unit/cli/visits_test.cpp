#include "client-sdk/cli/visits.hpp"

#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "server/visits/remark_book.hpp"
#include "server/visits/visit_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using visits::AnswerTime;
using visits::MistakeKind;
using visits::StepEnding;
using visits::VisitEnding;
using visits::VisitFile;
using visits::VisitRecord;

VisitRecord visit_of(const std::string& number, double turn_s, VisitEnding ending = VisitEnding::done) {
  VisitRecord record;
  record.number = number;
  record.kiosk = "kiosk-1";
  record.scenario = "machine";
  record.scenario_hash = "hash";
  record.activity = "use";
  record.minute = 29'922'357;
  record.duration_s = 2 + turn_s;
  record.hands = 1;
  record.ending = ending;
  record.steps = {
      {"take", 2, StepEnding::done, false, true},
      {"turn", turn_s, ending == VisitEnding::done ? StepEnding::done : StepEnding::unfinished, false, true}};
  return record;
}

/// Ten visits: eight done (one with a hint, two with mistakes), one left, one cut off.
std::vector<VisitRecord> ten_visits() {
  std::vector<VisitRecord> records;
  for (int i = 0; i < 8; ++i) {
    records.push_back(visit_of("000" + std::to_string(i) + "-0000-0000", 1 + i));
    records.back().answers.push_back({"easy", AnswerTime::after, "", i < 6 ? 5 : 3, 5, {}});
    records.back().answers.push_back({"why", AnswerTime::before, i < 2 ? "water" : "wind", 0, 0, i < 2});
    records.back().answers.push_back({"why", AnswerTime::after, i < 6 ? "water" : "wind", 0, 0, i < 6});
  }
  records[0].steps[1].hint_shown = true;
  records[1].mistakes = {{MistakeKind::let_go, "STONE", 3}};
  records[2].mistakes = {{MistakeKind::restarted, "", 1}, {MistakeKind::let_go, "STONE", 1}};
  records.push_back(visit_of("0008-0000-0000", 100, VisitEnding::left));
  records.push_back(visit_of("0009-0000-0000", 200, VisitEnding::cut));
  return records;
}

/// A file of visits in a folder of the test; and what the command said last.
class VisitsTest : public testing::Test {
 protected:
  VisitsTest() { options_.records = folder_; }
  void keep(const std::vector<VisitRecord>& records) {
    auto file = VisitFile::open(folder_ / "visits.db", VisitFile::Access::write_new);
    ASSERT_TRUE(file) << file.error().to_string();
    for (const VisitRecord& record : records)
      ASSERT_TRUE(file->put(record, true));
  }
  int run(std::string_view verb) {
    std::ostringstream out;
    std::ostringstream errors;
    const int status = run_visits(verb, options_, out, errors);
    out_ = out.str();
    errors_ = errors.str();
    return status;
  }
  nlohmann::json json(std::string_view verb) {
    options_.json = true;
    EXPECT_EQ(run(verb), 0) << errors_;
    return nlohmann::json::parse(out_);
  }
  static std::string text_of(const fs::path& file) {
    std::stringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  }

  test::ScratchFolder scratch_;
  fs::path folder_ = scratch_.path();
  VisitsOptions options_;
  std::string out_;
  std::string errors_;
};

TEST_F(VisitsTest, TheReportCountsWhatVisitorsDidAndSaid) {
  keep(ten_visits());
  const auto report = json("");
  EXPECT_EQ(report["visits"], 10);
  EXPECT_EQ(report["satisfaction"]["marks"], 8);
  EXPECT_EQ(report["satisfaction"]["satisfied"], 6);
  ASSERT_THAT(report["activities"], SizeIs(1));
  const auto& use = report["activities"][0];
  EXPECT_EQ(use["done"], 8);
  EXPECT_EQ(use["done_alone"], 7);
  EXPECT_EQ(use["left"], 1);
  EXPECT_EQ(use["cut"], 1);
  EXPECT_EQ(use["mistakes"]["let go"], 4);
  EXPECT_DOUBLE_EQ(use["mistakes_a_visit"], 5.0 / 9);
  EXPECT_DOUBLE_EQ(use["time"]["median_s"], 6.5);
  EXPECT_EQ(use["steps"][0]["step"], "take");
  EXPECT_EQ(use["steps"][1]["visits"], 10);
  EXPECT_EQ(use["steps"][1]["done"], 8);
  EXPECT_EQ(use["steps"][1]["hints"], 1);
  EXPECT_DOUBLE_EQ(use["steps"][1]["time"]["median_s"], 4.5);
  EXPECT_DOUBLE_EQ(use["steps"][1]["time"]["p90_s"], 8);
  ASSERT_THAT(use["questions"], SizeIs(3));
  EXPECT_EQ(use["questions"][0]["asked"], "before");
  EXPECT_EQ(use["questions"][0]["right"], 2);
  EXPECT_EQ(use["questions"][1]["question"], "easy");
  EXPECT_DOUBLE_EQ(use["questions"][1]["mean"], 4.5);
  EXPECT_NEAR(use["questions"][1]["spread"], 0.9258, 1e-4);
  EXPECT_EQ(use["questions"][2]["right"], 6);
  options_.json = false;
  EXPECT_EQ(run(""), 0);
  EXPECT_THAT(out_, AllOf(HasSubstr("done 8 of 9 (89 %), 7 without help (78 %), 1 left; 1 cut off"),
                          HasSubstr("errors a visit 0.56 (let go 4, restarted 1); 1 hint"), HasSubstr("4.50 of 5"),
                          HasSubstr("satisfied: 75 % (6 of 8 marks")));
}

TEST_F(VisitsTest, TimesOfWhoCameInTheMidstAreNoMeasure) {
  VisitRecord late = visit_of("0000-0000-0000", 90);
  late.from_start = false;
  late.steps = {{"turn", 1, StepEnding::done, false, false}};
  keep({late});
  const auto report = json("");
  EXPECT_EQ(report["activities"][0]["time"]["count"], 0);
  EXPECT_EQ(report["activities"][0]["steps"][0]["time"]["count"], 0);
  EXPECT_EQ(report["activities"][0]["done"], 1);
  EXPECT_EQ(report["activities"][0]["done_alone"], 0);
}

TEST_F(VisitsTest, ItIsChosenByScenarioKioskAndDate) {
  std::vector<VisitRecord> records = ten_visits();
  records[0].kiosk = "kiosk-2";
  records[1].scenario = "other";
  records[2].minute += 24 * 60;
  keep(records);
  options_.kiosk = "kiosk-2";
  EXPECT_EQ(json("")["visits"], 1);
  options_.kiosk.clear();
  options_.scenario = "other";
  EXPECT_EQ(json("")["visits"], 1);
  options_.scenario.clear();
  options_.since = "2026-11-23";
  EXPECT_EQ(json("")["visits"], 1);
  options_.since = "last week";
  EXPECT_EQ(run(""), 2);
  EXPECT_THAT(errors_, HasSubstr("last week: this is not a date; write it as 2026-11-22"));
}

TEST_F(VisitsTest, AScenarioOrKioskThatNoVisitHasIsToldWithThoseThatAre) {
  options_.scenario = "archimedes-scew";
  keep({});
  EXPECT_EQ(run("list"), 0) << "without a visit nothing is known to be wrong";
  auto records = ten_visits();
  records[1].scenario = "archimedes-screw";
  keep(records);
  for (const char* verb : {"", "list"}) {
    EXPECT_EQ(run(verb), 2);
    EXPECT_THAT(out_, IsEmpty());
    EXPECT_THAT(errors_, AllOf(HasSubstr("no visit has the scenario 'archimedes-scew'"),
                               HasSubstr("did you mean 'archimedes-screw'?")));
  }
  options_.scenario = "pump";
  EXPECT_EQ(run(""), 2);
  EXPECT_THAT(errors_, HasSubstr("use one of: archimedes-screw, machine"));
  options_.scenario = "machine";
  options_.kiosk = "desk";
  EXPECT_EQ(run(""), 2);
  EXPECT_THAT(errors_, AllOf(HasSubstr("no visit has the kiosk 'desk'"), HasSubstr("use one of: kiosk-1")));
  options_.kiosk.clear();
  options_.since = "9998-01-01";
  EXPECT_EQ(run(""), 0) << "a known scenario, of which there was no visit since";
  EXPECT_THAT(out_, HasSubstr("0 visits"));
}

TEST_F(VisitsTest, TheListShowsTheNewestAndAPageAllOfOne) {
  keep(ten_visits());
  options_.last = 3;
  EXPECT_EQ(run("list"), 0);
  EXPECT_THAT(out_, AllOf(HasSubstr("0009-0000-0000"), Not(HasSubstr("0006-0000-0000")), HasSubstr("3 visits")));
  options_.last = 0;
  EXPECT_THAT(json("list"), SizeIs(10));
  options_.json = false;
  options_.visit = "0002";
  EXPECT_EQ(run("show"), 0);
  EXPECT_THAT(out_, AllOf(HasSubstr("error     let go (STONE), 1 time"), HasSubstr("answer    easy, after: 5 of 5"),
                          HasSubstr("why, before: wind, wrong")));
  options_.visit = "zzzz";
  EXPECT_EQ(run("show"), 1);
  EXPECT_THAT(errors_, HasSubstr("mechane visits list"));
}

TEST_F(VisitsTest, AnObserverRemarksAndForgets) {
  keep(ten_visits());
  options_.visit = "0003";
  options_.text = "asked, \"why?\"";
  EXPECT_EQ(run("remark"), 0) << errors_;
  EXPECT_THAT(out_, HasSubstr("0003-0000-0000: remark kept"));
  options_.visit = "000";
  EXPECT_EQ(run("remark"), 1);
  options_.visit = "0004";
  EXPECT_EQ(run("forget"), 0) << errors_;
  EXPECT_EQ(out_, "1 visit forgotten\n");
  EXPECT_EQ(run("forget"), 1) << "it is gone";
  options_.visit = "000";
  EXPECT_EQ(run("forget"), 1) << "too short to be meant";
  options_.visit.clear();
  EXPECT_EQ(run("forget"), 2) << "all must not be forgotten by saying nothing";
  EXPECT_EQ(json("")["visits"], 9);
  EXPECT_EQ(json("")["activities"][0]["remarks"], 1);
  options_.before = "2026-11-23";
  EXPECT_EQ(run("forget"), 0);
  options_.before.clear();
  EXPECT_EQ(json("")["visits"], 0);
}

TEST_F(VisitsTest, AConsolesRemarksAreInTheReportTheListAndTheSpreadsheet) {
  keep(ten_visits());
  options_.remarks = folder_ / "remarks.json";
  EXPECT_EQ(run(""), 1) << "a name that is spelt wrongly must not look like a book without remarks";
  EXPECT_THAT(errors_, HasSubstr("the file of remarks does not exist"));
  auto book = visits::RemarkBook::open(options_.remarks);
  ASSERT_TRUE(book);
  ASSERT_TRUE(book->add("0003-0000-0000", {29'922'360, "laughed, twice", "eleni", 35.2}));
  EXPECT_EQ(json("")["activities"][0]["remarks"], 1);
  options_.json = false;
  options_.csv = folder_ / "visits.csv";
  EXPECT_EQ(run(""), 0) << errors_;
  EXPECT_THAT(text_of(options_.csv), HasSubstr("\"eleni, at 35 s: laughed, twice\""));
  options_.visit = "0003";
  EXPECT_EQ(run("show"), 0);
  EXPECT_THAT(out_, HasSubstr("remark    2026-11-22 10:00: eleni, at 35 s: laughed, twice"));
}

TEST_F(VisitsTest, TheSpreadsheetHasALineAVisitAndNoFormula) {
  std::vector<VisitRecord> records = ten_visits();
  records[0].kiosk = "=HYPERLINK(\"x\")";
  records[1].kiosk = "a,b\nc";
  keep(records);
  options_.csv = folder_ / "visits.csv";
  EXPECT_EQ(run(""), 0) << errors_;
  EXPECT_THAT(errors_, HasSubstr("wrote"));
  const std::string csv = text_of(options_.csv);
  EXPECT_THAT(csv, AllOf(HasSubstr("use turn s"), HasSubstr("use before: why"), HasSubstr("\"'=HYPERLINK(\"\"x\"\")\""),
                         HasSubstr("\"a,b\nc\"")));
  std::size_t lines = 0;
  for (std::size_t at = csv.find("\r\n"); at != std::string::npos; at = csv.find("\r\n", at + 2))
    ++lines;
  EXPECT_EQ(lines, 11U);
  options_.csv = folder_ / "nowhere" / "visits.csv";
  EXPECT_EQ(run(""), 1);
  EXPECT_THAT(errors_, HasSubstr("cannot be written"));
}

TEST_F(VisitsTest, ThePlotIsDrawnAndSafe) {
  std::vector<VisitRecord> records = ten_visits();
  for (VisitRecord& record : records)
    record.activity = "<script>&'";
  keep(records);
  options_.svg = folder_ / "visits.svg";
  EXPECT_EQ(run(""), 0) << errors_;
  EXPECT_THAT(text_of(options_.svg), AllOf(HasSubstr("<svg xmlns="), HasSubstr("&lt;script&gt;&amp;&#39;"),
                                           Not(HasSubstr("<script")), HasSubstr(">4.5 ± 0.9 of 5, n 8<"),
                                           HasSubstr("25 → 75 %"), HasSubstr(">78 %<"), HasSubstr(">11 %<")));
}

TEST_F(VisitsTest, NothingIsAReportToo) {
  keep({});
  options_.svg = folder_ / "visits.svg";
  EXPECT_EQ(run(""), 0);
  EXPECT_EQ(out_, "0 visits\n");
  EXPECT_THAT(text_of(options_.svg), HasSubstr("no visit yet"));
  EXPECT_EQ(run("list"), 0);
  EXPECT_EQ(out_, "0 visits\n");
}

TEST_F(VisitsTest, WhatIsNotAFileOfVisitsIsSaidOnOneLine) {
  EXPECT_EQ(run(""), 1);
  EXPECT_THAT(errors_, AllOf(HasSubstr("visits.db: there is no file of visits"), HasSubstr("--records")));
  std::ofstream(folder_ / "letter.txt") << std::string(2000, 'a');
  options_.file = folder_ / "letter.txt";
  for (const char* verb : {"", "list", "show", "remark", "forget"}) {
    options_.visit = "0000";
    options_.text = "x";
    EXPECT_EQ(run(verb), 1) << verb;
    EXPECT_THAT(errors_, HasSubstr("not a file of visits")) << verb;
    EXPECT_THAT(out_, IsEmpty()) << verb;
  }
}

}  // namespace
}  // namespace mechane::cli
