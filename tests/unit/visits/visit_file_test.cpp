#include "server/visits/visit_file.hpp"

#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>
#include <unistd.h>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/visits/visit_sheet_samples.hpp"

namespace mechane::visits {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using Access = VisitFile::Access;
using Trouble = VisitFile::Trouble;

class VisitFolder {
 public:
  [[nodiscard]] fs::path file() const { return folder_.path() / kVisitFileName; }

 private:
  test::ScratchFolder folder_{test::folder_in_memory()};
};

VisitFile open_visits(const fs::path& file, Access access = Access::write_new) {
  auto opened = VisitFile::open(file, access);
  EXPECT_TRUE(opened) << opened.error().to_string();
  return std::move(*opened);
}

std::string file_bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

RC_GTEST_PROP(VisitFile, WhatIsPutComesBackAndANewerStateTakesItsPlace, ()) {
  const VisitFolder folder;
  const VisitSheet first = any_sheet();
  VisitSheet second = any_sheet();
  {
    VisitFile file = open_visits(folder.file());
    RC_ASSERT(file.put(first, true).value());
    RC_ASSERT(file.put(second, true).value());
    const std::string number = second.number;
    second = any_sheet();
    second.number = number;
    RC_ASSERT(file.put(second, false).value());
  }
  const VisitFile file = open_visits(folder.file(), Access::read);
  RC_ASSERT(file.sheets({.number = first.number}).value() == std::vector{first});
  RC_ASSERT(file.sheets({.number = second.number}).value() == std::vector{second});
  RC_ASSERT(file.count().value() == 2U);
}

TEST(VisitFile, SheetsAreChosen) {
  const VisitFolder folder;
  VisitFile file = open_visits(folder.file());
  std::vector<VisitSheet> sheets{plain_sheet(100), plain_sheet(200), plain_sheet(300)};
  sheets[1].kiosk = "kiosk-2";
  sheets[2].scenario = "other";
  for (const VisitSheet& sheet : sheets)
    ASSERT_TRUE(file.put(sheet, true));
  EXPECT_EQ(file.sheets({}).value(), sheets);
  EXPECT_EQ(file.sheets({.since = 200}).value(), (std::vector{sheets[1], sheets[2]}));
  EXPECT_EQ(file.sheets({.before = 200}).value(), std::vector{sheets[0]});
  EXPECT_EQ(file.sheets({.scenario = "other"}).value(), std::vector{sheets[2]});
  EXPECT_EQ(file.sheets({.kiosk = "kiosk-2"}).value(), std::vector{sheets[1]});
  EXPECT_THAT(file.sheets({.scenario = "x' OR 1 --"}).value(), IsEmpty());
}

TEST(VisitFile, ANumberIsTypedAsAPersonWould) {
  const VisitFolder folder;
  VisitFile file = open_visits(folder.file());
  VisitSheet sheet = plain_sheet();
  sheet.number = "k7m2-9qxd-4tz0";
  ASSERT_TRUE(file.put(sheet, true));
  for (const char* typed : {"k7m2", "k7m2-9", "K7M29QXD4TZ0", "k7m2 9qxd 4tz0", "k7m29"})
    EXPECT_THAT(file.sheets({.number = typed}).value(), SizeIs(1)) << typed;
  EXPECT_THAT(file.sheets({.number = "9qxd"}).value(), IsEmpty());
  EXPECT_THAT(file.sheets({.number = "%"}).value(), IsEmpty());
}

TEST(VisitFile, RemarksAreTheObserversAndStay) {
  const VisitFolder folder;
  VisitFile server = open_visits(folder.file());
  VisitSheet sheet = plain_sheet();
  ASSERT_TRUE(server.put(sheet, true));
  {
    VisitFile observer = open_visits(folder.file(), Access::write);
    EXPECT_EQ(observer.remark(sheet.number.substr(0, 6), {500, "asked twice\nthen laughed"}).value(), sheet.number);
    ASSERT_TRUE(observer.remark(sheet.number, {501, std::string(kLongestRemark, 'x')}));
    EXPECT_THAT(observer.remark(sheet.number, {501, std::string(kLongestRemark + 1, 'x')}).error().remedy,
                HasSubstr("1 to 2000"));
    EXPECT_FALSE(observer.remark(sheet.number, {501, ""}));
    EXPECT_FALSE(observer.remark(sheet.number, {501, "\x1b[2J"}));
    EXPECT_THAT(observer.remark("", {501, "x"}).error().what, HasSubstr("too few letters"));
    EXPECT_THAT(observer.remark("zzzz-zzzz-zzzz", {501, "x"}).error().what, HasSubstr("no visit of this number"));
  }
  sheet.hands = 2;
  ASSERT_TRUE(server.put(sheet, false).value());
  const auto sheets = server.sheets({}).value();
  ASSERT_THAT(sheets, SizeIs(1));
  EXPECT_EQ(sheets[0].hands, 2U);
  ASSERT_THAT(sheets[0].remarks, SizeIs(2));
  EXPECT_EQ(sheets[0].remarks[0], (SheetRemark{500, "asked twice\nthen laughed"}));
}

TEST(VisitFile, WhatIsForgottenIsGoneFromTheDiskAndStaysForgotten) {
  const VisitFolder folder;
  VisitFile server = open_visits(folder.file());
  VisitSheet sheet = plain_sheet();
  sheet.mistakes[0].subject = "a-word-to-be-found";
  ASSERT_TRUE(server.put(sheet, true));
  ASSERT_TRUE(server.put(plain_sheet(), true));
  EXPECT_THAT(file_bytes(folder.file().string() + "-wal"), HasSubstr("a-word-to-be-found"));
  EXPECT_FALSE(server.forget({})) << "a choice of nothing must not be all";
  EXPECT_EQ(open_visits(folder.file(), Access::write).forget({.number = sheet.number}).value(), 1U);
  EXPECT_FALSE(server.put(sheet, false).value()) << "it was still running, and nobody wants it";
  EXPECT_EQ(server.count().value(), 1U);
  for (const char* beside : {"", "-wal", "-shm"})
    EXPECT_THAT(file_bytes(folder.file().string() + beside), Not(HasSubstr("a-word-to-be-found"))) << beside;
}

TEST(VisitFile, OldOnesAndTooManyGo) {
  const VisitFolder folder;
  VisitFile file = open_visits(folder.file());
  for (std::int64_t i = 0; i < 200; ++i) {
    VisitSheet sheet = plain_sheet(1000 + i);
    sheet.mistakes[0].subject = std::string(2000, 'x');
    ASSERT_TRUE(file.put(sheet, true));
  }
  EXPECT_EQ(file.keep_within(1050, 10'000'000).value(), 50U);
  EXPECT_EQ(file.keep_within(0, 10'000'000).value(), 0U);
  EXPECT_GT(file.keep_within(0, 200'000).value(), 0U);
  const auto left = file.sheets({}).value();
  // Sheets lie in the order of their random numbers, so that pages are now more and now less full: 30 to 45 fit. At worst a sheet of 2 kB
  // has two pages of 4 kB for itself, and the last round takes one in twenty too many.
  EXPECT_GT(left.size(), 15U);
  EXPECT_EQ(left.back().minute, 1199) << "the newest stay";
  EXPECT_LE(fs::file_size(folder.file()), 200'000U);
}

TEST(VisitFile, WhatRanIsCutOffAndTheNewIsGivenBack) {
  const VisitFolder folder;
  VisitFile file = open_visits(folder.file());
  std::vector<VisitSheet> sheets{plain_sheet(100), plain_sheet(200), plain_sheet(300)};
  sheets[0].ending = sheets[1].ending = VisitEnding::running;
  for (const VisitSheet& sheet : sheets)
    ASSERT_TRUE(file.put(sheet, true));
  const auto cut = file.cut_running(150).value();
  ASSERT_THAT(cut, SizeIs(1));
  EXPECT_EQ(cut[0].number, sheets[1].number);
  EXPECT_EQ(file.sheets({}).value()[0].ending, VisitEnding::cut);
  EXPECT_EQ(file.sheets({}).value()[2].ending, VisitEnding::done);
}

TEST(VisitFile, TwoHaveItOpenAtOnce) {
  const VisitFolder folder;
  VisitFile server = open_visits(folder.file());
  const VisitFile reader = open_visits(folder.file(), Access::read);
  ASSERT_TRUE(server.put(plain_sheet(), true));
  EXPECT_EQ(reader.count().value(), 1U);
}

TEST(VisitFile, WhatIsNoneIsSaidWithARemedy) {
  const VisitFolder folder;
  const auto error = [&](Trouble wanted, Access access = Access::read) {
    Trouble trouble = Trouble::none;
    const auto opened = VisitFile::open(folder.file(), access, &trouble);
    EXPECT_FALSE(opened);
    EXPECT_EQ(trouble, wanted);
    return opened ? std::string() : opened.error().to_string();
  };
  EXPECT_THAT(error(Trouble::missing), HasSubstr("--records"));
  EXPECT_THAT(error(Trouble::missing, Access::write), HasSubstr("no visits' sheets"));
  fs::create_directory(folder.file());
  EXPECT_THAT(error(Trouble::foreign, Access::write_new), HasSubstr("a folder or a device"));
  fs::remove(folder.file());
  std::ofstream(folder.file()) << "This is a letter to my aunt, and no database at all, however long it may be.\n"
                               << std::string(1000, '.');
  EXPECT_THAT(error(Trouble::damaged, Access::write_new), HasSubstr("SQLite does not know the file"));
}

/// Overwrites bytes of a file that nobody has open.
void overwrite(const fs::path& file, std::streamoff at, const std::string& bytes) {
  std::fstream out(file, std::ios::binary | std::ios::in | std::ios::out);
  out.seekp(at);
  out << bytes;
}

TEST(VisitFile, AnotherProgramsAndANewerOnesAreNotTouched) {
  const VisitFolder folder;
  (void)open_visits(folder.file());
  overwrite(folder.file(), 60, std::string("\0\0\0\x09", 4));  // user_version of the file's head
  Trouble trouble = Trouble::none;
  EXPECT_THAT(VisitFile::open(folder.file(), Access::write_new, &trouble).error().to_string(),
              HasSubstr("newer Mechane"));
  EXPECT_EQ(trouble, Trouble::foreign);
  overwrite(folder.file(), 68, "ABCD");  // application_id
  EXPECT_THAT(VisitFile::open(folder.file(), Access::write_new, &trouble).error().to_string(),
              HasSubstr("another program"));
  EXPECT_EQ(trouble, Trouble::foreign);
}

TEST(VisitFile, ADamagedOneIsSaidAndSetAside) {
  const VisitFolder folder;
  {
    VisitFile file = open_visits(folder.file());
    for (int i = 0; i < 100; ++i)
      ASSERT_TRUE(file.put(plain_sheet(), true));
  }
  overwrite(folder.file(), 4096, std::string(20'000, '\x7f'));
  Trouble trouble = Trouble::none;
  EXPECT_THAT(VisitFile::open(folder.file(), Access::read, &trouble).error().to_string(), HasSubstr("damaged"));
  EXPECT_EQ(trouble, Trouble::damaged);
  const auto first = set_aside(folder.file());
  ASSERT_TRUE(first) << first.error().to_string();
  EXPECT_TRUE(fs::exists(*first));
  EXPECT_FALSE(fs::exists(folder.file()));
  std::ofstream(folder.file()) << "again";
  EXPECT_NE(set_aside(folder.file()).value(), *first) << "the older one is kept";
}

TEST(VisitFile, NumbersAreRandomAndDatesAreRead) {
  std::set<std::string> numbers;
  for (int i = 0; i < 1000; ++i)
    numbers.insert(new_visit_number());
  EXPECT_THAT(numbers, SizeIs(1000));
  EXPECT_EQ(numbers.begin()->size(), 14U);
  EXPECT_EQ(minute_text(29'922'357), "2026-11-22 09:57");
  EXPECT_EQ(minute_of_text("2026-11-22 09:57").value(), 29'922'357);
  EXPECT_EQ(minute_of_text("2026-11-22T09:57").value(), 29'922'357);
  EXPECT_EQ(minute_of_text("2026-11-22").value(), 29'922'357 - 9 * 60 - 57);
  for (const char* text : {"", "yesterday", "2026-11-31", "2026-13-01", "2026-1-1", "22.11.2026", "2026-11-22 25:00",
                           "2026-11-22 9:57", "-026-11-22", "1969-01-01"})
    EXPECT_THAT(minute_of_text(text).error().remedy, HasSubstr("2026-11-22")) << text;
}

RC_GTEST_PROP(VisitFile, ADateThatIsWrittenIsReadAgain, ()) {
  const std::int64_t minute = *rc::gen::inRange<std::int64_t>(0, 100'000'000);
  RC_ASSERT(minute_of_text(minute_text(minute)).value() == minute);
}

}  // namespace
}  // namespace mechane::visits
