// RequestQueue: requests from staff, on their way from the network's thread to the one that answers them.
#pragma once

#include <cstddef>
#include <deque>
#include <iterator>
#include <mutex>
#include <utility>
#include <vector>

namespace mechane::client {

/// Any thread. At most `Most` are kept; the oldest are dropped.
template <class Request, std::size_t Most>
class RequestQueue {
 public:
  void push(Request request) {
    const std::lock_guard lock(mutex_);
    requests_.push_back(std::move(request));
    if (requests_.size() > Most) requests_.pop_front();
  }
  /// All that came since the last call, oldest first.
  [[nodiscard]] std::vector<Request> take() {
    const std::lock_guard lock(mutex_);
    std::vector<Request> all(std::make_move_iterator(requests_.begin()), std::make_move_iterator(requests_.end()));
    requests_.clear();
    return all;
  }

 private:
  std::mutex mutex_;
  std::deque<Request> requests_;
};

}  // namespace mechane::client
