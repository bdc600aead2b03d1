// SIGINT and SIGTERM as something to poll, and the word to systemd.
#pragma once

#include <atomic>

namespace mechane::app {

/// While it lives, SIGINT and SIGTERM ask for a stop instead of ending the process. One at a time, made on the main thread before
/// other threads start, so that they inherit the blocked signals and only a signal descriptor sees them.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// Waits up to `milliseconds` for a signal. True once one has come.
  [[nodiscard]] bool wait(int milliseconds);

 private:
  int descriptor_ = -1;
  bool stopping_ = false;
};

/// While it lives, SIGINT and SIGTERM end the process at once again: for slow work that may be thrown away. Main thread; threads that
/// start meanwhile must end before it does.
class StopAtOnce {
 public:
  StopAtOnce();
  ~StopAtOnce();
  StopAtOnce(const StopAtOnce&) = delete;
  StopAtOnce& operator=(const StopAtOnce&) = delete;
};

/// Tells systemd, where it listens (NOTIFY_SOCKET); otherwise does nothing. `state` is e.g. "READY=1".
void notify_systemd(const char* state);

}  // namespace mechane::app
