// Runs a helper program that is not trusted to end well, and collects what it writes.
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
  int code = 0;  ///< exit status or signal number; meaningless for the other two
  std::vector<std::byte> output;
};

/// Starts `program` in a process group of its own with standard input empty, standard output a pipe to us, standard error ours, no
/// other descriptor, default signals and ordinary scheduling; reads until it ends. After `wall_time`, or more than `most_output`
/// bytes, or when `stop` asks for it, the whole group is killed. Blocks; any thread. The Error is for a program that could not be started.
[[nodiscard]] Expected<ChildResult> run_child(const std::filesystem::path& program,
                                              const std::vector<std::string>& arguments,
                                              std::chrono::milliseconds wall_time, std::uint64_t most_output,
                                              const std::stop_token& stop = {});

}  // namespace mechane::content
