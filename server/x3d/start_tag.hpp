// The places of a start tag's attributes, and what is wrong with a tag that the parser refuses. The parser decides what is XML; this
// finds the places and the words for people.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

namespace mechane::x3d {

/// Offsets into the text: name='value' lies from begin to value_end + 1.
struct AttributeSpan {
  std::uint32_t begin = 0;
  std::uint32_t name_end = 0;
  std::uint32_t value_begin = 0;  ///< after the quote
  std::uint32_t value_end = 0;    ///< of the closing quote
};

/// Why a text is not XML.
struct XmlFault {
  std::size_t offset = 0;
  std::string element;  ///< in whose tag or text it lies; may be empty
  std::string what;
  std::string remedy;
};

/// The attributes of the start tag at `begin`, in the order written; or the first fault in it. It does not check the tag's name and end:
/// in a tag that a parser has accepted, it finds all attributes.
[[nodiscard]] tl::expected<std::vector<AttributeSpan>, XmlFault> find_attributes(std::string_view text,
                                                                                 std::size_t begin);

/// The first '&' between two offsets that does not begin one of XML's own references.
[[nodiscard]] std::optional<XmlFault> reference_fault(std::string_view text, std::size_t begin, std::size_t end);

/// The letters of the name at an offset. All bytes above ASCII count as letters.
[[nodiscard]] std::string_view name_at(std::string_view text, std::size_t at);
[[nodiscard]] bool begins_name(char c);
[[nodiscard]] bool is_space(char c);

/// A name as a message shows it: at most one line.
[[nodiscard]] std::string shown_name(std::string_view name);

}  // namespace mechane::x3d
