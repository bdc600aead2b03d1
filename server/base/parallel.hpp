// Work that splits into independent pieces, for start-up and offline tools. Never for a loop thread.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace mechane {

/// Calls body(0) to body(count - 1), each once and in any order, from as many threads as the machine has, and waits for all. The
/// pieces must not touch each other's results nor depend on the order. The body must not throw.
template <class Body>
void for_each_index(std::size_t count, const Body& body) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next.fetch_add(1); i < count; i = next.fetch_add(1))
      body(i);
  };
  const std::size_t threads = std::min<std::size_t>(count, std::max(1U, std::thread::hardware_concurrency()));
  std::vector<std::jthread> helpers;
  for (std::size_t i = 1; i < threads; ++i)
    helpers.emplace_back(work);
  work();
}

}  // namespace mechane
