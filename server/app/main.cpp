// mechane-server.
#include <cstdio>
#include <string>

#include "server/app/server.hpp"
#include "server/app/settings.hpp"
#include "server/app/signals.hpp"
#include "server/log/log.hpp"

int main(int argc, char** argv) {
  using namespace mechane;
  std::string help;
  const auto settings = app::read_settings(argc, argv, help);
  if (!help.empty()) {
    std::fputs(help.c_str(), stdout);
    return 0;
  }
  log::start("server", settings && settings->verbose ? log::Level::debug : log::Level::info);
  if (!settings) {
    log::error(settings.error());
    return 2;
  }
  app::StopSignals signals;
  auto server = app::Server::start(*settings);
  if (!server) {
    log::error(server.error());
    return 1;
  }
  return (*server)->run(signals);
}
