// A program's command line, read with CLI11; what is wrong with it is told with its remedy.
#pragma once

#include <optional>

#include "server/base/error.hpp"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace mechane {

/// What is wrong with the command line of `app`, whose name is what people type: "mechane display".
[[nodiscard]] Error command_line_error(const CLI::App& app, const CLI::ParseError& fault);

/// Reads the command line into what the options of `app` name. The exit status where the program is to end: 0 after --help and
/// --version, 2 after a wrong argument, which is then told on stderr.
[[nodiscard]] std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv);

}  // namespace mechane
