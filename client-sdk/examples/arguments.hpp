// The examples' command line: --kiosk NAME --seconds N --domain N.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

#include <mechane/client/client.hpp>

namespace mechane::example {

struct Arguments {
  client::ClientConfig config;
  double seconds = 5;
};

/// Reads the arguments; on a wrong one, prints the usage and ends the program.
inline Arguments read_arguments(int argc, char** argv, const char* program, client::Role role) {
  Arguments arguments;
  arguments.config.program = program;
  arguments.config.role = role;
  for (int i = 1; i < argc; i += 2) {
    const std::string name = argv[i];
    const char* value = i + 1 < argc ? argv[i + 1] : nullptr;
    if (value != nullptr && name == "--kiosk") {
      arguments.config.kiosk = value;
    } else if (value != nullptr && name == "--seconds") {
      arguments.seconds = std::atof(value);
    } else if (value != nullptr && name == "--domain") {
      arguments.config.domain = static_cast<std::uint32_t>(std::atoi(value));
    } else {
      std::fprintf(stderr, "%s [--kiosk NAME] [--seconds N] [--domain N]\n", argv[0]);
      std::exit(name == "--help" || name == "-h" ? 0 : 2);
    }
  }
  return arguments;
}

}  // namespace mechane::example
