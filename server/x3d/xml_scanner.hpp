// Where each element and attribute stands in the text of an XML file, and what keeps the text from being XML. A parser builds the
// tree; this says, for people, what the parser only refuses or lets pass (a bare &, an attribute written twice), and gives a writer
// the places that an edit may touch, so that it leaves the rest of the file as it is.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

namespace mechane::x3d {

/// Offsets into the text: name='value' lies from begin to value_end + 1.
struct XmlAttributeSpan {
  std::uint32_t begin = 0;
  std::uint32_t name_end = 0;
  std::uint32_t value_begin = 0;  ///< after the quote
  std::uint32_t value_end = 0;    ///< of the closing quote
};

/// <name ...>inner</name>, or <name .../> where tag_end, inner_end and end are the same.
struct XmlElementSpan {
  std::uint32_t begin = 0;
  std::uint32_t tag_end = 0;    ///< after the start tag
  std::uint32_t inner_end = 0;  ///< of the end tag's <
  std::uint32_t end = 0;
  std::uint32_t first_attribute = 0;
  std::uint32_t attributes = 0;
};

struct XmlSpans {
  std::vector<XmlElementSpan> elements;  ///< in the order of their start tags
  std::vector<XmlAttributeSpan> attributes;
};

struct XmlFault {
  std::size_t offset = 0;
  std::string element;  ///< in whose tag or text it lies; may be empty
  std::string what;
  std::string remedy;
};

/// At most 4 GB of text; no recursion. The first fault ends the scan.
[[nodiscard]] tl::expected<XmlSpans, XmlFault> scan_xml(std::string_view text);

}  // namespace mechane::x3d
