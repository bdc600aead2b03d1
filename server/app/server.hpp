// The server: puts transport, records, loops and lobby together and runs them.
#pragma once

#include <memory>

#include "server/app/settings.hpp"
#include "server/app/signals.hpp"
#include "server/base/error.hpp"

namespace mechane::app {

/// Everything of one server process. Main thread only.
class Server {
 public:
  /// Reads the scenarios, builds missing collision parts, opens the network and starts the loops. Errors: the first one of these steps.
  [[nodiscard]] static Expected<std::unique_ptr<Server>> start(const Settings& settings);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Runs until a signal or the end of `run_for_s`. Returns the exit status.
  [[nodiscard]] int run(StopSignals& signals);

 private:
  class Impl;
  explicit Server(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace mechane::app
