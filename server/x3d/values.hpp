// Reads X3D's field values from XML attributes, strictly: a malformed value is an error, and is never guessed at.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

namespace mechane::x3d {

/// Why a text is not a value ("'1e999' is not a finite number"), and what to write. Its ErrorCode is invalid_value.
struct BadValue {
  std::string what;
  std::string remedy;
};

template <class T>
using Value = tl::expected<T, BadValue>;

/// Words like "12,5": each is read as two numbers, because X3D also separates numbers by commas.
struct DecimalCommas {
  std::string first;  ///< the first such word, as written; empty if there are none
  std::size_t count = 0;
};
[[nodiscard]] DecimalCommas decimal_commas(std::string_view text);
/// Where decimal commas explain why there are more numbers than wanted: the fault, and what to write.
[[nodiscard]] std::optional<BadValue> comma_fault(const DecimalCommas& commas, std::size_t count, std::size_t wanted);

/// How to write texts that are not all in straight double quotes: attribute='"text" "text"'; "..." for a long or muddled text.
[[nodiscard]] std::string in_straight_quotes(std::string_view attribute, std::string_view text);

/// Numbers separated by blanks or commas, all finite.
[[nodiscard]] Value<std::vector<double>> parse_numbers(std::string_view text);
/// The same, whole numbers only.
[[nodiscard]] Value<std::vector<double>> parse_integers(std::string_view text);
[[nodiscard]] Value<std::vector<bool>> parse_booleans(std::string_view text);
/// Whether a url is a path relative to the file that holds it: a museum may have no network.
[[nodiscard]] bool is_relative_path(std::string_view url);
/// MFString: "one" "two", with \" and \\ inside.
[[nodiscard]] Value<std::vector<std::string>> parse_strings(std::string_view text);

}  // namespace mechane::x3d
