// RemarkBook: what observers wrote in a console that may only read the server's records. One JSON file, which one program writes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"
#include "server/visits/visit_record.hpp"

namespace mechane::visits {

inline constexpr const char* kRemarkBookName = "remarks.json";

/// Remarks by their visit's whole number, in the order in which they were written.
using Remarks = std::map<std::string, std::vector<RecordedRemark>>;

/// One thread.
class RemarkBook {
 public:
  static constexpr std::size_t kMost = 5000;
  static constexpr std::size_t kMostOfVisit = 50;
  static constexpr std::size_t kLongestAuthor = 31;

  /// Empty where the file is missing. Errors: damaged, too_large, io_failure.
  [[nodiscard]] static Expected<RemarkBook> open(std::filesystem::path file);

  /// Adds a remark and writes the file. `number`: a visit's whole number. Errors: invalid_value, too_large (the text); conflict (too
  /// many of this visit, or in all); io_failure. After an error nothing was kept.
  [[nodiscard]] Expected<void> add(const std::string& number, const RecordedRemark& remark);
  /// Forgets what was written about other visits, and writes the file where there was any: the server has forgotten these visits.
  [[nodiscard]] Expected<void> keep_only(const std::set<std::string>& numbers);
  /// Puts the remarks into the records of their visits, behind those that are there.
  void put_into(std::span<VisitRecord> records) const;

  [[nodiscard]] const Remarks& remarks() const { return remarks_; }

 private:
  explicit RemarkBook(std::filesystem::path file) : file_(std::move(file)) {}
  [[nodiscard]] Expected<void> keep(Remarks remarks);

  std::filesystem::path file_;
  Remarks remarks_;
};

/// For the file: bytes that may be anything. Errors: damaged.
[[nodiscard]] Expected<Remarks> parse_remarks(std::string_view text);

/// Errors: invalid_value and too_large: a text that cannot be kept, or a time outside a visit.
[[nodiscard]] Expected<void> check_remark(const RecordedRemark& remark, const std::string& number);

}  // namespace mechane::visits
