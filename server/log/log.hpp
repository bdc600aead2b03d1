// The readable log: one line for each event, on stderr, with time and level. Any room may use it, but not in code that runs in a tick.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "server/base/error.hpp"

namespace mechane::log {

enum class Level { debug, info, warning, error };

/// Names the program in each line and sets the least level shown. Call once, in main, before other threads start.
void start(std::string_view program, Level least);

/// Thread-safe. The text is one line for a person. It may contain text from files and the network: see printable.hpp. A warning or error
/// that comes again is shown once a minute, with the number of repetitions.
void debug(std::string_view text);
void info(std::string_view text);
void warning(std::string_view text);
void error(std::string_view text);
void error(const Error& e);

/// What went wrong since start(): for a program's status.
struct Trouble {
  std::uint64_t count = 0;  ///< warnings and errors
  std::string last;         ///< the text of the newest one; empty where there was none
};
/// Thread-safe.
[[nodiscard]] Trouble trouble();

}  // namespace mechane::log
