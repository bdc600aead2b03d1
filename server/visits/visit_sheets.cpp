#include "server/visits/visit_sheets.hpp"

#include <algorithm>
#include <csignal>
#include <system_error>

#include <fmt/format.h>
#include <pthread.h>
#include <sys/stat.h>

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

VisitSheets::VisitSheets(const VisitSheetsConfig& config) : config_(config) {}

Expected<std::unique_ptr<VisitSheets>> VisitSheets::create(const VisitSheetsConfig& config) {
  std::unique_ptr<VisitSheets> sheets(new VisitSheets(config));
  if (auto opened = sheets->open(); !opened) sheets->set_problem(opened.error().to_string());
  sheets->opened_before_ = true;  // what runs in the file from now on is ours
  for (const VisitSheet& sheet : sheets->unfinished_)
    sheets->know(sheet.number);
  try {
    sheets->thread_ = std::thread([self = sheets.get()] { self->run(); });
  } catch (const std::system_error& e) {
    return fail(std::string("cannot make the thread: ") + e.what(), "visits' sheets",
                "raise the limit of threads (ulimit -u)");
  }
  return sheets;
}

VisitSheets::~VisitSheets() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void VisitSheets::put(VisitSheet sheet) {
  {
    const std::lock_guard lock(mutex_);
    const auto older = std::ranges::find(waiting_, sheet.number, &VisitSheet::number);
    if (older != waiting_.end()) {
      *older = std::move(sheet);
    } else {
      waiting_.push_back(std::move(sheet));
    }
    if (waiting_.size() > config_.queue) {
      waiting_.pop_front();
      ++status_.lost;
    }
  }
  wake_.notify_one();
}

std::optional<VisitSheet> VisitSheets::take_unfinished(const std::string& kiosk, const std::string& scenario_hash) {
  const auto fits = [&](const VisitSheet& sheet) {
    return sheet.kiosk == kiosk && sheet.scenario_hash == scenario_hash;
  };
  // They are in the order in which they began.
  const auto found = std::find_if(unfinished_.rbegin(), unfinished_.rend(), fits);
  if (found == unfinished_.rend()) return {};
  VisitSheet sheet = std::move(*found);
  unfinished_.erase(found.base() - 1);
  return sheet;
}

VisitSheetsStatus VisitSheets::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

/// Once when the trouble begins, once when it is over: a full disk must not fill the log too.
void VisitSheets::set_problem(const std::string& problem) {
  std::string before;
  {
    const std::lock_guard lock(mutex_);
    before = std::exchange(status_.problem, problem);
    status_.ok = problem.empty();
  }
  if (before.empty() && !problem.empty()) log::error("visits' sheets are not written: " + problem);
  if (!before.empty() && problem.empty()) log::info("visits' sheets are written again");
}

Expected<void> VisitSheets::begin_anew(const Error& why) {
  const auto aside = set_aside(config_.file);
  if (!aside) return tl::unexpected(aside.error());
  log::error(fmt::format("{}: {}; it is now {}, and a new one is begun; sqlite3's .recover may save some of the old",
                         why.where, why.what, aside->string()));
  known_.clear();
  known_in_order_.clear();
  return {};
}

/// With nobody's sheets running in it.
Expected<VisitFile> VisitSheets::open_or_begin_anew() {
  VisitFile::Trouble trouble = VisitFile::Trouble::none;
  auto opened = VisitFile::open(config_.file, VisitFile::Access::write_new, &trouble);
  if (opened && !opened_before_) {
    auto cut = opened->cut_running(minute_now() - kMinutesPerDay, &trouble);
    if (cut) {
      unfinished_ = std::move(*cut);
    } else {
      opened = tl::unexpected(cut.error());
    }
  }
  if (opened || trouble != VisitFile::Trouble::damaged) return opened;
  if (auto begun = begin_anew(opened.error()); !begun) return tl::unexpected(begun.error());
  return VisitFile::open(config_.file, VisitFile::Access::write_new, &trouble);
}

