#include "server/visits/remark_book.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"

namespace mechane::visits {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kOne = "k7m2-9qxd-4tz0";
constexpr const char* kOther = "0000-0000-0001";

class RemarkBookTest : public testing::Test {
 protected:
  RemarkBook open() {
    auto book = RemarkBook::open(file_);
    EXPECT_TRUE(book) << book.error().to_string();
    return *book;
  }
  test::ScratchFolder scratch_;
  std::filesystem::path file_ = scratch_.path() / kRemarkBookName;
};

TEST_F(RemarkBookTest, RemarksAreThereAfterARestartAndGoIntoTheirRecords) {
  const RecordedRemark first{500, "asked twice\nthen laughed", "eleni", 35.5}, second{501, "γέλασε", "eva", {}};
  RemarkBook book = open();
  ASSERT_TRUE(book.add(kOne, first));
  ASSERT_TRUE(book.add(kOne, second));
  std::vector<VisitRecord> records(2);
  records[0].number = kOther;
  records[1].number = kOne;
  records[1].remarks = {{400, "by the command", "", {}}};
  open().put_into(records);
  EXPECT_THAT(records[0].remarks, IsEmpty());
  EXPECT_EQ(records[1].remarks, (std::vector<RecordedRemark>{{400, "by the command", "", {}}, first, second}));
}

TEST_F(RemarkBookTest, WhatTheServerForgetsIsForgottenHereToo) {
  RemarkBook book = open();
  ASSERT_TRUE(book.add(kOne, {500, "x", "eleni", {}}));
  ASSERT_TRUE(book.add(kOther, {500, "y", "eleni", {}}));
  ASSERT_TRUE(book.keep_only({kOther}));
  EXPECT_THAT(book.remarks(), SizeIs(1));
  std::ifstream in(file_);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}).find("k7m2"), std::string::npos);
  EXPECT_EQ(open().remarks(), book.remarks());
}

TEST_F(RemarkBookTest, WhatCannotBeKeptIsRefusedAndChangesNothing) {
  RemarkBook book = open();
  for (const RecordedRemark& wrong :
       {RecordedRemark{1, "", "eleni", {}}, RecordedRemark{1, std::string(kLongestRemark + 1, 'x'), "eleni", {}},
        RecordedRemark{1, "\x1b[2J", "eleni", {}}, RecordedRemark{1, "\xff", "eleni", {}},
        RecordedRemark{1, "x", "", {}}, RecordedRemark{1, "x", "eleni", -1},
        RecordedRemark{1, "x", "eleni", std::nan("")}}) {
    const auto added = book.add(kOne, wrong);
    ASSERT_FALSE(added) << wrong.text;
    EXPECT_FALSE(added.error().remedy.empty());
  }
  for (std::size_t i = 0; i < RemarkBook::kMostOfVisit; ++i)
    ASSERT_TRUE(book.add(kOne, {1, "x", "eleni", {}}));
  EXPECT_EQ(book.add(kOne, {1, "x", "eleni", {}}).error().code, ErrorCode::conflict);
  EXPECT_THAT(open().remarks().at(kOne), SizeIs(RemarkBook::kMostOfVisit));
  std::filesystem::remove(file_);
  std::filesystem::create_directory(file_);
  ASSERT_FALSE(book.add(kOther, {1, "x", "eleni", {}})) << "it cannot be written";
  EXPECT_FALSE(book.remarks().contains(kOther));
}

TEST_F(RemarkBookTest, ADamagedFileIsAnErrorAndStaysAsItIs) {
  for (const char* text :
       {"", "{", "[]", R"({"remarks":[1]})", R"({"remarks":[{"visit":"../../x","minute":1,"author":"a","text":"b"}]})",
        R"({"remarks":[{"visit":"k7m2-9qxd-4tz0","minute":-1,"author":"a","text":"b"}]})",
        R"({"remarks":[{"visit":"k7m2-9qxd-4tz0","minute":1,"author":"a","text":"b","at_s":"c"}]})"}) {
    std::ofstream(file_) << text;
    const auto book = RemarkBook::open(file_);
    ASSERT_FALSE(book) << text;
    EXPECT_EQ(book.error().code, ErrorCode::damaged);
  }
}

TEST(VisitNumber, OnlyWholeNumbersHaveItsForm) {
  EXPECT_TRUE(is_visit_number(new_visit_number()));
  for (const char* text : {"", "k7m2", "k7m2-9qxd-4tz", "k7m2-9qxd-4tz0x", "K7M2-9QXD-4TZ0", "k7m2/9qxd/4tz0",
                           "k7m2-9qxd-4ti0", "../../../../et"})
    EXPECT_FALSE(is_visit_number(text)) << text;
}

}  // namespace
}  // namespace mechane::visits
