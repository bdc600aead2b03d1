// Changes to the text of an XML file that leave every byte beside them as it was.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "server/x3d/document.hpp"

namespace mechane::authoring {

/// Collects changes against one text, and makes them all at once. A change in what another one replaces is left out; those at the same
/// place are made in the order given.
class TextEdits {
 public:
  void replace(std::size_t begin, std::size_t end, std::string with);
  void insert(std::size_t at, std::string text) { replace(at, at, std::move(text)); }
  [[nodiscard]] bool empty() const { return edits_.empty(); }
  [[nodiscard]] std::string apply(std::string_view text) const;

 private:
  struct Edit {
    std::size_t begin;
    std::size_t end;
    std::string with;
  };
  std::vector<Edit> edits_;
};

/// Writes an attribute of an element: its value, or a new one at the end of the tag.
void set_attribute(const x3d::Document& document, x3d::NodeId element, std::string_view name, std::string_view value,
                   TextEdits& edits);

/// Puts a text (elements, with the line end and the blanks before each) behind all that an element holds. An element written as
/// <a/> becomes <a>...</a>.
void append_inside(const x3d::Document& document, x3d::NodeId element, const std::string& text, TextEdits& edits);

/// Takes an element out, with the line end and the blanks before it.
void remove_element(const x3d::Document& document, x3d::NodeId element, TextEdits& edits);

/// What stands before an element on its line: a line end and blanks. Empty where other things stand before it.
[[nodiscard]] std::string_view margin_of(const x3d::Document& document, x3d::NodeId element);
/// The margin for something inside an element: that of what it holds already, or one step deeper than its own.
[[nodiscard]] std::string inner_margin_of(const x3d::Document& document, x3d::NodeId element);

/// A text as it may stand in an attribute in such quotes: &, <, the quote and line ends are written as references.
[[nodiscard]] std::string escape_attribute(std::string_view text, char quote = '\'');

/// A list of strings as X3D writes them: "one" "two".
[[nodiscard]] std::string quote_strings(const std::vector<std::string>& strings);

}  // namespace mechane::authoring
