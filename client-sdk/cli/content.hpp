// `mechane content`: the catalogue of a museum's files, for people.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "server/content/catalogue.hpp"
#include "server/content/content_command.hpp"

namespace mechane::cli {

struct ContentOptions {
  std::filesystem::path catalogue = content::kDefaultCatalogue;
  std::vector<std::string> words;      ///< add: files and folders; the others: names, paths or hashes
  std::string folder;                  ///< export: the destination
  content::Credits credits;            ///< add: overrides what the file says; empty: not given
  std::vector<std::string> tags;       ///< add: in addition to the existing ones
  std::vector<std::string> languages;  ///< add: in place of the existing ones
  std::string kind;                    ///< list: only this kind
  std::string tag;
  std::string language;
  bool json = false;
};

/// The body of `mechane content VERB`: add, list, show, verify, remove or export. Returns the exit status: 0; 1 if
/// something is wrong with content or catalogue, with a line and a remedy for each fault; 2 for an unknown kind. Any
/// thread; no network.
[[nodiscard]] int run_content(std::string_view verb, const ContentOptions& options, std::ostream& out,
                              std::ostream& errors);

}  // namespace mechane::cli
