// X3D's field values in XML attributes, strictly: what is not a value is named, not guessed at.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

namespace mechane::x3d {

/// What a value cannot be: "'1e999' is not a finite number".
struct BadValue {
  std::string what;
  std::string remedy;
};

template <class T>
using Value = tl::expected<T, BadValue>;

/// Words like "12,5", which are read as two numbers each: X3D separates numbers by commas too.
struct DecimalCommas {
  std::string first;  ///< the first such word, as written; empty if there are none
  std::size_t count = 0;
};
[[nodiscard]] DecimalCommas decimal_commas(std::string_view text);
/// Why there are more numbers than wanted, and what to write: where commas that were meant as decimal points make the difference.
[[nodiscard]] std::optional<BadValue> comma_fault(const DecimalCommas& commas, std::size_t count, std::size_t wanted);

/// What to write for a text that is not in straight double quotes: attribute='"text"', without the curly quotes that it may have.
[[nodiscard]] std::string in_straight_quotes(std::string_view attribute, std::string_view text);

/// Numbers apart by blanks or commas, all finite.
[[nodiscard]] Value<std::vector<double>> parse_numbers(std::string_view text);
/// The same, whole numbers only.
[[nodiscard]] Value<std::vector<double>> parse_integers(std::string_view text);
[[nodiscard]] Value<std::vector<bool>> parse_booleans(std::string_view text);
/// Whether a url is a path from the file that holds it, as everything is in a museum without a network.
[[nodiscard]] bool is_relative_path(std::string_view url);
/// MFString: "one" "two", with \" and \\ inside.
[[nodiscard]] Value<std::vector<std::string>> parse_strings(std::string_view text);

}  // namespace mechane::x3d
