// Is a text UTF-8? Captions travel to displays and over the wire, which must not see anything else.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace mechane::scenario {

/// Where the first byte stands that is not part of well-formed UTF-8 (RFC 3629: no overlong forms, no surrogates), or that is 0.
[[nodiscard]] std::optional<std::size_t> first_bad_utf8(std::string_view text);

}  // namespace mechane::scenario
