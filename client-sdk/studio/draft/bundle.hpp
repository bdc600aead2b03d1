// The files that a text names, brought together as files/NAME: for an archive, or for another draft.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "client-sdk/authoring/paths.hpp"
#include "client-sdk/studio/draft/archive.hpp"
#include "server/x3d/document.hpp"

namespace mechane::studio {

struct Bundle {
  std::string text;  ///< with the new paths
  std::vector<ArchiveSource> files;
};

struct BundleRules {
  /// Where the file of a relative path is; empty: it does not come along.
  std::function<std::filesystem::path(const std::string& path)> place_of;
  /// Whether that file can have this name.
  std::function<bool(const std::string& name, const std::filesystem::path& file)> is_free =
      [](const auto&, const auto&) { return true; };
  /// The new path of what does not come along.
  authoring::NewPath otherwise = [](const std::string& path) { return path; };
};

/// The name of a file among a draft's: its own, with other letters and a number where that is needed. Empty: a draft takes no such file.
[[nodiscard]] std::string free_file_name(const std::filesystem::path& file,
                                         const std::function<bool(const std::string& name)>& is_free);

/// A file that is named files/NAME keeps its name where that is free; another one gets its own, with other letters and a number where that
/// is needed. A file of a kind that a draft does not take stays behind.
[[nodiscard]] Bundle bundle(const x3d::Document& document, const BundleRules& rules);

}  // namespace mechane::studio
