#include "client-sdk/studio/draft/bundle.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "client-sdk/studio/draft/draft_files.hpp"
#include "server/base/utf8.hpp"

namespace mechane::studio {
namespace {

namespace fs = std::filesystem;

/// Letters that a name here cannot have become '-'.
std::string plain_stem(const fs::path& file) {
  constexpr std::size_t kLongestStem = 50;
  std::string stem = file.stem().string().substr(0, kLongestStem);
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  std::ranges::replace_if(
      stem, [&](char c) { return !is_plain(c) && c != '-' && c != '_' && c != '.'; }, '-');
  stem.erase(stem.begin(), std::ranges::find_if(stem, is_plain));
  return stem.empty() ? "file" : stem;
}

class Names {
 public:
  explicit Names(const BundleRules& rules) : rules_(rules) {}

  /// Empty: the file stays behind.
  std::string name_of(const fs::path& file) {
    if (const auto known = names_.find(file); known != names_.end()) return known->second;
    std::string name = free_file_name(
        file, [&](const std::string& one) { return !taken_.contains(one) && rules_.is_free(one, file); });
    if (name.empty()) return {};
    taken_.insert(name);
    names_[file] = name;
    return name;
  }
  [[nodiscard]] std::vector<ArchiveSource> sources() const {
    std::vector<ArchiveSource> all;
    for (const auto& [file, name] : names_)
      all.push_back({name, file});
    return all;
  }

 private:
  const BundleRules& rules_;
  std::map<fs::path, std::string> names_;
  std::set<std::string> taken_;
};

}  // namespace

std::string free_file_name(const fs::path& file, const std::function<bool(const std::string&)>& is_free) {
  const std::string stem = plain_stem(file), ending = lower_case(file.extension().string());
  std::string name = is_file_name(file.filename().string()) ? file.filename().string() : stem + ending;
  if (!is_file_name(name)) return {};
  for (int number = 2; !is_free(name); ++number)
    name = fmt::format("{}-{}{}", stem, number, ending);
  return name;
}

Bundle bundle(const x3d::Document& document, const BundleRules& rules) {
  Names names(rules);
  const auto renamed = [&](const std::string& path) {
    const fs::path file = rules.place_of(path);
    const std::string name = file.empty() ? "" : names.name_of(file);
    return name.empty() ? rules.otherwise(path) : fmt::format("{}/{}", kFilesFolder, name);
  };
  authoring::TextEdits edits, ignored;
  // First those that have such a path: others must not take their names.
  authoring::replace_paths(
      document, [&](const std::string& path) { return is_own_path(path) ? renamed(path) : path; }, ignored);
  authoring::replace_paths(document, renamed, edits);
  return {edits.apply(document.source()), names.sources()};
}

}  // namespace mechane::studio
