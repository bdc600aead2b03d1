#include "server/record/recorder.hpp"

#include <csignal>
#include <fstream>
#include <functional>
#include <future>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "server/record/journal_reader.hpp"
#include "server/record/retention.hpp"
#include "server/record/snapshot_file.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/unit/record/journal_generators.hpp"

namespace mechane::record {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class RecorderTest : public testing::Test {
 public:
  ~RecorderTest() override { fs::remove_all(folder_); }

 protected:
  RecorderTest()
      : folder_(fs::path(testing::TempDir()) / ("recorder-" + std::to_string(getpid()) + "-" +
                                                testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
    config_.folder = folder_;
    config_.drain_period = 2ms;
    config_.retry_after = 0ms;
  }

  [[nodiscard]] std::unique_ptr<Recorder> make() const {
    auto made = Recorder::create(config_);
    EXPECT_TRUE(made.has_value()) << (made ? "" : made.error().to_string());
    return std::move(*made);
  }

  fs::path folder_;
  RecorderConfig config_;
};

WorldTick hand_tick(std::uint64_t n) {
  WorldTick tick;
  tick.tick = n;
  state::UserInput& user = tick.inputs.users[0];
  user = {.present = true, .fresh = true, .age = Duration(static_cast<std::int64_t>(n)), .sample = {}};
  user.sample.session = 5;
  user.sample.sequence = n;
  user.sample.X_WH.p.x() = 1e-3 * static_cast<double>(n);
  if (n % kHashInterval == 0) tick.hash = n * 31;
  return tick;
}

// Waits until another thread has made the condition true; false after a deadline.
::testing::AssertionResult comes_true(const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + 20s;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return ::testing::AssertionFailure() << "waited 20 s in vain";
    std::this_thread::yield();
  }
  return ::testing::AssertionSuccess();
}

void expect_whole(const fs::path& path, std::uint64_t ticks) {
  auto reader = JournalReader::open_file(path);
  ASSERT_TRUE(reader.has_value()) << reader.error().to_string();
  std::uint64_t n = 0;
  for (JournalTick tick; reader->next(tick); ++n)
    ASSERT_TRUE(same(hand_tick(n), tick)) << n;
  EXPECT_EQ(n, ticks);
  EXPECT_EQ(reader->end().kind, JournalEnd::Kind::closed) << reader->end().message;
  EXPECT_EQ(reader->end().hash, std::optional<std::uint64_t>(99));
  EXPECT_FALSE(reader->end().first_lost);
}

TEST_F(RecorderTest, WritesTwoWorldsAtOnceInFull) {
  auto recorder = make();
  WorldRecorder a = recorder->open(a_header(), 1024);
  WorldRecorder b = recorder->open(a_header(), 1024);  // the same world in the same millisecond: another file
  ASSERT_NE(a.journal_path(), b.journal_path());
  const fs::path a_path = a.journal_path(), b_path = b.journal_path();
  for (std::uint64_t n = 0; n < 5000; ++n) {
    a.push(hand_tick(n).record());
    b.push(hand_tick(n).record());
  }
  a.close(99);
  b.close(99);
  expect_whole(a_path, 5000);
  expect_whole(b_path, 5000);
  const RecorderStatus status = recorder->status();
  EXPECT_TRUE(status.records_ok) << status.problem;
  EXPECT_EQ(status.ticks_lost, 0u);
  EXPECT_EQ(status.open_journals, 0u);
  EXPECT_EQ(status.bytes_written, fs::file_size(a_path) + fs::file_size(b_path));
}

TEST_F(RecorderTest, PushAndSnapshotAllocateNothing) {
  MECHANE_NOT_SANITIZED("a sanitizer's malloc cannot be counted");
  auto recorder = make();
  WorldRecorder world = recorder->open(a_header(), 1024);
  std::vector<WorldTick> ticks;
  for (std::uint64_t n = 0; n < 1000; ++n)
    ticks.push_back(hand_tick(n));
  const test::AllocationGuard guard;
  for (const WorldTick& tick : ticks) {
    world.push(tick.record());
    world.snapshot_buffer().assign(1024, std::byte{7});
    world.commit_snapshot(tick.tick);
  }
  EXPECT_EQ(guard.allocations(), 0u);
}

TEST_F(RecorderTest, ARingThatIsFullCostsTicksAndTheJournalSaysWhich) {
  config_.ring_bytes = 64u << 10;
  config_.drain_period = 1h;  // only the close empties the ring
  auto recorder = make();
  WorldRecorder world = recorder->open(a_header(), 1024);
  for (std::uint64_t n = 0; n < 5000; ++n)
    world.push(hand_tick(n).record());
  const std::uint64_t refused = world.refused();
  EXPECT_GT(refused, 0u);
  const fs::path path = world.journal_path();
  world.close(99);
  auto reader = JournalReader::open_file(path);
  ASSERT_TRUE(reader.has_value());
  std::uint64_t n = 0;
  for (JournalTick tick; reader->next(tick); ++n)
    ASSERT_TRUE(same(hand_tick(n), tick));
  EXPECT_EQ(n + refused, 5000u);
  EXPECT_EQ(reader->end().first_lost, std::optional<std::uint64_t>(n));
  EXPECT_EQ(reader->end().lost_ticks, refused);
  EXPECT_EQ(recorder->status().ticks_lost, refused);
}

TEST_F(RecorderTest, AWriterThatIsKilledLeavesAReadableJournal) {
  const pid_t child = fork();
  if (child == 0) {
    auto recorder = make();
    WorldRecorder world = recorder->open(a_header(), 1024);
    for (std::uint64_t n = 0; n < 3000; ++n)
      world.push(hand_tick(n).record());
    const bool written = static_cast<bool>(comes_true([&] { return recorder->status().bytes_written > 100'000; }));
    if (!written) _exit(1);
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  const auto files = [&] {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder_))
      found.push_back(entry.path());
    return found;
  }();
  ASSERT_EQ(files.size(), 1u);
  auto reader = JournalReader::open_file(files[0]);
  ASSERT_TRUE(reader.has_value()) << reader.error().to_string();
  std::uint64_t n = 0;
  for (JournalTick tick; reader->next(tick); ++n)
    ASSERT_TRUE(same(hand_tick(n), tick));
  EXPECT_GT(n, 500u);
  EXPECT_EQ(reader->end().kind, JournalEnd::Kind::cut_off);
}

// Files of this process may not grow over `bytes`: to write(), this looks like a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
};

TEST_F(RecorderTest, AFullDiskIsSurvivedSaidAndMarked) {
  auto recorder = make();
  WorldRecorder world = recorder->open(a_header(), 1024);
  const fs::path path = world.journal_path();
  std::uint64_t n = 0;
  {
    const FileSizeLimit full(40'000);
    for (; n < 2000; ++n)
      world.push(hand_tick(n).record());
    RecorderStatus told;  // a small write may fit afterwards, and all seems well again
    ASSERT_TRUE(comes_true([&] { return told = recorder->status(), !told.records_ok; }));
    EXPECT_THAT(told.problem, testing::HasSubstr("room"));
    for (; n < 4000; ++n)
      world.push(hand_tick(n).record());
    EXPECT_LE(fs::file_size(path), 40'000u);
    ASSERT_TRUE(comes_true([&] { return recorder->status().ticks_lost > 1000; }));
  }
  for (; n < 4500; ++n)
    world.push(hand_tick(n).record());
  ASSERT_TRUE(comes_true([&] { return recorder->status().records_ok; }));
  world.close(99);

  auto reader = JournalReader::open_file(path);
  ASSERT_TRUE(reader.has_value()) << reader.error().to_string();
  std::uint64_t read = 0;
  for (JournalTick tick; reader->next(tick); ++read) {
    ASSERT_TRUE(same(hand_tick(tick.tick), tick));
    EXPECT_EQ(tick.after_loss, reader->end().first_lost.has_value());
  }
  EXPECT_EQ(reader->end().kind, JournalEnd::Kind::closed) << reader->end().message;
  EXPECT_TRUE(reader->end().first_lost.has_value());
  EXPECT_EQ(read + reader->end().lost_ticks, 4500u);
  EXPECT_EQ(recorder->status().ticks_lost, reader->end().lost_ticks);
}

TEST_F(RecorderTest, ADiskThatIsFullFromTheStartStillGetsItsJournalLater) {
  auto recorder = make();
  std::optional<WorldRecorder> world;
  std::uint64_t n = 0;
  {
    const FileSizeLimit full(10);
    world.emplace(recorder->open(a_header(), 1024));
    for (; n < 10; ++n)
      world->push(hand_tick(n).record());
    ASSERT_TRUE(comes_true([&] { return recorder->status().ticks_lost == 10; }));
  }
  for (; n < 20; ++n)
    world->push(hand_tick(n).record());
  const fs::path path = world->journal_path();
  world->close();
  auto reader = JournalReader::open_file(path);
  ASSERT_TRUE(reader.has_value()) << reader.error().to_string();
  EXPECT_EQ(read_all(*reader).size(), 10u);
  EXPECT_EQ(reader->end().first_lost, std::optional<std::uint64_t>(0));
}

TEST_F(RecorderTest, TheNewestSnapshotIsOnTheDiskAndGoesWithTheVisit) {
  auto recorder = make();
  WorldRecorder world = recorder->open(a_header(), 64);
  world.snapshot_buffer().assign(3, std::byte{1});
  world.commit_snapshot(1000);
  world.snapshot_buffer().assign(5, std::byte{2});
  world.commit_snapshot(2000);
  ASSERT_TRUE(comes_true([&] { return recorder->status().snapshots_written > 0; }));
  const auto found = find_snapshots(folder_);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0], snapshot_path(folder_, "kiosk-3"));
  const auto file = read_snapshot_file(found[0]);
  ASSERT_TRUE(file.has_value()) << file.error().to_string();
  EXPECT_EQ(file->info.tick, 2000u);
  EXPECT_EQ(file->info.kiosk, "kiosk-3");
  EXPECT_EQ(file->info.scenario_hash, "00ff");
  EXPECT_EQ(file->state, std::vector<std::byte>(5, std::byte{2}));
  world.close(1, WorldRecorder::Snapshot::remove);
  EXPECT_TRUE(find_snapshots(folder_).empty());
}

TEST_F(RecorderTest, AnEarlierSnapshotStaysUntilTheNewOneIsOnTheDisk) {
  const fs::path earlier = snapshot_path(folder_, "world-1");
  ASSERT_TRUE(write_snapshot_file(earlier, {}, {}).has_value());
  auto recorder = make();
  WorldRecorder unwritten = recorder->open(a_header(), 64, {earlier});
  unwritten.push(hand_tick(0).record());
  unwritten.close(1);
  EXPECT_TRUE(fs::exists(earlier)) << "a world that took no snapshot of its own must leave the earlier one";

  WorldRecorder world = recorder->open(a_header(), 64, {earlier});
  world.snapshot_buffer().assign(3, std::byte{1});
  world.commit_snapshot(1000);
  const fs::path own = snapshot_path(folder_, "kiosk-3");
  bool never_without = true;
  ASSERT_TRUE(comes_true([&] {
    const bool was_there = fs::exists(earlier);
    never_without = never_without && (was_there || fs::exists(own));
    return !was_there;
  }));
  EXPECT_TRUE(never_without);

  ASSERT_TRUE(write_snapshot_file(earlier, {}, {}).has_value());
  recorder->open(a_header(), 64, {earlier}).close(1, WorldRecorder::Snapshot::remove);
  EXPECT_TRUE(find_snapshots(folder_).empty()) << "the visit is over";
  world.close(1);
}

TEST_F(RecorderTest, VisitorsWhoGoOnAreNeverWithoutASnapshot) {
  auto recorder = make();
  const auto open = [&](int i) {
    JournalHeader header = a_header();
    header.world_id = "world-" + std::to_string(i);
    WorldRecorder world = recorder->open(header, 64);
    world.snapshot_buffer().assign(3, std::byte{1});
    world.commit_snapshot(1);
    return world;
  };
  const auto path = [&](int i) { return snapshot_path(folder_, "world-" + std::to_string(i)); };
  WorldRecorder world = open(0);
  ASSERT_TRUE(comes_true([&] { return fs::exists(path(0)); }));
  for (int i = 1; i < 30; ++i) {
    auto seen = std::async(std::launch::async, [&, i] {
      return comes_true([&] { return !fs::exists(path(i - 1)); }) && fs::exists(path(i));
    });
    WorldRecorder next = open(i);
    world.close(1, WorldRecorder::Snapshot::remove);
    world = std::move(next);
    EXPECT_TRUE(seen.get()) << "world " << i;
  }
}

TEST_F(RecorderTest, ASnapshotIsTheOldOneOrTheNewOneWhole) {
  const fs::path path = snapshot_path(folder_, "../a world");
  EXPECT_EQ(path.parent_path(), folder_) << "no name leads out of the folder";
  SnapshotInfo info{"../a world", "k", "s", "h", 1, 2};
  ASSERT_TRUE(write_snapshot_file(path, info, std::vector<std::byte>(100, std::byte{1})).has_value());
  info.tick = 2;
  {
    const FileSizeLimit full(64);
    struct sigaction ignore {};
    struct sigaction before {};
    ignore.sa_handler = SIG_IGN;
    sigaction(SIGXFSZ, &ignore, &before);
    EXPECT_FALSE(write_snapshot_file(path, info, std::vector<std::byte>(100, std::byte{2})).has_value());
    sigaction(SIGXFSZ, &before, nullptr);
  }
  auto file = read_snapshot_file(path);
  ASSERT_TRUE(file.has_value()) << file.error().to_string();
  EXPECT_EQ(file->info.tick, 1u);
  EXPECT_EQ(file->state, std::vector<std::byte>(100, std::byte{1}));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "nothing is left beside it";

  std::fstream damage(path, std::ios::in | std::ios::out | std::ios::binary);
  damage.seekp(-1, std::ios::end);
  damage.put('x');
  damage.close();
  EXPECT_THAT(read_snapshot_file(path).error(), test::is_error(ErrorCode::damaged, 0, {path.string(), "is damaged"}));
  fs::resize_file(path, 5);
  EXPECT_THAT(read_snapshot_file(path).error(),
              test::is_error(ErrorCode::damaged, 0, {path.string(), "not a snapshot"}));
  fs::remove(path);
  EXPECT_THAT(read_snapshot_file(path).error(), test::is_error(ErrorCode::not_found, 0, {path.string()}));
}

TEST_F(RecorderTest, TheOldestClosedJournalsGoWhenThereAreTooMany) {
  const auto journal = [&](const std::string& name, std::chrono::hours age) {
    const fs::path path = folder_ / (name + ".journal");
    std::ofstream(path) << std::string(1000, 'x');
    fs::last_write_time(path, fs::file_time_type::clock::now() - age);
    return path;
  };
  const fs::path oldest = journal("c", 3h), older = journal("a", 2h), newer = journal("b", 1h);
  std::ofstream(folder_ / "notes.txt") << std::string(5000, 'x');

  config_.max_journal_bytes = 2600;
  auto recorder = make();
  WorldRecorder world = recorder->open(a_header(), 64);
  const fs::path open_path = world.journal_path();
  for (std::uint64_t n = 0; n < 4; ++n)
    world.push(hand_tick(n).record());
  ASSERT_TRUE(comes_true([&] { return recorder->status().journals_deleted > 0; }));
  EXPECT_FALSE(fs::exists(oldest));
  EXPECT_TRUE(fs::exists(newer));
  EXPECT_TRUE(fs::exists(folder_ / "notes.txt"));
  EXPECT_TRUE(comes_true([&] { return fs::exists(open_path) && fs::file_size(open_path) > 0; }));

  const auto kept = keep_within(folder_, 0);
  ASSERT_TRUE(kept.has_value());
  EXPECT_FALSE(fs::exists(newer) || fs::exists(older));
  EXPECT_TRUE(fs::exists(open_path)) << "a journal that is being written stays, whatever the limit";
}

TEST_F(RecorderTest, AFolderThatCannotBeIsAnError) {
  config_.folder = "/proc/no/such/folder";
  const auto made = Recorder::create(config_);
  ASSERT_FALSE(made.has_value());
  EXPECT_THAT(made.error(), test::is_error(ErrorCode::io_failure, 0, {"/proc/no/such/folder"}));
  config_.folder = folder_;
  config_.ring_bytes = 100'000;
  EXPECT_THAT(Recorder::create(config_).error(), test::is_error(ErrorCode::invalid_value, 0, {"100000", "65536"}));
}

}  // namespace
}  // namespace mechane::record
