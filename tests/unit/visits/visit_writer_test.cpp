#include "server/visits/visit_writer.hpp"

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

#include "tests/unit/visits/visit_record_samples.hpp"

namespace mechane::visits {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::SizeIs;

class VisitWriterTest : public testing::Test {
 public:
  ~VisitWriterTest() override { fs::remove_all(folder_); }

 protected:
  VisitWriterTest()
      : folder_(fs::path(testing::TempDir()) / ("visits-" + std::to_string(getpid()) + "-" +
                                                testing::UnitTest::GetInstance()->current_test_info()->name())) {
    config_.file = folder_ / kVisitFileName;
    config_.retry_after = 5ms;
    config_.keep_days = 0;
  }

  [[nodiscard]] std::unique_ptr<VisitWriter> make() const {
    auto made = VisitWriter::create(config_);
    EXPECT_TRUE(made) << (made ? "" : made.error().to_string());
    return std::move(*made);
  }
  [[nodiscard]] std::vector<VisitRecord> on_disk() const {
    const auto file = VisitFile::open(config_.file, VisitFile::Access::read);
    EXPECT_TRUE(file) << file.error().to_string();
    return file ? file->records({}).value() : std::vector<VisitRecord>{};
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
  VisitWriterConfig config_;
};

TEST_F(VisitWriterTest, ARecordIsWrittenAndItsNewestStateStays) {
  VisitRecord record = plain_record();
  {
    const auto writer = make();
    record.ending = VisitEnding::running;
    writer->put(record);
    ASSERT_TRUE(waits_for([&] { return writer->status().written >= 1; }));
    record.ending = VisitEnding::done;
    writer->put(record);
  }
  EXPECT_EQ(on_disk(), std::vector{record});
}

TEST_F(VisitWriterTest, WhatWasWrittenIsThereAfterAKill) {
  const VisitRecord record = plain_record();
  const pid_t child = fork();
  if (child == 0) {
    const auto writer = make();
    writer->put(record);
    const bool written = waits_for([&] { return writer->status().written == 1; });
    if (written) (void)raise(SIGKILL);
    _exit(1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(on_disk(), std::vector{record});
}

TEST_F(VisitWriterTest, WhatAStopCutOffIsTakenUpOnce) {
  VisitRecord record = plain_record(minute_now());
  record.ending = VisitEnding::running;
  make()->put(record);
  const auto again = make();
  EXPECT_FALSE(again->take_unfinished("kiosk-2", "hash"));
  EXPECT_FALSE(again->take_unfinished("kiosk-1", "other hash"));
  auto taken = again->take_unfinished("kiosk-1", "hash");
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->number, record.number);
  EXPECT_EQ(taken->ending, VisitEnding::cut);
  EXPECT_FALSE(again->take_unfinished("kiosk-1", "hash"));
  taken->ending = VisitEnding::done;
  again->put(*taken);
  ASSERT_TRUE(waits_for([&] { return again->status().written == 1; }));
  ASSERT_THAT(on_disk(), SizeIs(1));
  EXPECT_EQ(on_disk()[0].ending, VisitEnding::done);
}

TEST_F(VisitWriterTest, AFullDiskCostsNothingButTime) {
  const auto writer = make();
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{1024, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const VisitRecord record = plain_record();
  writer->put(record);
  const bool told = waits_for([&] { return !writer->status().ok; });
  setrlimit(RLIMIT_FSIZE, &before);
  ASSERT_TRUE(told);
  ASSERT_TRUE(waits_for([&] { return writer->status().ok; }));
  EXPECT_EQ(on_disk(), std::vector{record});
  EXPECT_EQ(writer->status().lost, 0U);
}

TEST_F(VisitWriterTest, AFolderThatCannotBeMadeStopsNobodyAndTheQueueIsBounded) {
  fs::create_directories(folder_.parent_path());
  std::ofstream(folder_) << "a file where the folder should be";
  config_.queue = 3;
  const auto writer = make();
  EXPECT_FALSE(writer->status().ok);
  for (int i = 0; i < 10; ++i)
    writer->put(plain_record(100 + i));
  ASSERT_TRUE(waits_for([&] { return writer->status().lost == 7; })) << writer->status().lost;
  fs::remove(folder_);
  ASSERT_TRUE(waits_for([&] { return writer->status().ok; }));
  EXPECT_THAT(on_disk(), SizeIs(3));
  EXPECT_EQ(on_disk().back().minute, 109) << "the newest";
}

TEST_F(VisitWriterTest, ADamagedFileIsSetAsideAtTheStart) {
  fs::create_directories(folder_);
  std::ofstream(config_.file) << std::string(5000, 'x');
  const VisitRecord record = plain_record();
  make()->put(record);
  EXPECT_EQ(on_disk(), std::vector{record});
  EXPECT_EQ(set_aside_files(), 1U);
}

TEST_F(VisitWriterTest, AFileThatIsDamagedWhileTheServerRunsIsSetAside) {
  fs::create_directories(folder_);
  {
    auto file = VisitFile::open(config_.file, VisitFile::Access::write_new);
    ASSERT_TRUE(file);
    for (int i = 0; i < 60; ++i) {  // more than SQLite keeps in memory
      VisitRecord large = plain_record();
      large.mistakes[0].subject = std::string(100'000, 'x');
      ASSERT_TRUE(file->put(large, true));
    }
  }
  const auto writer = make();
  {
    std::fstream out(config_.file, std::ios::binary | std::ios::in | std::ios::out);
    out.seekp(4096);
    out << std::string(fs::file_size(config_.file) - 4096, '\x7f');
  }
  const VisitRecord record = plain_record();
  writer->put(record);
  ASSERT_TRUE(waits_for([&] { return writer->status().written == 1 && writer->status().ok; }));
  EXPECT_EQ(on_disk(), std::vector{record});
  EXPECT_GE(set_aside_files(), 1U);
}

TEST_F(VisitWriterTest, AnotherProgramsFileIsLeftAlone) {
  fs::create_directories(folder_);
  fs::create_directory(config_.file);
  {
    const auto writer = make();
    EXPECT_FALSE(writer->status().ok);
    EXPECT_THAT(writer->status().problem, HasSubstr(config_.file.string()));
    writer->put(plain_record());
  }
  EXPECT_TRUE(fs::is_directory(config_.file));
  EXPECT_EQ(set_aside_files(), 0U);
}

TEST_F(VisitWriterTest, AFileThatIsTakenAwayIsMadeAnew) {
  const auto writer = make();
  VisitRecord record = plain_record();
  writer->put(record);
  ASSERT_TRUE(waits_for([&] { return writer->status().written == 1; }));
  fs::rename(config_.file, folder_ / "for-the-curator.db");
  for (const char* beside : {"-wal", "-shm"})
    fs::remove(config_.file.string() + beside);
  record.hands = 3;
  writer->put(record);
  ASSERT_TRUE(waits_for([&] { return writer->status().written == 2; }));
  EXPECT_EQ(on_disk(), std::vector{record});
}

TEST_F(VisitWriterTest, OldRecordsGoByThemselves) {
  config_.keep_days = 30;
  const VisitRecord kept = plain_record(minute_now() - 29 * 24 * 60);
  const VisitRecord fresh = plain_record(minute_now());
  {
    const auto writer = make();
    writer->put(plain_record(minute_now() - 31 * 24 * 60));
    writer->put(kept);
  }
  const auto writer = make();
  writer->put(fresh);
  EXPECT_TRUE(waits_for([&] { return std::ranges::is_permutation(on_disk(), std::vector{kept, fresh}); }));
}

}  // namespace
}  // namespace mechane::visits
