#include "server/record/recorder.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <system_error>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "server/base/thread_setup.hpp"
#include "server/log/log.hpp"
#include "server/record/file.hpp"
#include "server/record/journal_channel.hpp"
#include "server/record/retention.hpp"
#include "server/record/snapshot_file.hpp"

namespace mechane::record {
namespace {

constexpr Duration kRetentionPeriod = std::chrono::seconds(10);

TimePoint now() {
  return TimePoint(std::chrono::steady_clock::now());
}

// "kiosk-3-20261121-174501-250.journal"; a number behind it where that name is taken.
template <class Taken>
std::filesystem::path journal_path_of(const std::filesystem::path& folder, const JournalHeader& header,
                                      Taken is_taken) {
  const auto seconds = static_cast<std::time_t>(header.start_wall_ns / 1'000'000'000);
  const std::string stem = fmt::format("{}-{:%Y%m%d-%H%M%S}-{:03}", file_name_of(header.world_id), fmt::gmtime(seconds),
                                       header.start_wall_ns / 1'000'000 % 1000);
  std::filesystem::path path = folder / (stem + kJournalExtension);
  for (int n = 2; is_taken(path); ++n)
    path = folder / fmt::format("{}-{}{}", stem, n, kJournalExtension);
  return path;
}

void add_counts(const JournalChannel& channel, RecorderStatus& sum) {
  sum.bytes_written += channel.bytes_written();
  sum.ticks_lost += channel.ticks_lost();
  sum.snapshots_written += channel.snapshots_written();
}

// Logged once when the trouble begins and once when it is over: a full disk must not fill the log too.
void tell(const std::string& before, const std::string& problem) {
  if (before.empty() && !problem.empty()) log::error("records are being lost: " + problem);
  if (!before.empty() && problem.empty()) log::info("records are being written again");
}

}  // namespace

/// One open world. The disk side of its channel is the thread's alone; the rest is under the mutex.
struct Recorder::Entry {
  std::unique_ptr<JournalChannel> channel;
  bool closing = false;
  bool closed = false;
  bool remove_snapshot = false;
  std::optional<std::uint64_t> final_hash;
};

/// What one round does with one world; copied out from under the mutex.
struct Recorder::Work {
  Entry* entry;
  bool finish;
  bool remove_snapshot;
  std::optional<std::uint64_t> final_hash;
};

WorldRecorder::WorldRecorder(WorldRecorder&& other) noexcept
    : recorder_(other.recorder_), channel_(std::exchange(other.channel_, nullptr)) {}

WorldRecorder& WorldRecorder::operator=(WorldRecorder&& other) noexcept {
  if (this != &other) {
    close();
    recorder_ = other.recorder_;
    channel_ = std::exchange(other.channel_, nullptr);
  }
  return *this;
}

WorldRecorder::~WorldRecorder() {
  close();
}

void WorldRecorder::push(const TickRecord& record) noexcept {
  channel_->push(record);
}
std::uint64_t WorldRecorder::refused() const noexcept {
  return channel_->refused();
}
std::vector<std::byte>& WorldRecorder::snapshot_buffer() noexcept {
  return channel_->snapshot_buffer();
}
void WorldRecorder::commit_snapshot(std::uint64_t tick) noexcept {
  channel_->commit_snapshot(tick);
}
const std::filesystem::path& WorldRecorder::journal_path() const noexcept {
  return channel_->journal_path();
}

void WorldRecorder::close(std::optional<std::uint64_t> final_hash, Snapshot snapshot) {
  if (channel_ != nullptr)
    recorder_->close_channel(*std::exchange(channel_, nullptr), final_hash, snapshot == Snapshot::remove);
}

Recorder::Recorder(const RecorderConfig& config) : config_(config) {}

Expected<std::unique_ptr<Recorder>> Recorder::create(const RecorderConfig& config) {
  const std::string where = "recorder, " + config.folder.string();
  if (config.ring_bytes < (64u << 10) || !std::has_single_bit(config.ring_bytes)) {
    return fail(ErrorCode::invalid_value, fmt::format("ring_bytes is {}", config.ring_bytes), where,
                "use a power of two of at least 65536");
  }
  if (config.drain_period <= Duration{0} || config.sync_period < Duration{0} || config.retry_after < Duration{0}) {
    return fail(ErrorCode::invalid_value, "a period is negative or zero", where, "use 20 ms, 1 s and 5 s");
  }
  std::error_code error;
  std::filesystem::create_directories(config.folder, error);
  if (error) {
    return fail(ErrorCode::io_failure, "the folder cannot be made: " + error.message(), where,
                "check the path and its rights");
  }
  std::unique_ptr<Recorder> recorder(new Recorder(config));
  try {
    recorder->thread_ = std::thread([self = recorder.get()] { self->run(); });
  } catch (const std::system_error& e) {
    return fail(ErrorCode::failed_process, std::string("the thread cannot be started: ") + e.what(), where,
                "raise the limit of threads (ulimit -u)");
  }
  return recorder;
}

Recorder::~Recorder() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

WorldRecorder Recorder::open(JournalHeader header, std::size_t snapshot_capacity,
                             std::vector<std::filesystem::path> replaced) {
  if (header.start_wall_ns == 0) header.start_wall_ns = wall_now_ns();
  const std::lock_guard lock(mutex_);
  // A journal of the same millisecond may be on the disk, or about to be.
  const auto is_taken = [this](const std::filesystem::path& path) {
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored)) return true;
    return std::any_of(entries_.begin(), entries_.end(),
                       [&](const auto& e) { return e->channel->journal_path() == path; });
  };
  auto entry = std::make_unique<Entry>();
  entry->channel = std::make_unique<JournalChannel>(header, journal_path_of(config_.folder, header, is_taken),
                                                    snapshot_path(config_.folder, header.world_id), config_.ring_bytes,
                                                    snapshot_capacity, config_.retry_after, std::move(replaced));
  entries_.push_back(std::move(entry));
  return {*this, *entries_.back()->channel};
}

