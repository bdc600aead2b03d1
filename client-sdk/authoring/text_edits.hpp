// Changes to the text of an XML file that leave all other bytes as they were.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "server/x3d/document.hpp"

namespace mechane::authoring {

/// Collects changes to one text, and makes them all at once. A change within a part that another one replaces is dropped; changes at the
/// same place are made in the order given.
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

/// Adds a text (elements, with the line end and the blanks before each) at the end of an element's content. <a/> becomes <a>...</a>.
void append_inside(const x3d::Document& document, x3d::NodeId element, const std::string& text, TextEdits& edits);

/// Removes an element, with the line end and the blanks before it.
void remove_element(const x3d::Document& document, x3d::NodeId element, TextEdits& edits);

/// Moves an element to the place after a sibling; none: before the sibling `first`. The comments before it, and those after it on its
/// line, go with it; the blanks and line ends between siblings stay where they are.
void move_element(const x3d::Document& document, x3d::NodeId element, x3d::NodeId after, x3d::NodeId first,
                  TextEdits& edits);

/// The line end and the blanks before an element; empty where it is not the first thing on its line.
[[nodiscard]] std::string_view margin_of(const x3d::Document& document, x3d::NodeId element);
/// The margin for something inside an element: that of its last child, or its own and one step more.
[[nodiscard]] std::string inner_margin_of(const x3d::Document& document, x3d::NodeId element);

/// A text escaped for an attribute in such quotes: &, <, the quote, tabs and line ends become references.
[[nodiscard]] std::string escape_attribute(std::string_view text, char quote = '\'');

/// A list of strings as X3D writes them: "one" "two".
[[nodiscard]] std::string quote_strings(const std::vector<std::string>& strings);

}  // namespace mechane::authoring
