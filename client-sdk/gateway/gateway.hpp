// The gateway as a whole: what it is started with, and its life from start to end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "client-sdk/gateway/http/web_server.hpp"

namespace mechane::gateway {

struct GatewayOptions {
  WebServerOptions web;
  std::uint32_t domain = 0;
  std::filesystem::path app;          ///< folder of the built web app; empty: no pages are served
  std::filesystem::path state;        ///< accounts, certificate, audit log, remarks, orders; made where it is missing
  std::filesystem::path records;      ///< the server's; empty: no visits are shown
  std::filesystem::path exhibit_key;  ///< the server's, to change exhibits; empty: nobody here can
  std::filesystem::path scenarios;    ///< the server's exhibits, for playing back and the studio; empty: neither
  /// DDS domain of the first visit that is being prepared; the next one has the next.
  std::uint32_t playback_domain = 210;
  std::filesystem::path hand_model;  ///< given to pages for the camera hand; empty: no model
  std::string phones;  ///< http(s)://HOST(:PORT): native displays show a code that leads phones there; empty: none
  std::vector<std::string> kiosks{"kiosk-1"};
  bool plain = false;                         ///< beyond this machine without TLS, too
  std::string wake_to = "255.255.255.255:9";  ///< where packets go that wake kiosks
  Duration token_idle = std::chrono::minutes(30);
};

/// Serves until SIGINT or SIGTERM; prints the addresses of kiosks and console. Blocks. Errors: what keeps it from starting.
[[nodiscard]] Expected<void> run_gateway(GatewayOptions options);

}  // namespace mechane::gateway
