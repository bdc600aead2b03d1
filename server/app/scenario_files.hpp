// From what a server was told to the files it reads: ids are found in the content catalogue, and files are held against it.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "server/base/error.hpp"

namespace mechane::app {

/// The scenario file of each name: a path stays as it is, an id that is not a path is looked up. With a catalogue,
/// what a scenario or a file
/// that it needs differs in is said in the log, and no error: the museum opens, and somebody looks. Reads those files whole. Errors: the
/// catalogue cannot be read; an id that it does not have.
[[nodiscard]] Expected<std::vector<std::filesystem::path>> find_scenarios(std::span<const std::filesystem::path> names,
                                                                          const std::filesystem::path& catalogue);

}  // namespace mechane::app
