// Texts of a person or a file, inside a page, a drawing or an address that we write.
#pragma once

#include <string>
#include <string_view>

namespace mechane {

/// Escapes a text so that HTML and SVG show it letter by letter, between tags and within quotes of either kind. The caller removes what
/// XML may not hold at all (control characters, broken UTF-8). Any thread.
[[nodiscard]] std::string escape_markup(std::string_view text);

/// Escapes a text so that it is a part of a URI: %XX for all bytes but letters, digits, "-._~" (RFC 3986, 2.3) and
/// those of `kept`. Any thread.
[[nodiscard]] std::string escape_percent(std::string_view text, std::string_view kept = "");

}  // namespace mechane