RecorderStatus Recorder::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void Recorder::close_channel(const JournalChannel& channel, std::optional<std::uint64_t> final_hash,
                             bool remove_snapshot) {
  std::unique_lock lock(mutex_);
  const auto it =
      std::find_if(entries_.begin(), entries_.end(), [&](const auto& e) { return e->channel.get() == &channel; });
  if (it == entries_.end()) return;
  Entry& entry = **it;
  entry.final_hash = final_hash;
  entry.remove_snapshot = remove_snapshot;
  entry.closing = true;
  wake_.notify_one();
  closed_.wait(lock, [&] { return entry.closed; });
  // Removed here and not by the recorder's thread, which may have looked at the entry until now.
  std::erase_if(entries_, [&](const auto& e) { return e.get() == &entry; });
}

void Recorder::run() {
  set_up_thread("recorder");

  next_sync_ = now() + config_.sync_period;
  next_retention_ = now();
  for (bool stopping = false; !stopping;) {
    const std::vector<Work> work = wait_for_work(stopping);
    do_work(work, now());
    const std::string before = status().problem;
    finish_work(work);
    closed_.notify_all();
    tell(before, status().problem);
  }
}

std::vector<Recorder::Work> Recorder::wait_for_work(bool& stopping) {
  std::unique_lock lock(mutex_);
  wake_.wait_for(lock, config_.drain_period, [this] {
    return stop_ ||
           std::any_of(entries_.begin(), entries_.end(), [](const auto& e) { return e->closing && !e->closed; });
  });
  stopping = stop_;
  std::vector<Work> work;
  for (const auto& entry : entries_) {
    if (!entry->closed)
      work.push_back({entry.get(), entry->closing || stopping, entry->remove_snapshot, entry->final_hash});
  }
  return work;
}

void Recorder::do_work(const std::vector<Work>& work, TimePoint time) {
  const bool sync = time >= next_sync_;
  if (sync) next_sync_ = time + config_.sync_period;
  for (const Work& w : work) {
    if (w.finish) continue;
    w.entry->channel->drain(time);
    if (sync) w.entry->channel->sync();
  }
  // After the others: where visitors went on to another world, its snapshot is on the disk before that of the old world goes.
  bool finished = false;
  for (const Work& w : work) {
    if (!w.finish) continue;
    w.entry->channel->finish(time, w.final_hash, w.remove_snapshot);
    finished = true;
  }
  if (!finished && time < next_retention_) return;
  next_retention_ = time + kRetentionPeriod;
  auto kept = keep_within(config_.folder, config_.max_journal_bytes);
  if (kept) journals_deleted_ += kept->deleted;
  retention_problem_ = kept ? std::string() : kept.error().to_string();
}

void Recorder::finish_work(const std::vector<Work>& work) {
  const std::lock_guard lock(mutex_);
  RecorderStatus all = of_closed_;
  all.problem = retention_problem_;
  all.journals_deleted = journals_deleted_;
  for (const Work& w : work) {
    const JournalChannel& channel = *w.entry->channel;
    add_counts(channel, all);
    if (w.finish) {
      add_counts(channel, of_closed_);
    } else {
      ++all.open_journals;
    }
    if (!channel.ok()) all.problem = channel.problem();
    w.entry->closed = w.finish;
  }
  all.records_ok = all.problem.empty();
  status_ = all;
}

}  // namespace mechane::record
