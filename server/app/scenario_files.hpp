// Finds the scenario files that a server reads: looks up ids in the content catalogue, and compares files with it.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "server/base/error.hpp"

namespace mechane::app {

/// The scenario file of each name: a path stays as it is, an id that is not a path is looked up in the catalogue. A scenario, or a file
/// that it needs, which is not as the catalogue says is logged and no error: the museum can open. Reads those files whole. Errors:
/// unknown_name and duplicate (an id), and those of a catalogue that cannot be read.
[[nodiscard]] Expected<std::vector<std::filesystem::path>> find_scenarios(std::span<const std::filesystem::path> names,
                                                                          const std::filesystem::path& catalogue);

}  // namespace mechane::app
