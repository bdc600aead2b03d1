// Where this program lies: its siblings and what was built for it are found from there.
#pragma once

#include <filesystem>

namespace mechane {

/// The folder of the running program, with links resolved; empty where the system does not tell it. Any thread.
[[nodiscard]] std::filesystem::path program_folder();

}  // namespace mechane
