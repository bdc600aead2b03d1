// The priority of the calling thread.
#pragma once

#include <pthread.h>
#include <sched.h>

namespace mechane::realtime {

/// SCHED_FIFO for the calling thread, and for those that it starts from now on; 0 asks for nothing. False where it was refused.
inline bool take_fifo(int priority) noexcept {
  const sched_param param{priority};
  return priority == 0 || pthread_setschedparam(pthread_self(), SCHED_FIFO, &param) == 0;
}

/// The same from a callback on a thread that a library owns: asks at this thread's first call only.
inline void take_fifo_once(int priority) noexcept {
  thread_local bool asked = false;
  if (asked) return;
  asked = true;
  (void)take_fifo(priority);
}

}  // namespace mechane::realtime
