// SIGINT and SIGTERM as something to wait for, and notifications to systemd.
#pragma once

#include <atomic>

namespace mechane::app {

/// While it lives, SIGINT and SIGTERM end wait() instead of the process. There may be one at a time, made on the main thread before other
/// threads start, so that all threads block the signals and only a signal descriptor receives them.
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

/// While it lives, SIGINT and SIGTERM end the process at once again, for slow work that may be interrupted. Main thread only; threads that
/// start meanwhile must end before it.
class StopAtOnce {
 public:
  StopAtOnce();
  ~StopAtOnce();
  StopAtOnce(const StopAtOnce&) = delete;
  StopAtOnce& operator=(const StopAtOnce&) = delete;
};

/// Notifies systemd where that has started the server (NOTIFY_SOCKET), else does nothing. `state`: "READY=1", for example.
void notify_systemd(const char* state);

}  // namespace mechane::app
