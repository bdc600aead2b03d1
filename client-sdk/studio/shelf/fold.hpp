// Words as a search compares them.
#pragma once

#include <string>
#include <string_view>

namespace mechane::studio {

/// Small letters without accents, Latin and Greek, polytonic too; a sigma at the end is one like the others. Other characters stay. A
/// byte that is not valid UTF-8 becomes '?'. Folding a folded text changes nothing.
[[nodiscard]] std::string folded(std::string_view text);

}  // namespace mechane::studio
