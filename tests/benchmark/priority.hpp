// The priority at which a benchmark and its peers run.
#pragma once

#include <sched.h>

namespace mechane::benchmark {

/// SCHED_FIFO for the calling thread and for those that it starts from now on; 0 asks for nothing. False where it was refused.
[[nodiscard]] inline bool take_priority(int priority) {
  const sched_param param{priority};
  return priority == 0 || ::sched_setscheduler(0, SCHED_FIFO, &param) == 0;
}

}  // namespace mechane::benchmark
