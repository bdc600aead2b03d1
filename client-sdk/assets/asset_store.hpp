// A scenario's files from an HTTP server: fetched beside the drawing, held against their hashes, kept on disk, asked for again when
// something was wrong.
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
  HttpLimits http;  ///< secure_only is set by the address
  std::chrono::milliseconds first_retry{2'000};
  std::chrono::milliseconds longest_retry{60'000};  ///< each try waits twice as long as the one before
};

enum class AssetState : std::uint8_t {
  on_its_way,
  here,
  amiss,  ///< it will be asked for again, unless its name or hash cannot be one
};

struct AssetFile {
  AssetState state = AssetState::on_its_way;
  std::filesystem::path file;  ///< where it is here; its extension is that of the name
  Error error;                 ///< where it is amiss
};

/// $XDG_CACHE_HOME/mechane/assets, or ~/.cache/mechane/assets.
[[nodiscard]] std::filesystem::path default_asset_cache();

/// Owns a thread, which fetches, hashes and writes; the functions here may be called from any thread, and wait for nothing. What is
/// wrong is logged once a file and cause, with a remedy. Its end gives up what is still on its way.
class AssetStore {
 public:
  /// Errors: no HTTP library.
  [[nodiscard]] static Expected<std::unique_ptr<AssetStore>> open(AssetAddress address, AssetStoreOptions options);
  ~AssetStore();
  AssetStore(const AssetStore&) = delete;
  AssetStore& operator=(const AssetStore&) = delete;

  /// The file of a name relative to the scenario's folder. The first call asks for it. With a hash (content::content_hash()) only bytes
  /// of that hash are ever given, from the cache or from the server. Without, the server is asked once in the store's life whether its
  /// file is still that of the cache; where it cannot be asked, the cache's will do.
  [[nodiscard]] AssetFile find(const std::string& name, const std::string& hash);
  /// Names of files that came since the last call.
  [[nodiscard]] std::set<std::string> take_arrived();
  /// True while a file that was first asked for less than this long ago is not here and may yet come.
  [[nodiscard]] bool is_awaited(std::chrono::milliseconds patience) const;
  [[nodiscard]] const AssetAddress& address() const { return address_; }

 private:
  using Key = std::pair<std::string, std::string>;  ///< name, hash
  struct Asked {
    AssetFile file;
    std::chrono::steady_clock::time_point since;
    bool may_come = true;
  };
  /// A file that is not here yet. The thread's alone.
  struct Job {
    Key key;
    std::string address;
    std::string extension;
    RememberedFile remembered;  ///< of files without a hash
    std::set<std::string> told;
    bool asked = false;  ///< the server has it in hand
    int tries = 0;
    std::chrono::steady_clock::time_point due;
  };
  AssetStore(AssetAddress address, const AssetStoreOptions& options, std::unique_ptr<HttpFetcher> fetcher);
  void run(const std::stop_token& stop);
  void take_requests();
  void start_due();
  [[nodiscard]] std::chrono::milliseconds until_next() const;
  void settle(std::uint64_t id, HttpAnswer answer);
  [[nodiscard]] bool take_bytes(Job& job, const HttpAnswer& answer);
  [[nodiscard]] bool use_remembered(Job& job, bool fresh);
  void arrived(const Job& job, std::filesystem::path file);
  void again(Job& job, Error error);

  AssetAddress address_;
  AssetStoreOptions options_;
  std::unique_ptr<HttpFetcher> fetcher_;
  AssetCache cache_;                   ///< the thread's alone
  std::map<std::uint64_t, Job> jobs_;  ///< the thread's alone
  std::uint64_t next_id_ = 1;
  mutable std::mutex mutex_;  ///< guards what follows
  std::map<Key, Asked> files_;
  std::vector<Job> requests_;
  std::set<std::string> arrived_;
  std::jthread thread_;  ///< last: it must end first
};

}  // namespace mechane::assets
