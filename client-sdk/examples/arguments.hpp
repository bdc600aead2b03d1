// What the examples take on the command line: --kiosk NAME --seconds N --domain N.
#pragma once

#include <cstdlib>
#include <string>

#include <mechane/client/client.hpp>

namespace mechane::example {

struct Arguments {
  client::ClientConfig config;
  double seconds = 5;
};

inline Arguments read_arguments(int argc, char** argv, const char* program, client::Role role) {
  Arguments arguments;
  arguments.config.program = program;
  arguments.config.role = role;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string name = argv[i];
    if (name == "--kiosk") arguments.config.kiosk = argv[i + 1];
    if (name == "--seconds") arguments.seconds = std::atof(argv[i + 1]);
    if (name == "--domain") arguments.config.domain = static_cast<std::uint32_t>(std::atoi(argv[i + 1]));
  }
  return arguments;
}

}  // namespace mechane::example
