// Files of the source tree that tests read.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/source_folder.hpp"

namespace mechane::test {

inline std::filesystem::path shipped_file() {
  return source_folder() / "scenarios/archimedes-screw/archimedes-screw.x3d";
}
/// The standard's schema and sample files lie beside the project; a clone alone does not have them.
inline std::filesystem::path shared_folder() {
  return source_folder().parent_path() / "shared";
}

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace mechane::test
