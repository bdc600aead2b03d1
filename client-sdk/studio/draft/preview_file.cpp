#include "client-sdk/studio/draft/preview_file.hpp"

#include <span>
#include <system_error>

#include <fmt/format.h>

#include "client-sdk/studio/draft/draft_files.hpp"
#include "server/base/whole_file.hpp"

namespace mechane::studio {

namespace fs = std::filesystem;

Expected<fs::path> write_preview(const fs::path& folder, std::string_view text) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return tl::unexpected(file_error("cannot be made", folder, error.value()));
  fs::path file = folder / kPreviewFile;
  if (auto written = write_whole(file, std::as_bytes(std::span(text)), WholeFile::durable); !written)
    return tl::unexpected(written.error());
  return file;
}

std::string with_preview_files(std::string text, const std::vector<std::string>& names) {
  constexpr std::string_view kBefore = "'\"; ", kAfter = "'\"& #";
  for (const std::string& name : names) {
    const std::string url = fmt::format("{}/{}", kFilesFolder, name);
    for (std::size_t at = text.find(url, 1); at != std::string::npos; at = text.find(url, at + 1)) {
      const std::size_t end = at + url.size();
      const bool whole = kBefore.find(text[at - 1]) != std::string_view::npos && end < text.size() &&
                         kAfter.find(text[end]) != std::string_view::npos;
      if (whole) text.replace(at, kFilesFolder.size(), kPreviewFiles);
    }
  }
  return text;
}

void remove_preview(const fs::path& file) {
  std::error_code ignored;
  fs::remove_all(file.parent_path() / kPreviewFiles, ignored);
  if (fs::remove(file, ignored)) fs::remove(file.parent_path(), ignored);  // fails where something is in it
}

void remove_previews(const fs::path& scenarios) {
  std::error_code missing;
  for (const fs::directory_entry& entry : fs::directory_iterator(scenarios, missing))
    remove_preview(entry.path() / kPreviewFile);
}

}  // namespace mechane::studio
