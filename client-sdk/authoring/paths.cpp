#include "client-sdk/authoring/paths.hpp"

#include <algorithm>
#include <vector>

#include "server/scenario/file_references.hpp"
#include "server/x3d/values.hpp"

namespace mechane::authoring {

void replace_paths(const x3d::Document& document, const NewPath& new_path, TextEdits& edits) {
  for (const scenario::FileReference& reference : scenario::file_references(document)) {
    std::vector<std::string> urls = reference.urls;
    for (std::string& url : urls) {
      if (!x3d::is_relative_path(url) || url.starts_with('#')) continue;
      // "model.glb#NODE" keeps what follows the '#'.
      const std::size_t hash = std::min(url.find('#'), url.size());
      url = new_path(url.substr(0, hash)) + url.substr(hash);
    }
    if (urls != reference.urls)
      set_attribute(document, reference.node, reference.attribute, quote_strings(urls), edits);
  }
}

std::string rebased_path(const std::string& path, const std::filesystem::path& from, const std::filesystem::path& to) {
  return (from / path).lexically_normal().lexically_relative(to).generic_string();
}

}  // namespace mechane::authoring
