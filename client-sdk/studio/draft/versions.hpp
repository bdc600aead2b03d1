// Texts of a draft that somebody has given a name, to come back to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "client-sdk/studio/draft/draft.hpp"
#include "server/base/error.hpp"

namespace mechane::studio {

struct Version {
  std::int64_t number = 0;  ///< from 1, in the order made
  std::string title;
  std::string by;
  std::int64_t made_s = 0;  ///< since 1970 UTC
};

/// A folder with N.x3d and N.json. One thread, which may wait for the disk.
class Versions {
 public:
  static constexpr std::size_t kMost = 500;          ///< then the oldest one goes
  static constexpr std::size_t kLongestTitle = 200;  ///< bytes

  explicit Versions(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The newest first. One whose description is damaged is left out.
  [[nodiscard]] std::vector<Version> all() const;
  /// Errors: io_failure, with nothing added.
  [[nodiscard]] Expected<Version> add(const std::string& title, std::string_view text, const Author& author) const;
  /// Errors: not_found; io_failure; too_large.
  [[nodiscard]] Expected<std::string> text(std::int64_t number) const;

 private:
  [[nodiscard]] std::filesystem::path file(std::int64_t number, const char* suffix) const;
  std::filesystem::path folder_;
};

}  // namespace mechane::studio