Expected<void> VisitSheets::open() {
  std::error_code code;
  if (config_.file.has_parent_path()) std::filesystem::create_directories(config_.file.parent_path(), code);
  if (is_replaced()) {  // another file knows nothing of what we wrote
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

void VisitSheets::know(const std::string& number) {
  if (!known_.insert(number).second) return;
  known_in_order_.push_back(number);
  if (known_in_order_.size() <= kMostKnown) return;  // no visit lasts that long
  known_.erase(known_in_order_.front());
  known_in_order_.pop_front();
}

/// Somebody has taken the file away, or put another in its place: what is written to the old one is lost.
bool VisitSheets::is_replaced() const {
  return inode_of(config_.file) != inode_;
}

void VisitSheets::run() {
  // No signal is handled here; and a file that grows over RLIMIT_FSIZE is an error of write(), not the end of the process.
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, nullptr);
  pthread_setname_np(pthread_self(), "visits");

  for (bool stopping = false; !stopping;) {
    std::deque<VisitSheet> sheets;
    {
      std::unique_lock lock(mutex_);
      const bool rests = !status_.ok;
      wake_.wait_for(lock, rests ? config_.retry_after : kLookForOld,
                     [&] { return stop_ || (!rests && !waiting_.empty()); });
      stopping = stop_;
      sheets = std::exchange(waiting_, {});
    }
    write(std::move(sheets));
    if (!stopping) retain(steady_now());
  }
}

void VisitSheets::write(std::deque<VisitSheet> sheets) {
  if (!file_ || is_replaced()) {
    if (auto opened = open(); !opened) {
      set_problem(opened.error().to_string());
      return put_back(std::move(sheets));
    }
  }
  while (!sheets.empty()) {
    if (auto written = write_one(sheets.front()); !written) {
      set_problem(written.error().to_string());
      return put_back(std::move(sheets));
    }
    sheets.pop_front();
  }
  set_problem("");
}

Expected<void> VisitSheets::write_one(const VisitSheet& sheet) {
  VisitFile::Trouble trouble = VisitFile::Trouble::none;
  const bool is_new = !known_.contains(sheet.number);
  auto written = file_->put(sheet, is_new, &trouble);
  if (!written && trouble == VisitFile::Trouble::damaged) {
    file_.reset();
    if (auto begun = begin_anew(written.error()); !begun) return begun;
    if (auto opened = open(); !opened) return opened;
    written = file_->put(sheet, true, &trouble);
  }
  if (!written) return tl::unexpected(written.error());
  know(sheet.number);
  const std::lock_guard lock(mutex_);
  status_.written += *written ? 1 : 0;
  return {};
}

/// For the next try. What came meanwhile is newer.
void VisitSheets::put_back(std::deque<VisitSheet> sheets) {
  const std::lock_guard lock(mutex_);
  for (auto sheet = sheets.rbegin(); sheet != sheets.rend(); ++sheet) {
    if (std::ranges::find(waiting_, sheet->number, &VisitSheet::number) != waiting_.end()) continue;
    if (waiting_.size() >= config_.queue) {
      ++status_.lost;
    } else {
      waiting_.push_front(std::move(*sheet));
    }
  }
}

void VisitSheets::retain(TimePoint time) {
  if (!file_ || time < next_retention_) return;
  next_retention_ = time + kLookForOld;
  const std::int64_t oldest = config_.keep_days == 0 ? 0 : minute_now() - config_.keep_days * kMinutesPerDay;
  const auto deleted = file_->keep_within(oldest, config_.max_bytes);
  if (!deleted) return log::warning(deleted.error().to_string());
  if (*deleted > 0) log::info(fmt::format("{} old visits' sheets were deleted", *deleted));
  const std::lock_guard lock(mutex_);
  status_.deleted += *deleted;
}

}  // namespace mechane::visits
