#include "server/visits/visit_writer.hpp"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>
#include <sys/stat.h>

#include "server/base/thread_setup.hpp"
#include "server/log/log.hpp"

namespace mechane::visits {
namespace {

constexpr Duration kLookForOld = std::chrono::hours(1);
constexpr std::int64_t kMinutesPerDay = 1440;
constexpr std::size_t kMostKnown = 10'000;

std::uint64_t inode_of(const std::filesystem::path& file) {
  struct stat status {};
  return ::stat(file.c_str(), &status) == 0 ? status.st_ino : 0;
}

TimePoint steady_now() {
  return SystemClock().now();
}

}  // namespace

VisitWriter::VisitWriter(const VisitWriterConfig& config) : config_(config) {}

Expected<std::unique_ptr<VisitWriter>> VisitWriter::create(const VisitWriterConfig& config) {
  std::unique_ptr<VisitWriter> writer(new VisitWriter(config));
  if (auto opened = writer->open(); !opened) writer->set_problem(opened.error().to_string());
  writer->opened_before_ = true;  // visits that are running in the file from now on are our own
  for (const VisitRecord& record : writer->unfinished_)
    writer->know(record.number);
  try {
    writer->thread_ = std::thread([self = writer.get()] { self->run(); });
  } catch (const std::system_error& e) {
    return fail(ErrorCode::failed_process, std::string("the thread cannot be started: ") + e.what(), "visits",
                "raise the limit of threads (ulimit -u)");
  }
  return writer;
}

VisitWriter::~VisitWriter() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void VisitWriter::put(VisitRecord record) {
  {
    const std::lock_guard lock(mutex_);
    const auto older = std::ranges::find(waiting_, record.number, &VisitRecord::number);
    if (older != waiting_.end()) {
      *older = std::move(record);
    } else {
      waiting_.push_back(std::move(record));
    }
    if (waiting_.size() > config_.queue) {
      waiting_.pop_front();
      ++status_.lost;
    }
  }
  wake_.notify_one();
}

std::optional<VisitRecord> VisitWriter::take_unfinished(const std::string& kiosk, const std::string& scenario_hash) {
  const auto fits = [&](const VisitRecord& record) {
    return record.kiosk == kiosk && record.scenario_hash == scenario_hash;
  };
  // They are in the order in which they began.
  const auto found = std::find_if(unfinished_.rbegin(), unfinished_.rend(), fits);
  if (found == unfinished_.rend()) return {};
  VisitRecord record = std::move(*found);
  unfinished_.erase(found.base() - 1);
  return record;
}

VisitWriterStatus VisitWriter::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

/// Logged once when the trouble begins and once when it is over: a full disk must not fill the log too.
void VisitWriter::set_problem(const std::string& problem) {
  std::string before;
  {
    const std::lock_guard lock(mutex_);
    before = std::exchange(status_.problem, problem);
    status_.ok = problem.empty();
  }
  if (before.empty() && !problem.empty()) log::error("visits are not being recorded: " + problem);
  if (!before.empty() && problem.empty()) log::info("visits are being recorded again");
}

Expected<void> VisitWriter::begin_anew(const Error& why) {
  const auto aside = set_aside(config_.file);
  if (!aside) return tl::unexpected(aside.error());
  log::error(
      fmt::format("{}: {}; the file is now called {}, and a new one was begun; sqlite3's .recover may save some of "
                  "the old visits",
                  why.where, why.what, aside->string()));
  known_.clear();
  known_in_order_.clear();
  return {};
}

/// Opens the file, sets it aside where it is damaged, and marks visits that a former server left running as cut off.
Expected<VisitFile> VisitWriter::open_or_begin_anew() {
  auto opened = VisitFile::open(config_.file, VisitFile::Access::write_new);
  if (opened && !opened_before_) {
    auto cut = opened->cut_running(minute_now() - kMinutesPerDay);
    if (cut) {
      unfinished_ = std::move(*cut);
    } else {
      opened = tl::unexpected(cut.error());
    }
  }
  if (opened || opened.error().code != ErrorCode::damaged) return opened;
  if (auto begun = begin_anew(opened.error()); !begun) return tl::unexpected(begun.error());
  return VisitFile::open(config_.file, VisitFile::Access::write_new);
}

Expected<void> VisitWriter::open() {
  std::error_code code;
  if (config_.file.has_parent_path()) std::filesystem::create_directories(config_.file.parent_path(), code);
  if (is_replaced()) {  // what we wrote is not in this file
    known_.clear();
    known_in_order_.clear();
  }
  file_.reset();
  auto opened = open_or_begin_anew();
  if (!opened) return tl::unexpected(opened.error());
  inode_ = inode_of(config_.file);
  file_ = std::move(*opened);
  next_retention_ = {};
  return {};
}

void VisitWriter::know(const std::string& number) {
  if (!known_.insert(number).second) return;
  known_in_order_.push_back(number);
  if (known_in_order_.size() <= kMostKnown) return;  // a visit that ended long ago does not change any more
  known_.erase(known_in_order_.front());
  known_in_order_.pop_front();
}

/// Whether somebody has removed the file, or put another one in its place: what is written to the old one would be lost.
bool VisitWriter::is_replaced() const {
  return inode_of(config_.file) != inode_;
}

void VisitWriter::run() {
  set_up_thread("visits");

  for (bool stopping = false; !stopping;) {
    std::deque<VisitRecord> records;
    {
      std::unique_lock lock(mutex_);
      const bool rests = !status_.ok;
      wake_.wait_for(lock, rests ? config_.retry_after : kLookForOld,
                     [&] { return stop_ || (!rests && !waiting_.empty()); });
      stopping = stop_;
      records = std::exchange(waiting_, {});
    }
    write(std::move(records));
    if (!stopping) retain(steady_now());
  }
}

void VisitWriter::write(std::deque<VisitRecord> records) {
  if (!file_ || is_replaced()) {
    if (auto opened = open(); !opened) {
      set_problem(opened.error().to_string());
      return put_back(std::move(records));
    }
  }
  while (!records.empty()) {
    if (auto written = write_one(records.front()); !written) {
      set_problem(written.error().to_string());
      return put_back(std::move(records));
    }
    records.pop_front();
  }
  set_problem("");
}

Expected<void> VisitWriter::write_one(const VisitRecord& record) {
  const bool is_new = !known_.contains(record.number);
  auto written = file_->put(record, is_new);
  if (!written && written.error().code == ErrorCode::damaged) {
    file_.reset();
    if (auto begun = begin_anew(written.error()); !begun) return begun;
    if (auto opened = open(); !opened) return opened;
    written = file_->put(record, true);
  }
  if (!written) return tl::unexpected(written.error());
  know(record.number);
  const std::lock_guard lock(mutex_);
  status_.written += *written ? 1 : 0;
  return {};
}

/// Back into the queue for the next try, except records of which a newer state has come meanwhile.
void VisitWriter::put_back(std::deque<VisitRecord> records) {
  const std::lock_guard lock(mutex_);
  for (auto record = records.rbegin(); record != records.rend(); ++record) {
    if (std::ranges::find(waiting_, record->number, &VisitRecord::number) != waiting_.end()) continue;
    if (waiting_.size() >= config_.queue) {
      ++status_.lost;
    } else {
      waiting_.push_front(std::move(*record));
    }
  }
}

void VisitWriter::retain(TimePoint time) {
  if (!file_ || time < next_retention_) return;
  next_retention_ = time + kLookForOld;
  const std::int64_t oldest = config_.keep_days == 0 ? 0 : minute_now() - config_.keep_days * kMinutesPerDay;
  const auto deleted = file_->keep_within(oldest, config_.max_bytes);
  if (!deleted) return log::warning(deleted.error().to_string());
  if (*deleted > 0) log::info(fmt::format("{} old visits were deleted", *deleted));
  const std::lock_guard lock(mutex_);
  status_.deleted += *deleted;
}

}  // namespace mechane::visits
