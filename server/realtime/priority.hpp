// The priority of the calling thread, and the processor that it runs on.
#pragma once

#include <cstddef>

#include <pthread.h>
#include <sched.h>

namespace mechane::realtime {

/// SCHED_FIFO for the calling thread, and for those that it starts from now on; 0 asks for nothing. False where it was refused.
inline bool take_fifo(int priority) noexcept {
  const sched_param param{priority};
  return priority == 0 || pthread_setschedparam(pthread_self(), SCHED_FIFO, &param) == 0;
}

/// The same for a callback on a thread that a library owns: only this thread's first call asks.
inline void take_fifo_once(int priority) noexcept {
  thread_local bool asked = false;
  if (asked) return;
  asked = true;
  (void)take_fifo(priority);
}

/// Keeps the calling thread on one processor, 0 .. CPU_SETSIZE - 1. False where it was refused.
inline bool pin_to(int cpu) noexcept {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(cpu), &set);
  return pthread_setaffinity_np(pthread_self(), sizeof set, &set) == 0;
}

}  // namespace mechane::realtime
