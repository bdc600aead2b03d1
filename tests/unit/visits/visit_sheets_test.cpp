#include "server/visits/visit_sheets.hpp"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <functional>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/unit/visits/visit_sheet_samples.hpp"

namespace mechane::visits {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::SizeIs;

class VisitSheetsTest : public testing::Test {
 public:
  ~VisitSheetsTest() override { fs::remove_all(folder_); }

 protected:
  VisitSheetsTest()
      : folder_(fs::path(testing::TempDir()) / ("visits-" + std::to_string(getpid()) + "-" +
                                                testing::UnitTest::GetInstance()->current_test_info()->name())) {
    config_.file = folder_ / kVisitFileName;
    config_.retry_after = 5ms;
    config_.keep_days = 0;
  }

  [[nodiscard]] std::unique_ptr<VisitSheets> make() const {
    auto made = VisitSheets::create(config_);
    EXPECT_TRUE(made) << (made ? "" : made.error().to_string());
    return std::move(*made);
  }
  [[nodiscard]] std::vector<VisitSheet> on_disk() const {
    const auto file = VisitFile::open(config_.file, VisitFile::Access::read);
    EXPECT_TRUE(file) << file.error().to_string();
    return file ? file->sheets({}).value() : std::vector<VisitSheet>{};
  }
  [[nodiscard]] std::size_t set_aside_files() const {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(folder_))
      count += entry.path().filename().string().find("damaged-") != std::string::npos ? 1 : 0;
    return count;
  }
  static bool waits_for(const std::function<bool()>& condition) {
    const auto deadline = std::chrono::steady_clock::now() + 20s;
    while (!condition()) {
      if (std::chrono::steady_clock::now() > deadline) return false;
      std::this_thread::yield();
    }
    return true;
  }

  fs::path folder_;
  VisitSheetsConfig config_;
};

TEST_F(VisitSheetsTest, ASheetIsWrittenAndItsNewestStateStays) {
  VisitSheet sheet = plain_sheet();
  {
    const auto sheets = make();
    sheet.ending = VisitEnding::running;
    sheets->put(sheet);
    ASSERT_TRUE(waits_for([&] { return sheets->status().written >= 1; }));
    sheet.ending = VisitEnding::done;
    sheets->put(sheet);
  }
  EXPECT_EQ(on_disk(), std::vector{sheet});
}

