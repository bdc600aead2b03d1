#include "server/visits/remark_book.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "server/base/utf8.hpp"
#include "server/base/whole_file.hpp"

namespace mechane::visits {
namespace {

using Json = nlohmann::json;

constexpr std::uintmax_t kMostBookBytes = std::uintmax_t{32} << 20U;
constexpr double kLatest_s = 1e6;

std::size_t count_of_all(const Remarks& remarks) {
  std::size_t count = 0;
  for (const auto& [number, of_visit] : remarks)
    count += of_visit.size();
  return count;
}

std::string written(const Remarks& remarks) {
  Json list = Json::array();
  for (const auto& [number, of_visit] : remarks) {
    for (const RecordedRemark& remark : of_visit) {
      Json one{{"visit", number}, {"minute", remark.minute}, {"author", remark.author}, {"text", remark.text}};
      if (remark.at_s) one["at_s"] = *remark.at_s;
      list.push_back(std::move(one));
    }
  }
  return Json{{"remarks", list}}.dump(1) + "\n";
}

/// None: not as written() has it.
std::optional<RecordedRemark> remark_of(const Json& json) {
  const auto is = [&](const char* key, auto fits) { return json.contains(key) && (json[key].*fits)(); };
  if (!is("minute", &Json::is_number_unsigned) || !is("author", &Json::is_string) || !is("text", &Json::is_string))
    return std::nullopt;
  if (json.contains("at_s") && !json["at_s"].is_number()) return std::nullopt;
  RecordedRemark remark{static_cast<std::int64_t>(json["minute"].get<std::uint32_t>()), json["text"], json["author"]};
  if (json.contains("at_s")) remark.at_s = json["at_s"].get<double>();
  return remark;
}

}  // namespace

Expected<void> check_remark(const RecordedRemark& remark, const std::string& number) {
  const auto wrong_text = [](const std::string& text, std::size_t longest) {
    return text.empty() || text.size() > longest || first_bad_utf8(text) ||
           std::ranges::any_of(text, is_control_in_lines);
  };
  if (wrong_text(remark.text, kLongestRemark)) {
    return fail(remark.text.size() > kLongestRemark ? ErrorCode::too_large : ErrorCode::invalid_value,
                fmt::format("this remark of {} bytes cannot be kept", remark.text.size()), "visit " + number,
                fmt::format("write 1 to {} bytes of text, without control characters", kLongestRemark));
  }
  if (wrong_text(remark.author, RemarkBook::kLongestAuthor))
    return fail(ErrorCode::invalid_value, "a remark needs its author", "visit " + number, "sign in");
  if (remark.at_s && !(*remark.at_s >= 0 && *remark.at_s <= kLatest_s))
    return fail(ErrorCode::invalid_value, "this is not a time of a visit", "visit " + number,
                "give seconds since the visit's beginning");
  return {};
}

Expected<Remarks> parse_remarks(std::string_view text) {
  const auto damaged = [] {
    return fail(ErrorCode::damaged, "this is not a file of remarks", {},
                "put the file back from a copy, or move it away: new remarks begin another one");
  };
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("remarks") || !json["remarks"].is_array()) return damaged();
  if (json["remarks"].size() > RemarkBook::kMost) return damaged();
  Remarks remarks;
  for (const Json& entry : json["remarks"]) {
    if (!entry.is_object() || !entry.contains("visit") || !entry["visit"].is_string()) return damaged();
    const std::string number = entry["visit"];
    const auto remark = remark_of(entry);
    if (!is_visit_number(number) || !remark || !check_remark(*remark, number)) return damaged();
    remarks[number].push_back(*remark);
  }
  return remarks;
}

Expected<RemarkBook> RemarkBook::open(std::filesystem::path file) {
  RemarkBook book(std::move(file));
  const auto bytes = read_whole(book.file_, kMostBookBytes);
  if (!bytes && bytes.error().code == ErrorCode::not_found) return book;
  if (!bytes) return tl::unexpected(bytes.error());
  auto remarks = parse_remarks(as_text(*bytes));
  if (!remarks) return tl::unexpected(remarks.error().in(book.file_.string()));
  book.remarks_ = std::move(*remarks);
  return book;
}

Expected<void> RemarkBook::keep(Remarks remarks) {
  const std::string text = written(remarks);
  if (auto kept = write_whole(file_, std::as_bytes(std::span(text)), WholeFile::durable); !kept) return kept;
  remarks_ = std::move(remarks);
  return {};
}

Expected<void> RemarkBook::add(const std::string& number, const RecordedRemark& remark) {
  if (auto fits = check_remark(remark, number); !fits) return fits;
  Remarks remarks = remarks_;
  remarks[number].push_back(remark);
  const bool of_one = remarks[number].size() > kMostOfVisit;
  if (of_one || count_of_all(remarks) > kMost) {
    return fail(ErrorCode::conflict,
                of_one ? "this visit has as many remarks as it can have" : "there are too many remarks",
                "visit " + number, "delete visits that are not needed any more: mechane visits forget");
  }
  return keep(std::move(remarks));
}

Expected<void> RemarkBook::keep_only(const std::set<std::string>& numbers) {
  Remarks remarks = remarks_;
  if (std::erase_if(remarks, [&](const auto& entry) { return !numbers.contains(entry.first); }) == 0) return {};
  return keep(std::move(remarks));
}

void RemarkBook::put_into(std::span<VisitRecord> records) const {
  for (VisitRecord& record : records) {
    const auto found = remarks_.find(record.number);
    if (found != remarks_.end())
      record.remarks.insert(record.remarks.end(), found->second.begin(), found->second.end());
  }
}

}  // namespace mechane::visits
