// A scenario's files from an HTTP server: fetched in the background, compared with their hashes, kept on disk, and
// requested again after a failure.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "client-sdk/assets/asset_address.hpp"
#include "client-sdk/assets/asset_cache.hpp"
#include "client-sdk/assets/http_fetch.hpp"
#include "server/base/error.hpp"

namespace mechane::assets {

struct AssetStoreOptions {
  std::filesystem::path cache_folder;  ///< empty: default_asset_cache()
  std::uint64_t cache_bytes = 4ULL << 30U;
  HttpLimits http;  ///< secure_only is set from the address
  std::chrono::milliseconds first_retry{2'000};
  std::chrono::milliseconds longest_retry{60'000};  ///< each pause is twice as long as the one before
};

enum class AssetState : std::uint8_t {
  on_its_way,
  here,
  amiss,  ///< it will be requested again, unless its name or hash is invalid
};

struct AssetFile {
  AssetState state = AssetState::on_its_way;
  std::filesystem::path file;  ///< if here: its place, with the name's extension
  Error error;                 ///< if amiss
};

/// $XDG_CACHE_HOME/mechane/assets, or ~/.cache/mechane/assets.
[[nodiscard]] std::filesystem::path default_asset_cache();

/// Owns a thread, which fetches, hashes and writes; the functions may be called from any thread and do not wait.
/// Failures are logged once per file and cause, with a remedy. The destructor gives up transfers that are still
/// running.
class AssetStore {
 public:
  /// Errors: no HTTP library.
  [[nodiscard]] static Expected<std::unique_ptr<AssetStore>> open(AssetAddress address, AssetStoreOptions options);
  ~AssetStore();
  AssetStore(const AssetStore&) = delete;
  AssetStore& operator=(const AssetStore&) = delete;

  /// The file with this name, relative to the scenario's folder. The first call requests it. With a hash
  /// (content::content_hash()), only bytes with that hash are returned, from the cache or from the server. Without a
  /// hash, the server is asked once in the store's life whether the cached file is still current; if it does not
  /// answer, the cached file is used.
  [[nodiscard]] AssetFile find(const std::string& name, const std::string& hash);
  /// Names of files that arrived since the last call.
  [[nodiscard]] std::set<std::string> take_arrived();
  /// True while a file that was first requested less than this long ago is not here, but may still arrive.
  [[nodiscard]] bool is_awaited(std::chrono::milliseconds patience) const;
  [[nodiscard]] const AssetAddress& address() const { return address_; }

 private:
  using Key = std::pair<std::string, std::string>;  ///< name, hash
  struct Asked {
    AssetFile file;
    std::chrono::steady_clock::time_point since;
    bool may_come = true;
  };
  /// A file that is not here yet. Used by the thread only.
  struct Job {
    Key key;
    std::string address;
    std::string extension;
    RememberedFile remembered;  ///< of files without a hash
    std::set<std::string> told;
    bool asked = false;  ///< a request is under way
    int tries = 0;
    std::chrono::steady_clock::time_point due;
  };
  AssetStore(AssetAddress address, const AssetStoreOptions& options, std::unique_ptr<HttpFetcher> fetcher);
  void run(const std::stop_token& stop);
  void take_requests();
  void start_due();
  [[nodiscard]] std::chrono::milliseconds until_next() const;
  void settle(const HttpAnswer& answer);
  [[nodiscard]] bool take_bytes(Job& job, const HttpAnswer& answer);
  [[nodiscard]] bool use_remembered(Job& job, bool fresh);
  void arrived(const Job& job, std::filesystem::path file);
  void again(Job& job, Error error);

  AssetAddress address_;
  AssetStoreOptions options_;
  std::unique_ptr<HttpFetcher> fetcher_;
  AssetCache cache_;                   ///< used by the thread only
  std::map<std::uint64_t, Job> jobs_;  ///< used by the thread only
  std::uint64_t next_id_ = 1;
  mutable std::mutex mutex_;  ///< guards what follows
  std::map<Key, Asked> files_;
  std::vector<Job> requests_;
  std::set<std::string> arrived_;
  std::jthread thread_;  ///< last: it must end first
};

}  // namespace mechane::assets