TEST_F(VisitSheetsTest, WhatWasWrittenIsThereAfterAKill) {
  const VisitSheet sheet = plain_sheet();
  const pid_t child = fork();
  if (child == 0) {
    const auto sheets = make();
    sheets->put(sheet);
    const bool written = waits_for([&] { return sheets->status().written == 1; });
    if (written) (void)raise(SIGKILL);
    _exit(1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(on_disk(), std::vector{sheet});
}

TEST_F(VisitSheetsTest, WhatAStopCutOffIsTakenUpOnce) {
  VisitSheet sheet = plain_sheet(minute_now());
  sheet.ending = VisitEnding::running;
  make()->put(sheet);
  const auto again = make();
  EXPECT_FALSE(again->take_unfinished("kiosk-2", "hash"));
  EXPECT_FALSE(again->take_unfinished("kiosk-1", "other hash"));
  auto taken = again->take_unfinished("kiosk-1", "hash");
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->number, sheet.number);
  EXPECT_EQ(taken->ending, VisitEnding::cut);
  EXPECT_FALSE(again->take_unfinished("kiosk-1", "hash"));
  taken->ending = VisitEnding::done;
  again->put(*taken);
  ASSERT_TRUE(waits_for([&] { return again->status().written == 1; }));
  ASSERT_THAT(on_disk(), SizeIs(1));
  EXPECT_EQ(on_disk()[0].ending, VisitEnding::done);
}

TEST_F(VisitSheetsTest, AFullDiskCostsNothingButTime) {
  const auto sheets = make();
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{1024, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const VisitSheet sheet = plain_sheet();
  sheets->put(sheet);
  const bool told = waits_for([&] { return !sheets->status().ok; });
  setrlimit(RLIMIT_FSIZE, &before);
  ASSERT_TRUE(told);
  ASSERT_TRUE(waits_for([&] { return sheets->status().ok; }));
  EXPECT_EQ(on_disk(), std::vector{sheet});
  EXPECT_EQ(sheets->status().lost, 0U);
}

TEST_F(VisitSheetsTest, AFolderThatCannotBeMadeStopsNobodyAndTheQueueIsBounded) {
  fs::create_directories(folder_.parent_path());
  std::ofstream(folder_) << "a file where the folder should be";
  config_.queue = 3;
  const auto sheets = make();
  EXPECT_FALSE(sheets->status().ok);
  for (int i = 0; i < 10; ++i)
    sheets->put(plain_sheet(100 + i));
  ASSERT_TRUE(waits_for([&] { return sheets->status().lost == 7; })) << sheets->status().lost;
  fs::remove(folder_);
  ASSERT_TRUE(waits_for([&] { return sheets->status().ok; }));
  EXPECT_THAT(on_disk(), SizeIs(3));
  EXPECT_EQ(on_disk().back().minute, 109) << "the newest";
}

TEST_F(VisitSheetsTest, ADamagedFileIsSetAsideAtTheStart) {
  fs::create_directories(folder_);
  std::ofstream(config_.file) << std::string(5000, 'x');
  const VisitSheet sheet = plain_sheet();
  make()->put(sheet);
  EXPECT_EQ(on_disk(), std::vector{sheet});
  EXPECT_EQ(set_aside_files(), 1U);
}

TEST_F(VisitSheetsTest, AFileThatIsDamagedWhileTheServerRunsIsSetAside) {
  fs::create_directories(folder_);
  {
    auto file = VisitFile::open(config_.file, VisitFile::Access::write_new);
    ASSERT_TRUE(file);
    for (int i = 0; i < 60; ++i) {  // more than SQLite keeps in memory
      VisitSheet large = plain_sheet();
      large.mistakes[0].subject = std::string(100'000, 'x');
      ASSERT_TRUE(file->put(large, true));
    }
  }
  const auto sheets = make();
  {
    std::fstream out(config_.file, std::ios::binary | std::ios::in | std::ios::out);
    out.seekp(4096);
    out << std::string(fs::file_size(config_.file) - 4096, '\x7f');
  }
  const VisitSheet sheet = plain_sheet();
  sheets->put(sheet);
  ASSERT_TRUE(waits_for([&] { return sheets->status().written == 1 && sheets->status().ok; }));
  EXPECT_EQ(on_disk(), std::vector{sheet});
  EXPECT_GE(set_aside_files(), 1U);
}

TEST_F(VisitSheetsTest, AnotherProgramsFileIsLeftAlone) {
  fs::create_directories(folder_);
  fs::create_directory(config_.file);
  {
    const auto sheets = make();
    EXPECT_THAT(sheets->status().problem, HasSubstr("not visits' sheets"));
    sheets->put(plain_sheet());
  }
  EXPECT_TRUE(fs::is_directory(config_.file));
  EXPECT_EQ(set_aside_files(), 0U);
}

TEST_F(VisitSheetsTest, AFileThatIsTakenAwayIsMadeAnew) {
  const auto sheets = make();
  VisitSheet sheet = plain_sheet();
  sheets->put(sheet);
  ASSERT_TRUE(waits_for([&] { return sheets->status().written == 1; }));
  fs::rename(config_.file, folder_ / "for-the-curator.db");
  for (const char* beside : {"-wal", "-shm"})
    fs::remove(config_.file.string() + beside);
  sheet.hands = 3;
  sheets->put(sheet);
  ASSERT_TRUE(waits_for([&] { return sheets->status().written == 2; }));
  EXPECT_EQ(on_disk(), std::vector{sheet});
}

TEST_F(VisitSheetsTest, OldSheetsGoByThemselves) {
  config_.keep_days = 30;
  const VisitSheet kept = plain_sheet(minute_now() - 29 * 24 * 60);
  const VisitSheet fresh = plain_sheet(minute_now());
  {
    const auto sheets = make();
    sheets->put(plain_sheet(minute_now() - 31 * 24 * 60));
    sheets->put(kept);
  }
  const auto sheets = make();
  sheets->put(fresh);
  EXPECT_TRUE(waits_for([&] { return std::ranges::is_permutation(on_disk(), std::vector{kept, fresh}); }));
}

}  // namespace
}  // namespace mechane::visits
