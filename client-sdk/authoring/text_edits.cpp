#include "client-sdk/authoring/text_edits.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "server/base/assert.hpp"

namespace mechane::authoring {
namespace {

constexpr std::string_view kBlank = " \t";
constexpr std::string_view kSpace = " \t\r\n";

/// Where an element ends with the comments that follow it on its line, and end the line.
std::size_t end_with_comments(std::string_view source, std::size_t end) {
  std::size_t at = source.find_first_not_of(kBlank, end);
  while (at != std::string_view::npos && source.substr(at).starts_with("<!--")) {
    const std::size_t close = source.find("-->", at);
    if (close == std::string_view::npos) return end;
    const std::size_t next = source.find_first_not_of(kBlank, close + 3);
    if (next != std::string_view::npos && (source[next] == '\n' || source[next] == '\r')) return close + 3;
    at = next;
  }
  return end;
}

/// A part of the source, as offsets.
struct Stretch {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The children of an element, each with its comments, in the order written. Only blanks and line ends are between them.
std::vector<Stretch> stretches_of(const x3d::Document& document, const std::vector<x3d::NodeId>& children) {
  const std::string_view source = document.source();
  std::vector<Stretch> pieces;
  std::size_t free = end_with_comments(source, document[document[children.front()].parent].span.tag_end);
  for (const x3d::NodeId child : children) {
    pieces.push_back({source.find_first_not_of(kSpace, free), end_with_comments(source, document[child].span.end)});
    free = pieces.back().end;
  }
  return pieces;
}

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

void move_element(const x3d::Document& document, x3d::NodeId element, x3d::NodeId after, x3d::NodeId first,
                  TextEdits& edits) {
  const std::vector<x3d::NodeId> siblings = document.child_elements(document[element].parent);
  const auto place = [&](x3d::NodeId id) { return std::find(siblings.begin(), siblings.end(), id) - siblings.begin(); };
  const std::vector<Stretch> pieces = stretches_of(document, siblings);
  std::vector<Stretch> moved = pieces;
  const auto from = moved.begin() + place(element);
  const auto to = moved.begin() + (after ? place(after) + 1 : place(first));
  if (from < to)
    std::rotate(from, from + 1, to);
  else
    std::rotate(to, from, from + 1);
  const std::string_view source = document.source();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (moved[i].begin != pieces[i].begin)
      edits.replace(pieces[i].begin, pieces[i].end,
                    std::string(source.substr(moved[i].begin, moved[i].end - moved[i].begin)));
  }
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
