#include "client-sdk/assets/asset_store.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "server/content/content_hash.hpp"
#include "server/content/object_store.hpp"
#include "server/log/log.hpp"

namespace mechane::assets {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kLongestSleep{1'000};
constexpr std::size_t kMostExtension = 8;

/// The name's extension (".glb"), by which the importer chooses its format. Empty where it is not a plain extension.
std::string plain_extension(const std::string& name) {
  const std::string extension = std::filesystem::path(name).extension().string();
  const bool plain = extension.size() > 1 && extension.size() <= kMostExtension &&
                     std::all_of(extension.begin() + 1, extension.end(), [](char c) {
                       return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
                     });
  return plain ? extension : std::string();
}

/// A server's answer that is not the file.
Error error_of(const HttpAnswer& answer, const std::string& address) {
  const char* remedy = "check that this server runs and has the file; the display will ask for it again";
  if (!answer.problem.empty()) return {answer.code, answer.problem, address, remedy};
  const bool gone = answer.status == 404 || answer.status == 410;
  return {gone ? ErrorCode::not_found : ErrorCode::io_failure,
          fmt::format("the server answers with HTTP status {}", answer.status), address, remedy};
}

}  // namespace

std::filesystem::path default_asset_cache() {
  return content::default_cache_folder() / "assets";
}

Expected<std::unique_ptr<AssetStore>> AssetStore::open(AssetAddress address, AssetStoreOptions options) {
  options.http.secure_only = address.secure();
  if (options.cache_folder.empty()) options.cache_folder = default_asset_cache();
  auto fetcher = HttpFetcher::create(options.http);
  if (!fetcher) return tl::unexpected(fetcher.error());
  return std::unique_ptr<AssetStore>(new AssetStore(std::move(address), options, std::move(*fetcher)));
}

AssetStore::AssetStore(AssetAddress address, const AssetStoreOptions& options, std::unique_ptr<HttpFetcher> fetcher)
    : address_(std::move(address)),
      options_(options),
      fetcher_(std::move(fetcher)),
      cache_(options.cache_folder, options.cache_bytes),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

AssetStore::~AssetStore() {
  thread_.request_stop();
  fetcher_->wake();
}

AssetFile AssetStore::find(const std::string& name, const std::string& hash) {
  const Key key(name, hash);
  const std::lock_guard lock(mutex_);
  const auto [at, is_new] = files_.try_emplace(key);
  AssetFile& file = at->second.file;
  // Another display that shares the cache may have removed the file to make room.
  std::error_code code;
  const bool gone = file.state == AssetState::here && !std::filesystem::exists(file.file, code);
  if (!is_new && !gone) return file;
  at->second = {{}, Clock::now(), true};
  const Expected<std::string> address = address_.of(name);
  if (!address) {
    file = {AssetState::amiss, {}, address.error()};
  } else if (!hash.empty() && !is_content_hash(hash)) {
    file = {AssetState::amiss,
            {},
            Error{ErrorCode::invalid_value, "the server sent an invalid hash for this file", name,
                  "install the same version of Mechane on server and display"}};
  } else {
    Job job;
    job.key = key;
    job.address = *address;
    job.extension = plain_extension(name);
    requests_.push_back(std::move(job));
    fetcher_->wake();
  }
  at->second.may_come = file.state == AssetState::on_its_way;
  return file;
}

std::set<std::string> AssetStore::take_arrived() {
  const std::lock_guard lock(mutex_);
  return std::exchange(arrived_, {});
}

bool AssetStore::is_awaited(milliseconds patience) const {
  const auto earliest = Clock::now() - patience;
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(files_, [&](const auto& entry) {
    const Asked& asked = entry.second;
    return asked.file.state != AssetState::here && asked.may_come && asked.since > earliest;
  });
}

void AssetStore::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    take_requests();
    start_due();
    for (const HttpAnswer& answer : fetcher_->wait(until_next()))
      settle(answer);
  }
}

