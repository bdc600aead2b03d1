// A message as a terminal and a file may have it, whoever's words are in it.
#pragma once

#include <string>
#include <string_view>

namespace mechane::log {

/// Control characters (of C0 and C1, and DEL) and bytes that are not UTF-8 are shown as "\x1b". A line break stays, and what follows it
/// is indented: no text can pretend to be a message of its own. Tabs stay.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace mechane::log
