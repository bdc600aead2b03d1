// A program of a preview, its server or a scripted visitor: a child process that is given orders, and whose words are kept.
#pragma once

#include <atomic>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <sys/types.h>

#include "server/base/error.hpp"

namespace mechane::gateway {

/// Made, ordered and ended by one thread. A thread of its own hears what the child says, and waits for its end.
class PreviewProcess {
 public:
  static constexpr std::size_t kLinesKept = 20;
  static constexpr std::size_t kLongestLine = 500;  ///< bytes; the rest of a longer one is left out
  static constexpr int kNice = 5;                   ///< the museum's own server goes first

  /// Starts `program`. Errors: failed_process. `ended` is called once, on the other thread, when the child has ended; not after the
  /// destructor has returned.
  [[nodiscard]] static Expected<std::unique_ptr<PreviewProcess>> start(const std::filesystem::path& program,
                                                                       const std::vector<std::string>& arguments,
                                                                       std::function<void()> ended,
                                                                       std::size_t lines_kept = kLinesKept);
  /// Ends the child, and waits until it has ended.
  ~PreviewProcess();
  PreviewProcess(const PreviewProcess&) = delete;
  PreviewProcess& operator=(const PreviewProcess&) = delete;

  /// A line to its standard input. False: it does not read, or has ended.
  [[nodiscard]] bool order(const std::string& line);
  /// Asks it to end; it is killed where it has not after five seconds.
  void end();
  /// Whether it has ended.
  [[nodiscard]] bool over() const { return over_.load(std::memory_order_acquire); }
  /// The last lines that it said on standard output and standard error.
  [[nodiscard]] std::vector<std::string> said() const;

 private:
  PreviewProcess(pid_t child, int orders, int words, int handle, std::size_t lines_kept, std::function<void()> ended);
  void hear();
  void take(const char* bytes, std::size_t size);

  const pid_t child_;
  const int orders_;  // a socket
  const int words_;
  const int handle_;  // of the child; readable when it has ended
  const std::size_t lines_kept_;
  const std::function<void()> ended_;
  std::atomic<bool> ending_{false};
  std::atomic<bool> over_{false};
  mutable std::mutex mutex_;                      // guards what follows
  std::deque<std::string> lines_{std::string()};  // the last one is not whole yet
  std::thread thread_;                            // last
};

}  // namespace mechane::gateway
