// Makes a message safe for terminals and files, wherever its words come from.
#pragma once

#include <string>
#include <string_view>

namespace mechane::log {

/// Control characters (C0, C1 and DEL) and bytes that are not UTF-8 are shown as "\x1b". Line breaks stay, and the lines after them are
/// indented, so that no text can look like a message of its own. Tabs stay.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace mechane::log
