// Finds and runs the other programs of Mechane, which lie beside this one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mechane::cli {

/// The folder of the running program.
[[nodiscard]] std::filesystem::path program_folder();

/// Becomes the program `name` (same process, so signals and systemd see it directly). Returns only when that failed, with the exit
/// status to give, after saying why on stderr.
[[nodiscard]] int become(const std::string& name, const std::vector<std::string>& arguments);

}  // namespace mechane::cli
