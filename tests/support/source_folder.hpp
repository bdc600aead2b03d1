// Where this checkout lies. In one small source that CMake writes (source_folder.cpp.in), and not in each test's command line: a compiler
// cache would take another clone's tests for other programs.
#pragma once

#include <filesystem>

namespace mechane::test {

[[nodiscard]] std::filesystem::path source_folder();

}  // namespace mechane::test
