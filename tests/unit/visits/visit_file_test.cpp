#include "server/visits/visit_file.hpp"

#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>
#include <unistd.h>

#include "tests/support/error_like.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/visits/visit_record_samples.hpp"

namespace mechane::visits {
namespace {

namespace fs = std::filesystem;
using test::is_error;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using Access = VisitFile::Access;

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
  const VisitRecord first = any_record();
  VisitRecord second = any_record();
  {
    VisitFile file = open_visits(folder.file());
    RC_ASSERT(file.put(first, true).value());
    RC_ASSERT(file.put(second, true).value());
    const std::string number = second.number;
    second = any_record();
    second.number = number;
    RC_ASSERT(file.put(second, false).value());
  }
  const VisitFile file = open_visits(folder.file(), Access::read);
  RC_ASSERT(file.records({.number = first.number}).value() == std::vector{first});
  RC_ASSERT(file.records({.number = second.number}).value() == std::vector{second});
  RC_ASSERT(file.count().value() == 2U);
}

TEST(VisitFile, VisitsAreChosen) {
  const VisitFolder folder;
  VisitFile file = open_visits(folder.file());
  std::vector<VisitRecord> records{plain_record(100), plain_record(200), plain_record(300)};
  records[1].kiosk = "kiosk-2";
  records[2].scenario = "other";
  for (const VisitRecord& record : records)
    ASSERT_TRUE(file.put(record, true));
  EXPECT_EQ(file.records({}).value(), records);
  EXPECT_EQ(file.records({.since = 200}).value(), (std::vector{records[1], records[2]}));
  EXPECT_EQ(file.records({.before = 200}).value(), std::vector{records[0]});
  EXPECT_EQ(file.records({.scenario = "other"}).value(), std::vector{records[2]});
  EXPECT_EQ(file.records({.kiosk = "kiosk-2"}).value(), std::vector{records[1]});
  EXPECT_THAT(file.records({.scenario = "x' OR 1 --"}).value(), IsEmpty());
}

TEST(VisitFile, ANumberIsTypedAsAPersonWould) {
  const VisitFolder folder;
  VisitFile file = open_visits(folder.file());
  VisitRecord record = plain_record();
  record.number = "k7m2-9qxd-4tz0";
  ASSERT_TRUE(file.put(record, true));
  for (const char* typed : {"k7m2", "k7m2-9", "K7M29QXD4TZ0", "k7m2 9qxd 4tz0", "k7m29"})
    EXPECT_THAT(file.records({.number = typed}).value(), SizeIs(1)) << typed;
  EXPECT_THAT(file.records({.number = "9qxd"}).value(), IsEmpty());
  EXPECT_THAT(file.records({.number = "%"}).value(), IsEmpty());
}

TEST(VisitFile, RemarksAreTheObserversAndStay) {
  const VisitFolder folder;
  VisitFile server = open_visits(folder.file());
  VisitRecord record = plain_record();
  ASSERT_TRUE(server.put(record, true));
  {
    VisitFile observer = open_visits(folder.file(), Access::write);
    EXPECT_EQ(observer.remark(record.number.substr(0, 6), {500, "asked twice\nthen laughed"}).value(), record.number);
    ASSERT_TRUE(observer.remark(record.number, {501, std::string(kLongestRemark, 'x')}));
    EXPECT_THAT(observer.remark(record.number, {501, std::string(kLongestRemark + 1, 'x')}).error(),
                is_error(ErrorCode::too_large, 0, {record.number, "2001 bytes", "1 to 2000"}));
    for (const char* text : {"", "\x1b[2J"})
      EXPECT_THAT(observer.remark(record.number, {501, text}).error(),
                  is_error(ErrorCode::invalid_value, 0, {record.number, "control characters"}));
    EXPECT_THAT(observer.remark("k7m", {501, "x"}).error(),
                is_error(ErrorCode::invalid_value, 0, {"k7m", "first 4 letters"}));
    EXPECT_THAT(observer.remark("zzzz-zzzz-zzzz", {501, "x"}).error(),
                is_error(ErrorCode::unknown_name, 0, {"zzzz-zzzz-zzzz"}));
  }
  record.hands = 2;
  ASSERT_TRUE(server.put(record, false).value());
  const auto records = server.records({}).value();
  ASSERT_THAT(records, SizeIs(1));
  EXPECT_EQ(records[0].hands, 2U);
  ASSERT_THAT(records[0].remarks, SizeIs(2));
  EXPECT_EQ(records[0].remarks[0], (RecordedRemark{500, "asked twice\nthen laughed"}));
}

TEST(VisitFile, WhatIsForgottenIsGoneFromTheDiskAndStaysForgotten) {
  const VisitFolder folder;
  VisitFile server = open_visits(folder.file());
  VisitRecord record = plain_record();
  record.mistakes[0].subject = "a-word-to-be-found";
  ASSERT_TRUE(server.put(record, true));
  ASSERT_TRUE(server.put(plain_record(), true));
  EXPECT_THAT(file_bytes(folder.file().string() + "-wal"), HasSubstr("a-word-to-be-found"));
  EXPECT_THAT(server.forget({}).error(), is_error(ErrorCode::missing, 0))
      << "an empty choice must not delete everything";
  EXPECT_EQ(open_visits(folder.file(), Access::write).forget({.number = record.number}).value(), 1U);
  EXPECT_FALSE(server.put(record, false).value()) << "it was still running, and nobody wants it";
  EXPECT_EQ(server.count().value(), 1U);
  for (const char* beside : {"", "-wal", "-shm"})
    EXPECT_THAT(file_bytes(folder.file().string() + beside), Not(HasSubstr("a-word-to-be-found"))) << beside;
}

TEST(VisitFile, OldOnesAndTooManyGo) {
  const VisitFolder folder;
  VisitFile file = open_visits(folder.file());
  for (std::int64_t i = 0; i < 200; ++i) {
    VisitRecord record = plain_record(1000 + i);
    record.mistakes[0].subject = std::string(2000, 'x');
    ASSERT_TRUE(file.put(record, true));
  }
  EXPECT_EQ(file.keep_within(1050, 10'000'000).value(), 50U);
  EXPECT_EQ(file.keep_within(0, 10'000'000).value(), 0U);
  EXPECT_GT(file.keep_within(0, 200'000).value(), 0U);
  const auto left = file.records({}).value();
  // Records lie in the order of their random numbers, so that pages are more or less full: 30 to 45 records fit. At worst a record of 2 kB
  // has two pages of 4 kB for itself, and the last round deletes one in twenty too many.
  EXPECT_GT(left.size(), 15U);
  EXPECT_EQ(left.back().minute, 1199) << "the newest stay";
  EXPECT_LE(fs::file_size(folder.file()), 200'000U);
}

TEST(VisitFile, WhatRanIsCutOffAndTheNewIsGivenBack) {
  const VisitFolder folder;
  VisitFile file = open_visits(folder.file());
  std::vector<VisitRecord> records{plain_record(100), plain_record(200), plain_record(300)};
  records[0].ending = records[1].ending = VisitEnding::running;
  for (const VisitRecord& record : records)
    ASSERT_TRUE(file.put(record, true));
  const auto cut = file.cut_running(150).value();
  ASSERT_THAT(cut, SizeIs(1));
  EXPECT_EQ(cut[0].number, records[1].number);
  EXPECT_EQ(file.records({}).value()[0].ending, VisitEnding::cut);
  EXPECT_EQ(file.records({}).value()[2].ending, VisitEnding::done);
}

TEST(VisitFile, TwoHaveItOpenAtOnce) {
  const VisitFolder folder;
  VisitFile server = open_visits(folder.file());
  const VisitFile reader = open_visits(folder.file(), Access::read);
  ASSERT_TRUE(server.put(plain_record(), true));
  EXPECT_EQ(reader.count().value(), 1U);
}

/// Empty where it opens after all.
Error error_of(const fs::path& file, Access access) {
  const auto opened = VisitFile::open(file, access);
  return opened ? Error{} : opened.error();
}

TEST(VisitFile, AFileThatIsNotOneIsAnErrorWithARemedy) {
  const VisitFolder folder;
  for (const Access access : {Access::read, Access::write})
    EXPECT_THAT(error_of(folder.file(), access),
                is_error(ErrorCode::not_found, 0, {folder.file().string(), "--records", "--file"}));
  fs::create_directory(folder.file());
  EXPECT_THAT(error_of(folder.file(), Access::write_new),
              is_error(ErrorCode::invalid_value, 0, {folder.file().string(), "--file"}));
  fs::remove(folder.file());
  std::ofstream(folder.file()) << "This is a letter to my aunt, and no database at all, however long it may be.\n"
                               << std::string(1000, '.');
  EXPECT_THAT(error_of(folder.file(), Access::write_new),
              is_error(ErrorCode::damaged, 0, {folder.file().string(), "--file"}));
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
  EXPECT_THAT(error_of(folder.file(), Access::write_new), is_error(ErrorCode::wrong_version, 0, {"format 9"}));
  overwrite(folder.file(), 68, "ABCD");  // application_id
  EXPECT_THAT(error_of(folder.file(), Access::write_new),
              is_error(ErrorCode::invalid_value, 0, {"another program", "--file"}));
}

TEST(VisitFile, ADamagedOneIsSaidAndSetAside) {
  const VisitFolder folder;
  {
    VisitFile file = open_visits(folder.file());
    for (int i = 0; i < 100; ++i)
      ASSERT_TRUE(file.put(plain_record(), true));
  }
  overwrite(folder.file(), 4096, std::string(20'000, '\x7f'));
  EXPECT_THAT(error_of(folder.file(), Access::read),
              is_error(ErrorCode::damaged, 0, {folder.file().string(), "is damaged", ".recover"}));
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
    EXPECT_THAT(minute_of_text(text).error(), is_error(ErrorCode::invalid_value, 0, {text, "2026-11-22"})) << text;
}

RC_GTEST_PROP(VisitFile, ADateThatIsWrittenIsReadAgain, ()) {
  const std::int64_t minute = *rc::gen::inRange<std::int64_t>(0, 100'000'000);
  RC_ASSERT(minute_of_text(minute_text(minute)).value() == minute);
}

}  // namespace
}  // namespace mechane::visits
