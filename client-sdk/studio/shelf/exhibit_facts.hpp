// What the catalogue knows of an exhibit by its text alone.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "client-sdk/studio/shelf/records.hpp"
#include "server/state/description.hpp"
#include "server/x3d/document.hpp"

namespace mechane::studio {

/// A place where an exhibit names a file or another exhibit.
struct NamedPath {
  std::string path;   ///< in the museum: "models/screw.glb"; "odometer/odometer.x3d" for an exhibit that a step opens
  std::string place;  ///< "Inline WHEEL"
  int line = 0;
  std::string language;  ///< of a sound that says something; otherwise empty
};

struct ExhibitFacts {
  state::Texts title;  ///< in mechane:scenario
  Record about;        ///< from its <meta> elements, and the languages of mechane:scenario
  std::string names;   ///< its DEFs, with a blank between them
  std::vector<NamedPath> uses;
};

/// `name`: the exhibit's, whose folder its urls are relative to.
[[nodiscard]] ExhibitFacts exhibit_facts(const x3d::Document& document, const std::string& name);

/// Where a url of an exhibit leads, from the museum's folder: "../models/a.glb#wheel" of "odometer" to "models/a.glb". Empty: elsewhere.
[[nodiscard]] std::string museum_path(const std::string& exhibit, std::string_view url);

}  // namespace mechane::studio
