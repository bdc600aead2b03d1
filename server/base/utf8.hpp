// Is a text UTF-8? Captions travel to displays, texts of strangers to the log: neither must see anything else.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace mechane {

/// How many bytes the character at the front takes; 0: it is not well-formed, or it is the byte 0, or the text is empty.
[[nodiscard]] std::size_t utf8_length(std::string_view text);

/// Whether a terminal may obey a well-formed character where it should show it: C0 with tab and line break, DEL, C1.
[[nodiscard]] bool is_control(std::string_view character);

/// Where the first byte stands that is not part of well-formed UTF-8 (RFC 3629: no overlong forms, no surrogates), or that is 0.
[[nodiscard]] std::optional<std::size_t> first_bad_utf8(std::string_view text);

}  // namespace mechane
