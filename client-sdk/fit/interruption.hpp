// On Ctrl-C, the program ends at once, whatever it is computing, and leaves no incomplete file.
#pragma once

#include <filesystem>
#include <mutex>
#include <set>
#include <thread>

namespace mechane::fit {

/// Owns a thread that waits for SIGINT, SIGTERM and SIGHUP. On one of these it removes the drafts, writes a newline to
/// stderr if that is a terminal, and ends the process with status 128 + signal (130 for Ctrl-C). Construct it in main
/// before any other thread, so that all threads inherit the blocked signals. See output_file.hpp.
class Interruption {
 public:
  Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();

  /// Drafts that are removed when the program is interrupted. Any thread.
  void add_draft(const std::filesystem::path& file);
  void remove_draft(const std::filesystem::path& file);

 private:
  void wait();

  std::mutex mutex_;  // guards drafts_
  std::set<std::filesystem::path> drafts_;
  std::thread thread_;
};

}  // namespace mechane::fit
