// Runs a helper program that may crash or hang, and collects what it writes.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "server/base/error.hpp"

namespace mechane::content {

/// How a child ended, and all that it wrote to its standard output.
struct ChildResult {
  enum class End { exited, signalled, timed_out, too_long };
  End end = End::exited;
  int code = 0;  ///< exited: the status; signalled: the signal's number; else meaningless
  std::vector<std::byte> output;
};

/// Starts `program` in a process group of its own with standard input empty, standard output a pipe to us, standard error ours, no
/// other descriptor, default signals and ordinary scheduling; reads until it ends. After `wall_time`, or more than `most_output`
/// bytes, or when `stop` asks for it, the whole group is killed. Blocks; any thread. Errors: failed_process, where the program could not
/// be started.
[[nodiscard]] Expected<ChildResult> run_child(const std::filesystem::path& program,
                                              const std::vector<std::string>& arguments,
                                              std::chrono::milliseconds wall_time, std::uint64_t most_output,
                                              const std::stop_token& stop = {});

}  // namespace mechane::content
