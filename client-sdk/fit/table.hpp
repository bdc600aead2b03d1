// The summary of a fitted object as text, for a terminal of 100 columns.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "client-sdk/fit/summary.hpp"

namespace mechane::fit {

inline constexpr std::size_t kTableColumns = 100;

/// One row per part, totals, notes; every line ends with a newline, and no line of the table is wider than
/// kTableColumns.
[[nodiscard]] std::string summary_table(const Summary& summary);

/// Exactly `columns` characters of UTF-8 text: padded, or cut in the middle with an ellipsis; printable, as below.
[[nodiscard]] std::string fitted_text(std::string_view text, std::size_t columns);

/// Breaks text at spaces into lines of at most kTableColumns (a longer word gets a line of its own), with prefixes for
/// the first and the other lines; ends with a newline.
[[nodiscard]] std::string wrapped_text(std::string_view text, std::string_view first, std::string_view rest);

/// The text with '?' for control characters and for bytes that are not UTF-8.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace mechane::fit
