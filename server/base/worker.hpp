// One thread that does its jobs in order: takes slow work (files, imports) off threads that must not block.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <type_traits>
#include <utility>

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
  /// The same for a job with a result, which comes with the future. Dropping the future does not wait for the job.
  template <class Job>
  [[nodiscard]] auto ask(Job job) -> std::future<std::invoke_result_t<Job&>> {
    const auto task = std::make_shared<std::packaged_task<std::invoke_result_t<Job&>()>>(std::move(job));
    auto result = task->get_future();
    give([task] { (*task)(); });
    return result;
  }
  /// Any thread but the worker's own: waits until at most `jobs` are left, including the running one.
  void wait_until_left(std::size_t jobs);

 private:
  void run();

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::deque<std::function<void()>> jobs_;  // the first one is running
  bool stop_ = false;
  std::thread thread_;  // last
};

/// Whether the result is there, so that get() does not block.
template <class Result>
[[nodiscard]] bool is_ready(const std::future<Result>& result) {
  return result.valid() && result.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace mechane
