#include "client-sdk/studio/shelf/records.hpp"

#include <algorithm>
#include <array>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client-sdk/studio/edits/command.hpp"
#include "client-sdk/studio/edits/request_fields.hpp"
#include "client-sdk/studio/shelf/shelf_text.hpp"
#include "server/base/utf8.hpp"
#include "server/base/whole_file.hpp"

namespace mechane::studio {
namespace {

using RecordJson = nlohmann::json;

constexpr int kDeepestRecord = 6;
constexpr std::size_t kLongestDescription = 2'000, kLongestCredit = 500, kLongestTag = 60, kMostTags = 30,
                      kLongestPathText = 500;

class RecordFields : public RequestFields {
 public:
  using RequestFields::RequestFields;
  std::string text(const char* name, std::size_t longest) {
    const RecordJson* value = find(name);
    return value == nullptr ? std::string() : right_text(*value, name, longest);
  }
  std::vector<std::string> texts(const char* name, std::size_t longest) {
    std::vector<std::string> out;
    const RecordJson* list = find(name);
    if (list == nullptr) return out;
    if (!list->is_array() || list->size() > kMostTags)
      blame(name, fmt::format("a list of {} texts at most", kMostTags));
    for (std::size_t i = 0; right() && i < list->size(); ++i) {
      std::string one = right_text((*list)[i], fmt::format("{}/{}", name, i), longest);
      if (!one.empty() && std::ranges::find(out, one) == out.end()) out.push_back(std::move(one));
    }
    return out;
  }
  Record record() {
    Record out;
    out.description = text("description", kLongestDescription);
    out.credits.licence = text("licence", kLongestCredit);
    out.credits.author = text("author", kLongestCredit);
    out.credits.source = text("source", kLongestCredit);
    out.tags = texts("tags", kLongestTag);
    out.languages = texts("languages", 3);
    const auto is_code = [](const std::string& code) {
      return code.size() >= 2 && std::ranges::all_of(code, [](char c) { return c >= 'a' && c <= 'z'; });
    };
    if (!std::ranges::all_of(out.languages, is_code)) blame("languages", "codes of two or three letters a-z");
    std::ranges::sort(out.languages);
    return out;
  }

 private:
  std::string right_text(const RecordJson& value, std::string_view name, std::size_t longest) {
    if (value.is_string()) {
      const auto& text = value.get_ref<const std::string&>();
      const bool plain =
          !first_bad_utf8(text) && std::ranges::none_of(text, [](char c) { return is_control_in_lines(c); });
      if (plain && text.size() <= longest) return text;
    }
    blame(name, fmt::format("a text of at most {} bytes", longest));
    return {};
  }
};

tl::unexpected<Error> damaged_records(const std::string& where) {
  return fail(ErrorCode::damaged, "the records of the museum's files are damaged", where,
              "repair catalogue.json in the gateway's folder studio, or move it away: the descriptions, credits and "
              "tags of files are then lost");
}

}  // namespace

ShelfJson json_of(const Record& record) {
  return {{"description", record.description},
          {"licence", record.credits.licence},
          {"author", record.credits.author},
          {"source", record.credits.source},
          {"tags", record.tags},
          {"languages", record.languages}};
}

Expected<AboutRequest> parse_about(std::string_view text) {
  if (text.size() > kMostCommandBytes)
    return fail(ErrorCode::too_large, "this request is too long", "", "write less of the file");
  const RecordJson json = parse_shallow(text, kDeepestRecord);
  RecordFields fields(json, "");
  AboutRequest request;
  request.path = fields.text("path", kLongestPathText);
  if (!content::is_inside(request.path)) fields.blame("path", "the file's path, as the catalogue has it");
  if (!fields.has("about")) fields.blame("about", "an object {...}");
  if (!fields.right()) return fields.fault();
  RecordFields about(json["about"], "about");
  request.about = about.record();
  if (!about.right()) return about.fault();
  if (!fields.has("before")) return request;
  RecordFields before(json["before"], "before");
  request.before = before.record();
  if (!before.right()) return before.fault();
  return request;
}

Expected<RecordMap> parse_records(std::string_view text) {
  if (text.size() > Records::kMostBytes) return damaged_records("");
  const RecordJson json = parse_shallow(text, kDeepestRecord);
  const RecordJson* files = json.is_object() && json.contains("files") ? &json["files"] : nullptr;
  if (files == nullptr || !files->is_object()) return damaged_records("");
  RecordMap out;
  for (const auto& [path, value] : files->items()) {
    RecordFields fields(value, path);
    Record record = fields.record();
    if (!fields.right() || !content::is_inside(path) || path.size() > kLongestPathText) return damaged_records(path);
    out[path] = std::move(record);
  }
  return out;
}

std::string records_json(const RecordMap& records) {
  RecordJson files = RecordJson::object();
  for (const auto& [path, record] : records)
    files[path] = json_of(record);
  return RecordJson{{"files", std::move(files)}}.dump(1, ' ', false, RecordJson::error_handler_t::replace) + "\n";
}

Expected<RecordMap> Records::all() const {
  const auto bytes = read_whole(file_, kMostBytes);
  if (!bytes && bytes.error().code == ErrorCode::not_found) return RecordMap();
  if (!bytes) return tl::unexpected(bytes.error());
  return parse_records(as_text(*bytes));
}

Expected<void> Records::put(const RecordMap& records) const {
  const auto before = all();
  if (!before) return tl::unexpected(before.error());
  RecordMap after = *before;
  for (const auto& [path, record] : records) {
    after[path] = record;
    if (record == Record()) after.erase(path);
  }
  if (after == *before) return {};
  const std::string text = records_json(after);
  if (text.size() > kMostBytes)
    return fail(ErrorCode::too_large, "the records of the museum's files would have more than 8 MiB", "",
                "write less, or delete files that nothing uses");
  std::error_code error;
  std::filesystem::create_directories(file_.parent_path(), error);
  if (error) return tl::unexpected(file_error("cannot be made", file_.parent_path(), error.value()));
  return write_whole(file_, std::as_bytes(std::span(text)), WholeFile::durable);
}

}  // namespace mechane::studio
