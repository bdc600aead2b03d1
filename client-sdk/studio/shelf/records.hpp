// What people have written about the museum's meshes and sounds: whose they are, and words by which they are found.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"
#include "server/content/catalogue.hpp"

namespace mechane::studio {

/// Of a file, or of an exhibit, which says it itself. Empty: nobody has said it.
struct Record {
  std::string description;
  content::Credits credits;  ///< without the version, of a file
  std::vector<std::string> tags{};
  std::vector<std::string> languages{};  ///< codes
  bool operator==(const Record&) const = default;
};

/// By the file's path in the museum: "odometer/files/gear.glb", "models/odometer.glb".
using RecordMap = std::map<std::string, Record>;

/// {"path", "about", "before"?}: what is said of a file from now on, and what its writer has seen of it.
struct AboutRequest {
  std::string path;
  Record about;
  std::optional<Record> before{};
};

/// Reads bytes from anywhere. Errors: too_large; invalid_value, with the field: "about/tags/2".
[[nodiscard]] Expected<AboutRequest> parse_about(std::string_view json);
/// The file's text. Errors: too_large; damaged.
[[nodiscard]] Expected<RecordMap> parse_records(std::string_view json);
[[nodiscard]] std::string records_json(const RecordMap& records);

/// One file of them all. One thread, which may wait for the disk.
class Records {
 public:
  static constexpr std::uintmax_t kMostBytes = std::uintmax_t{8} << 20U;

  explicit Records(std::filesystem::path file) : file_(std::move(file)) {}

  /// Empty while the file does not exist. Errors: io_failure; too_large; damaged.
  [[nodiscard]] Expected<RecordMap> all() const;
  /// Writes these; what is empty goes, and others stay. Errors: those of all(); too_large; io_failure, and then all is as it was.
  [[nodiscard]] Expected<void> put(const RecordMap& records) const;

 private:
  std::filesystem::path file_;
};

}  // namespace mechane::studio
