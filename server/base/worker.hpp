// One thread that does the jobs it is given, in order: for work that a thread which must not wait hands over (files, imports).
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace mechane {

/// Owns a thread. Never for a loop thread of the server: it locks and allocates.
class Worker {
 public:
  /// `name`: as `top -H` shows it; the first 15 bytes count.
  explicit Worker(const char* name);
  /// Waits until all jobs are done.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Any thread: queues a job, which must not throw, and returns at once.
  void give(std::function<void()> job);
  /// Any thread but the worker's own: waits until at most `jobs` are left, the one that runs included.
  void wait_until_left(std::size_t jobs);

 private:
  void run();

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::deque<std::function<void()>> jobs_;  // the first one runs
  bool stop_ = false;
  std::thread thread_;  // last
};

}  // namespace mechane
