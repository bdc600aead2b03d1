// What the tests of this folder share: what they expect of an Error, and which exhibits there are.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "server/base/error.hpp"
#include "tests/support/source_folder.hpp"

namespace mechane::studio {

/// Of that code, on any line, with a remedy and with these words in it.
inline testing::Matcher<const Error&> is_fault(ErrorCode code, const std::vector<std::string>& words = {}) {
  return testing::Truly([=](const Error& error) {
    return error.code == code && !error.remedy.empty() && std::ranges::all_of(words, [&](const std::string& word) {
             return error.to_string().find(word) != std::string::npos;
           });
  });
}

/// In alphabetical order.
inline std::vector<std::string> shipped_exhibits() {
  std::vector<std::string> names;
  for (const auto& folder : std::filesystem::directory_iterator(test::source_folder() / "scenarios")) {
    const std::string name = folder.path().filename().string();
    if (std::filesystem::exists(folder.path() / (name + ".x3d"))) names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace mechane::studio
