// Runs the other programs of Mechane, in the folder of this one.
#pragma once

#include <string>
#include <vector>

namespace mechane::cli {

/// Replaces this process by the program `name`, so that signals and systemd reach it directly. Returns only on failure,
/// with the exit status, after a message on stderr.
[[nodiscard]] int become(const std::string& name, const std::vector<std::string>& arguments);

}  // namespace mechane::cli
