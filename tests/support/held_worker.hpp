// A worker that does nothing until it is let go: files that take as long to read as a test likes.
#pragma once

#include <future>
#include <utility>

#include "server/base/worker.hpp"

namespace mechane::test {

class HeldWorker {
 public:
  HeldWorker() {
    worker_.give([gate = gate_.get_future().share()] { gate.wait(); });
  }
  HeldWorker(const HeldWorker&) = delete;
  HeldWorker& operator=(const HeldWorker&) = delete;
  ~HeldWorker() { let_go(); }

  [[nodiscard]] Worker* get() { return &worker_; }
  void let_go() {
    if (!std::exchange(open_, true)) gate_.set_value();
  }
  /// Until everything is done that it was given.
  void let_go_and_wait() {
    let_go();
    worker_.wait_until_left(0);
  }

 private:
  std::promise<void> gate_;
  bool open_ = false;
  Worker worker_{"held"};
};

}  // namespace mechane::test
