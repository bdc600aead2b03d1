#include "client-sdk/studio/draft/versions.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "server/base/whole_file.hpp"

namespace mechane::studio {
namespace {

namespace fs = std::filesystem;
using VersionJson = nlohmann::json;

constexpr std::uintmax_t kMostOfDescription = 4096;

std::optional<Version> read_version(const fs::path& file, std::int64_t number) {
  const auto bytes = read_whole(file, kMostOfDescription);
  if (!bytes) return std::nullopt;
  const VersionJson json = VersionJson::parse(as_text(*bytes), nullptr, false);
  const auto is_text = [&](const char* name) { return json.contains(name) && json[name].is_string(); };
  if (!json.is_object() || !is_text("title") || !is_text("by") || !json.contains("made_s") ||
      !json["made_s"].is_number_integer())
    return std::nullopt;
  return Version{number, json["title"], json["by"], json["made_s"].get<std::int64_t>()};
}

}  // namespace

fs::path Versions::file(std::int64_t number, const char* suffix) const {
  return folder_ / (std::to_string(number) + suffix);
}

std::vector<Version> Versions::all() const {
  std::vector<Version> out;
  std::error_code missing;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, missing)) {
    if (entry.path().extension() != ".json") continue;
    const std::string stem = entry.path().stem().string();
    std::int64_t number = 0;
    const auto read = std::from_chars(stem.data(), stem.data() + stem.size(), number);
    if (read.ec != std::errc() || read.ptr != stem.data() + stem.size()) continue;
    if (auto version = read_version(entry.path(), number)) out.push_back(std::move(*version));
  }
  std::ranges::sort(out, std::greater(), &Version::number);
  return out;
}

Expected<Version> Versions::add(const std::string& title, std::string_view text, const Author& author) const {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) return tl::unexpected(file_error("cannot be made", folder_, error.value()));
  const std::vector<Version> known = all();
  const Version version{known.empty() ? 1 : known.front().number + 1, title, author.name, author.time_s};
  const std::string description = VersionJson{{"title", title}, {"by", author.name}, {"made_s", author.time_s}}.dump(
      -1, ' ', false, VersionJson::error_handler_t::replace);
  // Its description makes it a version, so that one comes last.
  const auto bytes = [](std::string_view of) { return std::as_bytes(std::span(of)); };
  if (auto written = write_whole(file(version.number, ".x3d"), bytes(text), WholeFile::durable); !written)
    return tl::unexpected(written.error());
  if (auto written = write_whole(file(version.number, ".json"), bytes(description), WholeFile::durable); !written) {
    fs::remove(file(version.number, ".x3d"), error);
    return tl::unexpected(written.error());
  }
  for (std::size_t i = kMost - 1; i < known.size(); ++i) {
    fs::remove(file(known[i].number, ".json"), error);
    fs::remove(file(known[i].number, ".x3d"), error);
  }
  return version;
}

Expected<std::string> Versions::text(std::int64_t number) const {
  const auto bytes = read_whole(file(number, ".x3d"), Draft::kMostBytes);
  if (!bytes && bytes.error().code == ErrorCode::not_found)
    return fail(ErrorCode::not_found, fmt::format("there is no version {}", number), "", "take one of the list");
  if (!bytes) return tl::unexpected(bytes.error());
  return std::string(as_text(*bytes));
}

}  // namespace mechane::studio