void AssetStore::take_requests() {
  std::vector<Job> requests;
  {
    const std::lock_guard lock(mutex_);
    requests.swap(requests_);
  }
  for (Job& request : requests) {
    const std::string& hash = request.key.second;
    if (hash.empty()) {
      request.remembered = cache_.recall(request.address).value_or(RememberedFile{});
    } else if (auto file = cache_.find(hash, request.extension)) {
      arrived(request, std::move(*file));
      continue;
    }
    jobs_.emplace(next_id_++, std::move(request));
  }
}

void AssetStore::start_due() {
  const auto now = Clock::now();
  for (auto& [id, job] : jobs_) {
    if (job.asked || job.due > now) continue;
    job.asked = true;
    fetcher_->start({id, job.address, job.remembered.etag, job.remembered.modified});
  }
}

milliseconds AssetStore::until_next() const {
  milliseconds least = kLongestSleep;
  const auto now = Clock::now();
  for (const auto& [id, job] : jobs_) {
    if (!job.asked) least = std::min(least, std::chrono::ceil<milliseconds>(job.due - now));
  }
  return std::max(least, milliseconds(0));
}

void AssetStore::settle(const HttpAnswer& answer) {
  Job& job = jobs_.at(answer.id);
  job.asked = false;
  const bool same = answer.problem.empty() && answer.status == 304;
  const bool whole = answer.problem.empty() && answer.status == 200;
  bool done = false;
  if (whole) {
    done = take_bytes(job, answer);
  } else if (use_remembered(job, same)) {
    done = true;
  } else if (same) {
    // The cached copy is gone or damaged: fetch the whole file at once.
    job.remembered = {};
  } else {
    again(job, error_of(answer, job.address));
  }
  if (done) jobs_.erase(answer.id);
}

bool AssetStore::take_bytes(Job& job, const HttpAnswer& answer) {
  const std::string& wanted = job.key.second;
  const std::string hash = content::content_hash(std::span(answer.bytes));
  if (!wanted.empty() && hash != wanted) {
    again(job, {ErrorCode::conflict,
                fmt::format("the web server's file has content {}, the exhibit server's has {}: it is not used",
                            content::short_hash(hash), content::short_hash(wanted)),
                job.address,
                "copy the exhibits' files to the web server (mechane content export); the display will ask for this "
                "file again"});
    return false;
  }
  Expected<std::filesystem::path> file = cache_.keep(answer.bytes, hash, job.extension);
  if (!file) {
    again(job, file.error());
    return false;
  }
  if (wanted.empty()) cache_.remember(job.address, {hash, answer.etag, answer.modified});
  arrived(job, std::move(*file));
  return true;
}

/// `fresh`: the server has confirmed that its file is still the remembered one.
bool AssetStore::use_remembered(Job& job, bool fresh) {
  if (job.remembered.hash.empty()) return false;
  auto file = cache_.find(job.remembered.hash, job.extension);
  if (!file) return false;
  if (!fresh)
    log::warning(fmt::format("{}: the server does not deliver it now; the copy in the cache is used", job.address));
  arrived(job, std::move(*file));
  return true;
}

void AssetStore::arrived(const Job& job, std::filesystem::path file) {
  {
    const std::lock_guard lock(mutex_);
    files_[job.key].file = {AssetState::here, std::move(file), {}};
    arrived_.insert(job.key.first);
  }
  log::info(fmt::format("{}: is here{}", job.address, job.tries > 0 ? " now" : ""));
}

void AssetStore::again(Job& job, Error error) {
  milliseconds pause = options_.first_retry;
  for (int i = 0; i < job.tries && pause < options_.longest_retry; ++i)
    pause *= 2;
  ++job.tries;
  job.due = Clock::now() + std::min(pause, options_.longest_retry);
  if (job.told.insert(error.what).second) log::warning(error.to_string());
  const std::lock_guard lock(mutex_);
  files_[job.key].file = {AssetState::amiss, {}, std::move(error)};
}

}  // namespace mechane::assets
