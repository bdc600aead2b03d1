#include "client-sdk/authoring/text_edits.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "server/base/assert.hpp"

namespace mechane::authoring {
namespace {

constexpr std::string_view kBlank = " \t";
constexpr std::string_view kSpace = " \t\r\n";

}  // namespace

void TextEdits::replace(std::size_t begin, std::size_t end, std::string with) {
  MECHANE_ASSERT(begin <= end);
  edits_.push_back({begin, end, std::move(with)});
}

std::string TextEdits::apply(std::string_view text) const {
  std::vector<const Edit*> sorted;
  for (const Edit& edit : edits_)
    sorted.push_back(&edit);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Edit* a, const Edit* b) { return a->begin < b->begin; });
  std::string out;
  std::size_t at = 0;
  for (const Edit* edit : sorted) {
    MECHANE_ASSERT(edit->end <= text.size());
    if (edit->begin < at) continue;
    out += text.substr(at, edit->begin - at);
    out += edit->with;
    at = edit->end;
  }
  out += text.substr(at);
  return out;
}

std::string escape_attribute(std::string_view text, char quote) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '\n':
        out += "&#10;";
        break;
      case '\r':
        out += "&#13;";
        break;
      case '\t':
        out += "&#9;";
        break;
      default:
        if (c == quote) {
          out += quote == '"' ? "&quot;" : "&apos;";
        } else {
          out += c;
        }
    }
  }
  return out;
}

void set_attribute(const x3d::Document& document, x3d::NodeId element, std::string_view name, std::string_view value,
                   TextEdits& edits) {
  const x3d::Node& node = document[element];
  for (const x3d::Attribute& attribute : node.attributes) {
    if (attribute.name != name) continue;
    if (attribute.value == value) return;
    const char quote = document.source()[attribute.span.value_end];
    return edits.replace(attribute.span.value_begin, attribute.span.value_end, escape_attribute(value, quote));
  }
  std::size_t at = node.span.begin + 1 + node.name.size();
  if (!node.attributes.empty()) at = node.attributes.back().span.value_end + 1;
  edits.insert(at, fmt::format(" {}='{}'", name, escape_attribute(value)));
}

std::string_view margin_of(const x3d::Document& document, x3d::NodeId element) {
  const std::string_view before = std::string_view(document.source()).substr(0, document[element].span.begin);
  const std::size_t last = before.find_last_not_of(kBlank);
  if (last == std::string_view::npos || before[last] != '\n') return {};
  const std::size_t begin = last > 0 && before[last - 1] == '\r' ? last - 1 : last;
  return before.substr(begin);
}

std::string inner_margin_of(const x3d::Document& document, x3d::NodeId element) {
  const std::vector<x3d::NodeId> children = document.child_elements(element);
  if (!children.empty()) return std::string(margin_of(document, children.back()));
  const std::string_view own = margin_of(document, element);
  return own.empty() ? std::string() : std::string(own) + "  ";
}

void append_inside(const x3d::Document& document, x3d::NodeId element, const std::string& text, TextEdits& edits) {
  const x3d::Node& node = document[element];
  const std::string_view source = document.source();
  const std::string own(margin_of(document, element));
  if (node.span.tag_end == node.span.end) {
    return edits.replace(node.span.end - 2, node.span.end, fmt::format(">{}{}</{}>", text, own, node.name));
  }
  // After its last content, so that the blanks before its end tag stay where they are.
  const std::string_view inner = source.substr(node.span.tag_end, node.span.inner_end - node.span.tag_end);
  const std::size_t last = inner.find_last_not_of(kSpace);
  if (last != std::string_view::npos) return edits.insert(node.span.tag_end + last + 1, text);
  edits.insert(node.span.tag_end, inner.find('\n') == std::string_view::npos ? text + own : text);
}

void remove_element(const x3d::Document& document, x3d::NodeId element, TextEdits& edits) {
  const x3d::ElementSpan& span = document[element].span;
  const std::size_t margin = margin_of(document, element).size();
  const std::string_view after = std::string_view(document.source()).substr(span.end);
  // Where nothing follows on its line, the margin before it is removed too.
  const std::size_t next = after.find_first_not_of(kBlank);
  const bool ends_line = next != std::string_view::npos && (after[next] == '\n' || after[next] == '\r');
  edits.replace(span.begin - (ends_line ? margin : 0), span.end, "");
}

std::string quote_strings(const std::vector<std::string>& strings) {
  std::string out;
  for (const std::string& text : strings) {
    out += out.empty() ? "\"" : " \"";
    for (const char c : text) {
      if (c == '"' || c == '\\') out += '\\';
      out += c;
    }
    out += '"';
  }
  return out;
}

}  // namespace mechane::authoring
