// The readable log: one line an event, on stderr, with time and level. Used outside the loop only; a leaf that any room may use
// in code that does not run in a tick.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "server/base/error.hpp"

namespace mechane::log {

enum class Level { debug, info, warning, error };

/// Names the program in each line and sets the least level shown. Call once, in main, before other threads start.
void start(std::string_view program, Level least);

/// Thread-safe. The text is one line for a person; build it with fmt::format where it has values. Words of strangers may be in it: see
/// printable.hpp. Of equal warnings and errors one a minute is shown, and how many more there were.
void debug(std::string_view text);
void info(std::string_view text);
void warning(std::string_view text);
void error(std::string_view text);
void error(const Error& e);

/// What went wrong since start(): for a status that others see.
struct Trouble {
  std::uint64_t count = 0;  ///< warnings and errors
  std::string last;         ///< the newest one's text; empty: there was none
};
/// Thread-safe.
[[nodiscard]] Trouble trouble();

}  // namespace mechane::log
