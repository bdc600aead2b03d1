// Files for browsers: of the web app, of exhibits, and meshes by the hash of their content. Read once, then kept in memory up
// to a limit. Browsers read glTF alone: other mesh files that are wanted by their hash are given as .glb, without images.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "client-sdk/gateway/http/http_types.hpp"

namespace mechane::gateway {

struct FileWanted {
  std::filesystem::path folder;
  std::string path;             ///< within the folder
  std::string hash{};           ///< what its content must be; empty: whatever it is
  bool immutable = false;       ///< the same for ever under this address
  std::string if_none_match{};  ///< the request's headers
  std::string range{};
  std::string if_range{};
};

/// On one thread, which may wait for the disk.
class FileStore {
 public:
  static constexpr std::uintmax_t kMostOfFile = std::uintmax_t{128} << 20U;
  static constexpr std::uintmax_t kMostKept = std::uintmax_t{256} << 20U;

  /// The file, a part of it, "not changed", or why there is nothing: 404, 416, 403 for a suffix that is not served.
  [[nodiscard]] HttpAnswer answer(const FileWanted& wanted);

 private:
  struct Kept {
    std::filesystem::file_time_type changed;
    std::uintmax_t size = 0;  ///< of the file
    std::shared_ptr<const std::string> bytes;
    std::string hash;  ///< of the file
    std::uint64_t used = 0;
  };
  [[nodiscard]] Expected<Kept> read(const std::filesystem::path& file, bool as_glb);
  std::map<std::pair<std::filesystem::path, bool>, Kept> kept_;  ///< of a file as it is, or as .glb
  std::uintmax_t kept_bytes_ = 0;
  std::uint64_t uses_ = 0;
};

}  // namespace mechane::gateway
