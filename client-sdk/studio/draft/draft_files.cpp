#include "client-sdk/studio/draft/draft_files.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "server/base/whole_file.hpp"
#include "server/scenario/file_references.hpp"

namespace mechane::studio {
namespace {

namespace fs = std::filesystem;

struct FileKind {
  std::string_view ending;
  std::string_view begins;  ///< its first bytes; empty: these tell nothing
  bool sound = false;
};
constexpr std::array<FileKind, 8> kFileKinds{{{".glb", "glTF"},
                                              {".ply", "ply"},
                                              {".obj", ""},
                                              {".stl", ""},
                                              {".x3d", ""},
                                              {".ogg", "OggS", true},
                                              {".wav", "RIFF", true},
                                              {".flac", "fLaC", true}}};

const FileKind* kind_of(std::string_view name) {
  const auto found = std::ranges::find_if(kFileKinds, [&](const FileKind& kind) {
    return name.size() > kind.ending.size() && name.ends_with(kind.ending);
  });
  return found == kFileKinds.end() ? nullptr : &*found;
}

/// Names and sizes of what is_file_name() in a folder; links are left out.
std::map<std::string, std::uintmax_t> files_in(const fs::path& folder) {
  std::map<std::string, std::uintmax_t> out;
  std::error_code missing;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, missing)) {
    const std::string name = entry.path().filename().string();
    if (!is_file_name(name) || entry.is_symlink(missing) || !entry.is_regular_file(missing)) continue;
    if (const std::uintmax_t bytes = entry.file_size(missing); !missing) out[name] = bytes;
  }
  return out;
}

bool is_same(const fs::path& file, std::span<const std::byte> bytes) {
  const auto there = read_whole(file, DraftFiles::kMostBytes);
  return there && std::ranges::equal(*there, bytes);
}

/// Another file of this name is there already.
bool is_other(const fs::path& file, std::span<const std::byte> bytes) {
  std::error_code unknown;
  return fs::exists(fs::symlink_status(file, unknown)) && !is_same(file, bytes);
}

Expected<void> check_file(const std::string& name, std::span<const std::byte> bytes) {
  const FileKind* kind = is_file_name(name) ? kind_of(name) : nullptr;
  if (kind == nullptr)
    return fail(ErrorCode::invalid_value, fmt::format("'{}' cannot be a file's name here", name), "",
                "take letters a-z, digits, '-' and '_', and end in .glb, .obj, .stl, .ply, .x3d, .ogg, .wav or .flac");
  if (bytes.size() > DraftFiles::kMostBytes)
    return fail(ErrorCode::too_large, fmt::format("{} has more than 64 MiB", name), "", "make it smaller");
  if (bytes.empty() || !as_text(bytes).starts_with(kind->begins))
    return fail(ErrorCode::invalid_value, fmt::format("{} is not a {} file", name, kind->ending), "",
                "export it again, in the format that its name says");
  return {};
}

}  // namespace

bool is_exhibit_name(std::string_view name) {
  const auto plain = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
  return !name.empty() && name.size() <= 31 && name != kDiscarded && plain(name.front()) &&
         std::ranges::all_of(name, [&](char c) { return plain(c) || c == '-'; });
}

bool is_file_name(std::string_view name) {
  const auto plain = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); };
  const auto inner = [&](char c) { return plain(c) || c == '-' || c == '_' || c == '.'; };
  return !name.empty() && name.size() <= 64 && plain(name.front()) && std::ranges::all_of(name, inner) &&
         kind_of(name) != nullptr;
}

bool uses_file(const x3d::Document& document, const std::string& name) {
  const auto is_it = [&](const std::string& url) {
    const fs::path path = url.substr(0, url.find('#'));
    return is_own_path(path) && path.filename() == name;
  };
  return std::ranges::any_of(scenario::file_references(document), [&](const scenario::FileReference& reference) {
    return std::ranges::any_of(reference.urls, is_it);
  });
}

bool is_own_path(const fs::path& path) {
  return path.lexically_normal().parent_path() == kFilesFolder;
}

