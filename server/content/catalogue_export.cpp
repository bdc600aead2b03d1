#include "server/content/catalogue_export.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <set>

#include <fcntl.h>
#include <fmt/format.h>

#include "server/base/whole_file.hpp"
#include "server/content/content_command.hpp"
#include "server/content/content_hash.hpp"

namespace mechane::content {
namespace {

namespace fs = std::filesystem;

/// A folder with a random name that is deleted at the end unless it is kept.
class DraftFolder {
 public:
  explicit DraftFolder(const fs::path& beside) : path_(beside.string() + ".XXXXXX") {
    if (mkdtemp(path_.data()) == nullptr) path_.clear();
  }
  DraftFolder(const DraftFolder&) = delete;
  DraftFolder& operator=(const DraftFolder&) = delete;
  ~DraftFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  [[nodiscard]] bool made() const { return !path_.empty(); }
  [[nodiscard]] fs::path path() const { return path_; }
  void keep() { path_.clear(); }

 private:
  std::string path_;
};

Expected<void> copy_one(const Catalogue& catalogue, const CatalogueEntry& entry, const fs::path& to) {
  const fs::path from = catalogue.folder() / entry.path;
  const std::string verify = content_command(catalogue.file(), "verify");
  std::error_code code, ignored;
  fs::create_directories(to.parent_path(), code);
  if (!code) fs::copy_file(from, to, code);
  if (code) {
    const bool there = fs::exists(from, ignored);
    return fail(there ? ErrorCode::io_failure : ErrorCode::not_found, "cannot be copied: " + code.message(), entry.path,
                there ? "check the disk and its space" : verify + " shows what is wrong");
  }
  const Expected<std::string> hash = content_hash(to);
  if (!hash) return tl::unexpected(hash.error());
  if (*hash != entry.hash) {
    return fail(ErrorCode::conflict, "the file has changed since it was added to the catalogue", entry.path,
                verify + " shows how; then restore the file, or add it again");
  }
  fs::permissions(to, fs::perms::owner_write | fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read,
                  code);
  (void)flush_to_disk(to);  // a kiosk that loses power after an export still has the export
  return {};
}

/// An export in the catalogue's own folder would be taken for content, or would replace it.
Expected<void> check_apart(const fs::path& folder, const fs::path& to) {
  std::error_code code;
  const fs::path inside = fs::weakly_canonical(to, code).lexically_relative(folder);
  if (code || inside.empty() || *inside.begin() == "..") return {};
  return fail(ErrorCode::conflict,
              inside == "." ? "this is the catalogue's own folder" : "this is in the catalogue's own folder",
              to.string(), "name a folder outside " + folder.string());
}

/// Only an older export, or an empty folder, may be replaced. Returns whether there is one.
Expected<bool> may_replace(const fs::path& to) {
  std::error_code code;
  if (!fs::exists(fs::symlink_status(to, code))) return false;
  if (!fs::is_directory(fs::symlink_status(to, code)))
    return fail(ErrorCode::conflict, "a file of this name exists", to.string(), "name another folder");
  if (fs::is_empty(to, code)) return true;
  const auto other = [&](const std::string& what) {
    return fail(ErrorCode::conflict, fmt::format("the folder contains {}", what), to.string(),
                "name an empty folder, or the folder of an older export");
  };
  const auto old = Catalogue::open(to / kCatalogueFileName, Catalogue::Access::read);
  if (!old) return other("something other than an older export");
  const auto entries = old->entries();
  if (!entries) return tl::unexpected(entries.error());
  std::set<std::string> known{kCatalogueFileName};
  for (const CatalogueEntry& entry : *entries)
    known.insert(entry.path);
  fs::recursive_directory_iterator at(to, code);
  for (const fs::recursive_directory_iterator end; !code && at != end; at.increment(code)) {
    const std::string path = at->path().lexically_relative(to).generic_string();
    const fs::file_status status = at->symlink_status(code);
    if (!fs::is_directory(status) && !(fs::is_regular_file(status) && known.contains(path)))
      return other(path + ", which no export has put there");
  }
  if (code) return fail(ErrorCode::io_failure, code.message(), to.string(), "check its rights");
  return true;
}

/// Gives the draft its final name. An older export gets the draft's name, and is deleted with it.
Expected<void> take_name(DraftFolder& draft, const fs::path& to, bool replace) {
  const unsigned flags = replace ? RENAME_EXCHANGE : RENAME_NOREPLACE;
  if (renameat2(AT_FDCWD, draft.path().c_str(), AT_FDCWD, to.c_str(), flags) == 0) {
    if (!replace) draft.keep();
    (void)flush_to_disk(to.parent_path());
    return {};
  }
  return fail(ErrorCode::io_failure, fmt::format("the folder cannot be given its name: {}", std::strerror(errno)),
              to.string(), "remove it, or name another folder");
}

}  // namespace

Expected<Exported> export_content(const Catalogue& catalogue, std::span<const CatalogueEntry> entries,
                                  const fs::path& folder) {
  std::error_code code;
  fs::path to = fs::absolute(folder, code).lexically_normal();
  if (to.filename().empty()) to = to.parent_path();
  if (auto ok = check_apart(catalogue.folder(), to); !ok) return tl::unexpected(ok.error());
  Expected<bool> replace = may_replace(to);
  if (!replace) return tl::unexpected(replace.error());
  fs::create_directories(to.parent_path(), code);
  DraftFolder draft(to);
  if (!draft.made()) {
    return fail(ErrorCode::io_failure, fmt::format("the folder cannot be made: {}", std::strerror(errno)), to.string(),
                "check the rights of the folder around it");
  }
  fs::permissions(draft.path(),
                  fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec | fs::perms::others_read |
                      fs::perms::others_exec,
                  code);
  Exported exported{.replaced = *replace};
  for (const CatalogueEntry& entry : entries) {
    if (auto ok = copy_one(catalogue, entry, draft.path() / entry.path); !ok) return tl::unexpected(ok.error());
    ++exported.files;
    exported.bytes += entry.bytes;
  }
  {
    auto copy = Catalogue::open(draft.path() / kCatalogueFileName, Catalogue::Access::write);
    if (!copy) return tl::unexpected(copy.error());
    if (auto ok = copy->put(entries); !ok) return tl::unexpected(ok.error());
  }
  if (auto ok = take_name(draft, to, *replace); !ok) return tl::unexpected(ok.error());
  return exported;
}

}  // namespace mechane::content
