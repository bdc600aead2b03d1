// Finds the names of a scenario, and renames them everywhere: in DEF and USE, ROUTE, IMPORT and EXPORT, prototypes, and the metadata,
// where the schema says which keys hold names.
#pragma once

#include <map>
#include <set>
#include <string>

#include "client-sdk/authoring/text_edits.hpp"
#include "server/x3d/document.hpp"

namespace mechane::authoring {

/// Names by what they name. DEFs, agents and machines share one name space, because quantities and agents refer to all of them.
struct NamesOf {
  std::set<std::string> things;  ///< DEFs outside prototypes, imported names, agents, machines
  std::set<std::string> prototypes;
  std::set<std::string> exports;
  std::set<std::string> quantities;
  std::set<std::string> activities;
  std::set<std::string> steps;
  std::set<std::string> visits;
  std::set<std::string> effects;
};

[[nodiscard]] NamesOf names_of_file(const x3d::Document& document);

/// Old names to new ones.
struct Renames {
  std::map<std::string, std::string> things;
  std::map<std::string, std::string> prototypes;
  std::map<std::string, std::string> exports;
  std::map<std::string, std::string> quantities;
  std::map<std::string, std::string> activities;
  std::map<std::string, std::string> steps;
  std::map<std::string, std::string> visits;
  std::map<std::string, std::string> effects;

  [[nodiscard]] std::size_t count() const {
    return things.size() + prototypes.size() + exports.size() + quantities.size() + activities.size() + steps.size() +
           visits.size() + effects.size();
  }
};

/// For each name of `theirs` that `ours` has too: a new name with a number, NAME_2, NAME_3 ..., that neither has.
[[nodiscard]] Renames renames_for(const NamesOf& ours, const NamesOf& theirs);

/// Adds the edits that rename every name in a file by `renames`.
void rename_in(const x3d::Document& document, const Renames& renames, TextEdits& edits);

}  // namespace mechane::authoring
