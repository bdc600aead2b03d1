// What is shipped, for tests of every exhibit, and when a visit to one has come to its end.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/exhibit_play.hpp"
#include "tests/support/source_folder.hpp"

namespace mechane::test {

inline std::vector<std::string> shipped_exhibits() {
  namespace fs = std::filesystem;
  std::vector<std::string> names;
  for (const fs::directory_entry& folder : fs::directory_iterator(source_folder() / "scenarios")) {
    const std::string name = folder.path().filename().string();
    if (fs::exists(folder.path() / (name + ".x3d"))) names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

/// Through with its activity, or at a step that sends the visitor on.
inline bool arrived(const PlayedVisit& visit, const state::WorldDescription& world) {
  return visit.done || std::ranges::any_of(visit.steps, [&](const PlayedStep& step) {
           return !world.steps[world.find_step(step.name).index()].opens.empty();
         });
}

/// For the name of a parameterised test.
inline std::string test_name(std::string name) {
  std::ranges::replace(name, '-', '_');
  return name;
}

}  // namespace mechane::test
