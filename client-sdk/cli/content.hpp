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
  std::string folder;                  ///< export: where to
  content::Credits credits;            ///< add: wins over what a file says; empty: nothing was said
  std::vector<std::string> tags;       ///< add: beside those that are there
  std::vector<std::string> languages;  ///< add: instead of those that are there
  std::string kind;                    ///< list: only these
  std::string tag;
  std::string language;
  bool json = false;
};

/// The body of `mechane content VERB`: add, list, show, verify, remove or export. Returns the exit status: 0; 1 where something is wrong
/// with content or catalogue, each said in a line with its remedy; 2 for an unknown kind. Any thread; no network.
[[nodiscard]] int run_content(std::string_view verb, const ContentOptions& options, std::ostream& out,
                              std::ostream& errors);

}  // namespace mechane::cli
