// How our child processes are started.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <spawn.h>

#include "server/base/error.hpp"

namespace mechane::content {

/// The attributes and file actions of posix_spawn for a child with a process group of its own, default signals, ordinary scheduling and no
/// other descriptor than these; freed with the object.
class SpawnPlan {
 public:
  /// Descriptors that the child gets as its own. Below 0: of `input` nothing comes, `errors` go where ours go.
  struct Streams {
    int input = -1;
    int output = -1;
    int errors = -1;
  };
  explicit SpawnPlan(const Streams& streams);
  ~SpawnPlan();
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;

  /// Starts the program, with our environment. Errors: failed_process.
  [[nodiscard]] Expected<pid_t> start(const std::filesystem::path& program,
                                      const std::vector<std::string>& arguments) const;

 private:
  posix_spawnattr_t attributes_{};
  posix_spawn_file_actions_t actions_{};
};

}  // namespace mechane::content
