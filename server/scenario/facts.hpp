// Facts about a scenario, for a catalogue: author, licence, languages, and the files that it needs.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "server/base/error.hpp"
#include "server/content/catalogue.hpp"

namespace mechane::scenario {

struct ScenarioFacts {
  std::string id;
  content::Credits credits;       ///< from the file's <meta>: license, creator, reference, version
  std::vector<std::string> tags;  ///< <meta name='keywords'>
  std::map<std::string, std::string> titles;
  std::vector<std::string> languages;
  /// Files it names, relative to its folder ("../models/screw.glb"), whether they exist or not; each with its language, "" for none.
  std::map<std::string, std::string> files;
  std::set<std::string> opens;                               ///< ids of the scenarios that its steps open
  std::map<std::string, std::vector<std::string>> wordings;  ///< as content::CatalogueEntry has them
};

/// Reads and compiles the file; builds nothing. Errors: the first error that `mechane check` reports.
[[nodiscard]] Expected<ScenarioFacts> read_facts(const std::filesystem::path& file);

}  // namespace mechane::scenario
