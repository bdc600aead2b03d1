#include "client-sdk/gateway/operations/visits_desk.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "client-sdk/gateway/operations/visits_json.hpp"
#include "server/visits/visit_file.hpp"

namespace mechane::gateway {
namespace {

namespace fs = std::filesystem;
using visits::VisitFile;
using visits::VisitRecord;

constexpr std::size_t kMostVisitsJobs = 16;
constexpr Duration kVisitsStay = std::chrono::seconds(2);
constexpr int kShareOfTime = 10;  ///< a file that changes all the time is read for one part in ten of the time

TimePoint desk_now() {
  return std::chrono::steady_clock::now();
}

/// Another text whenever a program may have written.
std::string stamp_of(const fs::path& file) {
  std::string stamp;
  for (const char* beside : {"", "-wal"}) {
    std::error_code missing;
    const fs::path one = file.string() + beside;
    const auto size = fs::file_size(one, missing);
    const auto time = fs::last_write_time(one, missing).time_since_epoch().count();
    stamp += missing ? "- " : fmt::format("{} {} ", size, time);
  }
  return stamp;
}

std::vector<std::string> names_of(const std::vector<VisitRecord>& records, std::string VisitRecord::*field) {
  std::set<std::string> names;
  for (const VisitRecord& record : records)
    if (!(record.*field).empty()) names.insert(record.*field);
  return {names.begin(), names.end()};
}

}  // namespace

VisitsDesk::VisitsDesk(const fs::path& records, const fs::path& state, Post post)
    : file_(records.empty() ? fs::path() : records / visits::kVisitFileName),
      remarks_(state / visits::kRemarkBookName),
      post_(std::move(post)) {}

void VisitsDesk::give(std::function<HttpAnswer()> work, Site::Done done) {
  if (file_.empty())
    return done(refusal(404, "this gateway was started without records", "start it with --records FOLDER"));
  if (waiting_ >= kMostVisitsJobs)
    return done(refusal(503, "the gateway is busy reading visits", "try again in a moment"));
  ++waiting_;
  thread_.give([this, work = std::move(work), done = std::move(done)] {
    post_([this, done, answer = work()] {
      --waiting_;
      done(answer);
    });
  });
}

void VisitsDesk::read(const VisitsQuery& query, std::function<HttpAnswer(const VisitsFound&)> answer, Site::Done done) {
  give(
      [this, query, answer = std::move(answer)] {
        const auto found = find_now(query);
        return found ? answer(*found) : refusal(found.error());
      },
      std::move(done));
}

void VisitsDesk::find(const std::string& number, std::function<void(Expected<VisitRecord>)> then) {
  if (waiting_ >= kMostVisitsJobs)
    return then(fail(ErrorCode::busy, "the gateway is busy reading visits", {}, "try again in a moment"));
  ++waiting_;
  thread_.give([this, number, then = std::move(then)] {
    auto visit = visit_now(number);
    const auto written = book();
    if (visit && written) (*written)->put_into({&*visit, 1});
    post_([this, then, visit = std::move(visit)] {
      --waiting_;
      then(visit);
    });
  });
}

void VisitsDesk::remark(const std::string& number, const visits::RecordedRemark& remark, Site::Done done) {
  if (!visits::is_visit_number(number))
    return done(refusal(404, "this is not the number of a visit", "GET /api/visits lists them"));
  give([this, number, remark] { return remark_now(number, remark); }, std::move(done));
}

Expected<VisitsFound> VisitsDesk::find_now(const VisitsQuery& query) {
  VisitsFound found;
  found.query = query;
  found.now = visits::minute_now();
  found.since = found.now - query.days * 24 * 60;
  if (auto read = look_again(query.days, found.since); !read) return tl::unexpected(read.error());
  const auto written = book();
  if (!written) return tl::unexpected(written.error());
  found.cut = kept_->records.size() >= kMostVisits;
  found.exhibits = names_of(kept_->records, &VisitRecord::scenario);
  found.languages = names_of(kept_->records, &VisitRecord::language);
  std::ranges::copy_if(kept_->records, std::back_inserter(found.records),
                       [&](const VisitRecord& one) { return one.minute >= found.since && query.fits(one); });
  (*written)->put_into(found.records);
  return found;
}

Expected<void> VisitsDesk::look_again(std::int64_t days, std::int64_t since) {
  const TimePoint now = desk_now();
  const std::string stamp = stamp_of(file_);
  if (kept_ && kept_->days == days) {
    const bool early = now - kept_->read < std::max(kVisitsStay, kShareOfTime * kept_->took);
    if (early || kept_->stamp == stamp) return {};
  }
  kept_.reset();
  const auto file = VisitFile::open(file_, VisitFile::Access::read);
  if (!file) return tl::unexpected(file.error());
  auto records = file->records({.since = since, .newest = kMostVisits});
  if (!records) return tl::unexpected(records.error());
  const auto numbers = file->numbers();
  if (!numbers) return tl::unexpected(numbers.error());
  const auto written = book();
  if (!written) return tl::unexpected(written.error());
  if (auto kept = (*written)->keep_only(*numbers); !kept) return kept;
  const TimePoint read = desk_now();
  kept_ = Kept{days, stamp, read, read - now, std::move(*records)};
  return {};
}

Expected<visits::RemarkBook*> VisitsDesk::book() {
  if (!book_) {
    auto opened = visits::RemarkBook::open(remarks_);
    if (!opened) return tl::unexpected(opened.error());
    book_ = std::move(*opened);
  }
  return &*book_;
}

Expected<VisitRecord> VisitsDesk::visit_now(const std::string& number) const {
  const auto unknown = [&] {
    return fail(ErrorCode::unknown_name, "there is no visit with this number", number, "GET /api/visits lists them");
  };
  if (file_.empty() || !visits::is_visit_number(number)) return unknown();
  const auto file = VisitFile::open(file_, VisitFile::Access::read);
  if (!file) return tl::unexpected(file.error());
  auto records = file->records({.number = number});
  if (!records) return tl::unexpected(records.error());
  if (records->size() != 1) return unknown();
  return std::move(records->front());
}

HttpAnswer VisitsDesk::remark_now(const std::string& number, const visits::RecordedRemark& remark) {
  auto visit = visit_now(number);
  if (!visit) return refusal(visit.error());
  const auto written = book();
  if (!written) return refusal(written.error());
  if (auto added = (*written)->add(number, remark); !added) return refusal(added.error());
  (*written)->put_into({&*visit, 1});
  return answer_with(remarks_json(*visit), "application/json");
}

}  // namespace mechane::gateway
