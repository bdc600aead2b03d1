// Words of a person or a file, inside a page or a drawing that we write.
#pragma once

#include <string>
#include <string_view>

namespace mechane {

/// Text as HTML and SVG show it letter by letter, between tags and within quotes of either kind: what would be markup is escaped. What XML may
/// not hold at all (control characters, broken UTF-8) is the caller's to take out. Any thread.
[[nodiscard]] std::string escape_markup(std::string_view text);

}  // namespace mechane