fs::path own_file(const fs::path& folder, const fs::path& url) {
  std::error_code unknown;
  const fs::path file = folder / url.lexically_normal();
  return is_own_path(url) && fs::is_regular_file(file, unknown) ? file : fs::path();
}

Expected<std::vector<std::string>> copy_used(const x3d::Document& document, const fs::path& from, const fs::path& to) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& [name, size] : files_in(from)) {
    if (!uses_file(document, name)) continue;
    names.push_back(name);
    const auto bytes = read_whole(from / name, DraftFiles::kMostBytes);
    if (!bytes) return tl::unexpected(bytes.error());
    if (is_same(to / name, *bytes)) continue;
    fs::create_directories(to, error);
    if (error) return tl::unexpected(file_error("cannot be made", to, error.value()));
    if (auto written = write_whole(to / name, *bytes, WholeFile::document); !written)
      return tl::unexpected(written.error());
  }
  return names;
}

DraftFiles::DraftFiles(const fs::path& draft_folder, const fs::path& exhibit_folder)
    : draft_(draft_folder / kFilesFolder), exhibit_(exhibit_folder / kFilesFolder) {}

std::vector<DraftFile> DraftFiles::names() const {
  const auto theirs = files_in(exhibit_);
  auto both = files_in(draft_);
  both.insert(theirs.begin(), theirs.end());
  std::vector<DraftFile> out;
  out.reserve(both.size());
  for (const auto& [name, bytes] : both)
    out.push_back({name, bytes, kind_of(name)->sound, theirs.contains(name)});
  return out;
}

std::vector<DraftFile> DraftFiles::all() const {
  std::vector<DraftFile> out = names();
  const auto mine = files_in(draft_);
  for (DraftFile& file : out) {
    if (!file.published || !mine.contains(file.name)) continue;
    const auto here = read_whole(draft_ / file.name, kMostBytes);
    file.published = here && is_same(exhibit_ / file.name, *here);
  }
  return out;
}

Expected<fs::path> DraftFiles::find(const std::string& name) const {
  for (const fs::path& folder : {draft_, exhibit_})
    if (files_in(folder).contains(name)) return folder / name;
  return fail(ErrorCode::not_found, "the draft has no such file", name, "take one of the list");
}

bool DraftFiles::has_other(const std::string& name, const fs::path& file) const {
  const auto bytes = read_whole(file, kMostBytes);
  return bytes && (is_other(draft_ / name, *bytes) || is_other(exhibit_ / name, *bytes));
}

Expected<void> DraftFiles::remove(const std::string& name) const {
  if (auto there = find(name); !there) return tl::unexpected(there.error());
  for (const fs::path& folder : {draft_, exhibit_}) {
    if (!files_in(folder).contains(name)) continue;
    std::error_code error;
    if (!fs::remove(folder / name, error) && error)
      return tl::unexpected(file_error("cannot be deleted", folder / name, error.value()));
    (void)flush_to_disk(folder);
  }
  return {};
}

Expected<void> DraftFiles::put(const std::string& name, std::span<const std::byte> bytes, bool replace) const {
  if (auto checked = check_file(name, bytes); !checked) return checked;
  if (!replace && (is_other(draft_ / name, bytes) || is_other(exhibit_ / name, bytes)))
    return fail(ErrorCode::conflict, fmt::format("there is another file {}", name), "",
                "give this one another name, or say that it replaces that one");
  auto mine = files_in(draft_);
  mine[name] = bytes.size();
  std::uintmax_t together = 0;
  for (const auto& [one, size] : mine)
    together += size;
  if (mine.size() > kMostFiles || together > kMostOfAll)
    return fail(ErrorCode::too_large, "the draft's files would be more than 200, or more than 512 MiB", "",
                "discard what is not used, or make them smaller");
  std::error_code error;
  fs::create_directories(draft_, error);
  if (error) return tl::unexpected(file_error("cannot be made", draft_, error.value()));
  return write_whole(draft_ / name, bytes, WholeFile::durable);
}

}  // namespace mechane::studio
