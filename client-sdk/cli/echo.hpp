// `mechane echo TOPIC`: prints what goes over the wire.
#pragma once

#include <cstdint>
#include <string>

namespace mechane::cli {

struct EchoOptions {
  std::string topic;  ///< as in idl/mechane.idl; empty: the topics are listed
  std::string kiosk;  ///< only this kiosk, or for topics of a world only its world; empty: all
  std::string world;  ///< only this world; empty: all
  std::uint32_t domain = 0;
  std::uint64_t count = 0;  ///< stop after this many samples; 0: no limit
  double seconds = 0;       ///< stop after this time; 0: no limit
  bool json = false;        ///< one JSON object per line
};

/// Runs until count, seconds, or SIGINT. Returns the exit status: 0; 1 where the network cannot be joined
/// or nothing came in `seconds`; 2 for an unknown topic.
[[nodiscard]] int run_echo(const EchoOptions& options);

}  // namespace mechane::cli
