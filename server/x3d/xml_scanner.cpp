#include "server/x3d/xml_scanner.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

#include "server/base/suggestion.hpp"
#include "server/x3d/problem.hpp"

namespace mechane::x3d {
namespace {

constexpr std::size_t kMostOfOneTag = 1000;  // of one tag: each is compared with those before it
constexpr std::string_view kSpaces = " \t\r\n";

bool is_space(char c) {
  return kSpaces.find(c) != std::string_view::npos;
}

/// Letters of a name. Bytes above ASCII are letters of some alphabet.
bool is_name(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == '.' || c == ':' || byte >= 0x80;
}

bool begins_name(char c) {
  return is_name(c) && !(c >= '0' && c <= '9') && c != '-' && c != '.';
}

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  tl::expected<XmlSpans, XmlFault> run() {
    while (at_ < text_.size() && !fault_) {
      if (text_[at_] == '<') {
        markup();
      } else {
        characters();
      }
    }
    if (!fault_ && !open_.empty()) {
      const std::string name = name_of(open_.back());
      fail(spans_.elements[open_.back()].begin, fmt::format("<{}> is never closed", name),
           fmt::format("write </{}> where it ends, or /> at the end of its tag{}", name, by_indentation()));
    }
    if (fault_) return tl::unexpected(std::move(*fault_));
    return std::move(spans_);
  }

 private:
  void fail(std::size_t offset, std::string what, std::string remedy) {
    if (fault_) return;
    fault_ =
        XmlFault{offset, open_.empty() ? std::string() : name_of(open_.back()), std::move(what), std::move(remedy)};
  }

  [[nodiscard]] bool sees(std::string_view word) const { return text_.substr(at_).starts_with(word); }

  std::string name_of(std::size_t element) const {
    const std::size_t begin = spans_.elements[element].begin + 1;
    std::size_t end = begin;
    while (end < text_.size() && is_name(text_[end]))
      ++end;
    return std::string(text_.substr(begin, std::min<std::size_t>(end - begin, 80)));
  }

  std::string_view read_name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_name(text_[at_]))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }

  void skip_spaces() {
    while (at_ < text_.size() && is_space(text_[at_]))
      ++at_;
  }

  /// Goes behind `end`; a fault where it does not come.
  void skip_past(std::string_view end, std::size_t begin, std::string_view what) {
    const std::size_t found = text_.find(end, at_);
    if (found == std::string_view::npos) {
      fail(begin, fmt::format("{} is never closed", what), fmt::format("write {} where it ends", end));
      return;
    }
    at_ = found + end.size();
  }

  void characters() {
    const std::size_t end = std::min(text_.find('<', at_), text_.size());
    const std::string_view between = text_.substr(at_, end - at_);
    const bool mark = at_ == 0 && between.starts_with("\xEF\xBB\xBF");
    if (open_.empty() && between.substr(mark ? 3 : 0).find_first_not_of(kSpaces) != std::string_view::npos) {
      return fail(at_ + between.find_first_not_of(kSpaces), "there is text outside of the outermost element",
                  "remove it, or write it as a comment: <!-- ... -->");
    }
    references(at_, end);
    at_ = end;
  }

  /// Every & begins one of XML's own references.
  void references(std::size_t begin, std::size_t end) {
    for (std::size_t i = text_.find('&', begin); i < end; i = text_.find('&', i + 1)) {
      std::size_t stop = i + 1;
      while (stop < end && (is_name(text_[stop]) || text_[stop] == '#'))
        ++stop;
      const std::string_view name = text_.substr(i + 1, stop - i - 1);
      if (name.empty() || stop >= end || text_[stop] != ';')
        return fail(i, "a bare & stands in the text", "write &amp; for the letter &");
      constexpr std::array<std::string_view, 5> kKnown{"amp", "lt", "gt", "quot", "apos"};
      if (std::find(kKnown.begin(), kKnown.end(), name) != kKnown.end() || is_number(name)) continue;
      return fail(i, fmt::format("&{}; is not a letter that XML knows", name.substr(0, 40)),
                  "write the letter itself, in UTF-8; for & write &amp;");
    }
  }

  static bool is_number(std::string_view name) {
    if (!name.starts_with('#')) return false;
    name.remove_prefix(1);
    const bool hex = name.starts_with('x');
    if (hex) name.remove_prefix(1);
    return !name.empty() && name.size() <= 8 &&
           name.find_first_not_of(hex ? "0123456789abcdefABCDEF" : "0123456789") == std::string_view::npos;
  }

  void markup() {
    const std::size_t begin = at_;
    if (sees("<!--")) return comment();
    if (sees("<![CDATA[")) {
      if (open_.empty()) return fail(begin, "there is text outside of the outermost element", "remove it");
      return skip_past("]]>", begin, "a CDATA section");
    }
    if (sees("<?")) return skip_past("?>", begin, "an instruction <?");
    if (sees("<!DOCTYPE")) return doctype();
    if (sees("</")) return end_tag();
    if (at_ + 1 < text_.size() && begins_name(text_[at_ + 1])) return start_tag();
    fail(begin, "a bare < stands in the text", "write &lt; for the letter <");
  }

  void comment() {
    const std::size_t begin = at_;
    at_ += 4;
    const std::size_t dashes = text_.find("--", at_);
    if (dashes == std::string_view::npos) return fail(begin, "a comment is never closed", "write --> where it ends");
    if (!text_.substr(dashes).starts_with("-->"))
      return fail(dashes, "-- stands inside a comment", "XML forbids it: write one dash, or end the comment with -->");
    at_ = dashes + 3;
  }

  void doctype() {
    const std::size_t begin = at_;
    char quote = 0;
    int depth = 0;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (quote != 0) {
        if (c == quote) quote = 0;
      } else if (c == '"' || c == '\'') {
        quote = c;
      } else if (c == '<' || c == '[') {
        ++depth;
      } else if (c == '>' || c == ']') {
        if (--depth == 0) {
          ++at_;
          return;
        }
      }
    }
    fail(begin, "the DOCTYPE is never closed", "write > where it ends");
  }

  void end_tag() {
    const std::size_t begin = at_;
    at_ += 2;
    const std::string name(read_name().substr(0, 80));
    skip_spaces();
    if (at_ >= text_.size() || text_[at_] != '>')
      return fail(begin, fmt::format("the end tag </{} is not closed", name), "write > at its end");
    if (open_.empty())
      return fail(begin, fmt::format("</{}> closes nothing", name), "remove it, or write the start tag before it");
    const std::string wanted = name_of(open_.back());
    if (name != wanted) {
      const std::vector<std::string> meant{wanted};
      return fail(begin, fmt::format("</{}> comes where </{}> is awaited", name, wanted),
                  nearest(name, meant).empty()
                      ? fmt::format("<{}> of line {} is still open: close it first{}", wanted, line_of(open_.back()),
                                    by_indentation())
                      : fmt::format("write the same name here and in line {}", line_of(open_.back())));
    }
    ++at_;
    spans_.elements[open_.back()].inner_end = static_cast<std::uint32_t>(begin);
    spans_.elements[open_.back()].end = static_cast<std::uint32_t>(at_);
    open_.pop_back();
  }

  std::size_t line_of(std::size_t element) const {
    const std::string_view before = text_.substr(0, spans_.elements[element].begin);
    return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  }

  void start_tag() {
    const std::size_t begin = at_;
    if (open_.empty() && !spans_.elements.empty()) {
      return fail(begin, "there is a second outermost element", "an X3D file is one <X3D>...</X3D>");
    }
    const std::size_t index = spans_.elements.size();
    suspect(begin);
    spans_.elements.push_back({.begin = static_cast<std::uint32_t>(begin),
                               .first_attribute = static_cast<std::uint32_t>(spans_.attributes.size())});
    open_.push_back(index);
    ++at_;
    read_name();
    while (!fault_) {
      const bool apart = at_ < text_.size() && is_space(text_[at_]);
      skip_spaces();
      if (at_ >= text_.size()) return fail(begin, fmt::format("the tag <{}> is not closed", name_of(index)), "write >");
      if (text_[at_] == '>' || sees("/>")) return finish_tag(index);
      attribute(index, apart);
    }
  }

  /// How far an element is indented; none where other things stand before it on its line.
  std::optional<std::size_t> column_of(std::size_t begin) const {
    constexpr std::size_t kWidestIndent = 400;  // nobody indents further
    const std::size_t from = begin > kWidestIndent ? begin - kWidestIndent : 0;
    const std::size_t found = text_.substr(from, begin - from).find_last_not_of(" \t");
    if (found == std::string_view::npos) return std::nullopt;
    const std::size_t last = from + found;
    return text_[last] == '\n' ? std::optional(begin - last - 1) : std::nullopt;
  }

  /// An element that stands no deeper than the one around it: authors indent, so the one around it was likely meant to end before.
  void suspect(std::size_t begin) {
    if (suspect_ || open_.empty()) return;
    const auto column = column_of(begin);
    const auto around = column ? column_of(spans_.elements[open_.back()].begin) : std::nullopt;
    if (around && *around > 0 && *column <= *around) suspect_ = open_.back();
  }

  /// Where to look, for a fault of tags that do not fit each other.
  std::string by_indentation() const {
    if (!suspect_ || (!open_.empty() && *suspect_ == open_.back())) return {};
    return fmt::format("; by the indentation it is <{}> of line {} that is not closed", name_of(*suspect_),
                       line_of(*suspect_));
  }

  void finish_tag(std::size_t index) {
    XmlElementSpan& element = spans_.elements[index];
    const bool empty = text_[at_] == '/';
    at_ += empty ? 2 : 1;
    element.tag_end = static_cast<std::uint32_t>(at_);
    element.attributes = static_cast<std::uint32_t>(spans_.attributes.size()) - element.first_attribute;
    if (!empty) return;
    element.inner_end = element.end = element.tag_end;
    open_.pop_back();
  }

  void attribute(std::size_t element, bool apart) {
    const std::size_t begin = at_;
    const std::string tag = name_of(element);
    if (!begins_name(text_[at_])) {
      const bool quote = text_[at_] == '"' || text_[at_] == '\'';
      return fail(begin, fmt::format("'{}' stands in the tag <{}> where an attribute should", text_[at_], tag),
                  quote ? "a quote is left over, or the value before it holds a quote: write &quot; or &apos; there"
                        : "close the tag with > or />, and write attributes as name='value'");
    }
    const std::string_view name = read_name();
    const std::size_t name_end = at_;
    skip_spaces();
    if (at_ >= text_.size() || text_[at_] != '=') {
      return fail(begin, fmt::format("'{}' in the tag <{}> has no value", name.substr(0, 80), tag),
                  !apart || (at_ < text_.size() && (text_[at_] == '\'' || text_[at_] == '"'))
                      ? "the quote before it ended the value: write &apos; there, or &quot; for a double one"
                      : fmt::format("write {}='...', or close the tag before it", name.substr(0, 80)));
    }
    if (!apart) return fail(begin, fmt::format("no blank stands before '{}'", name.substr(0, 80)), "put one there");
    ++at_;
    skip_spaces();
    const char quote = at_ < text_.size() ? text_[at_] : ' ';
    if (quote != '\'' && quote != '"') {
      return fail(begin, fmt::format("the value of '{}' in the tag <{}> is not in quotes", name.substr(0, 80), tag),
                  fmt::format("write {}='...'", name.substr(0, 80)));
    }
    const std::size_t value = ++at_;
    const std::size_t end = text_.find(quote, at_);
    if (text_.substr(at_, end == std::string_view::npos ? end : end - at_).find('<') != std::string_view::npos ||
        end == std::string_view::npos) {
      return fail(
          begin,
          fmt::format("the value of '{}' in the tag <{}> holds < or has no closing quote", name.substr(0, 80), tag),
          "write the closing quote; for the letter < write &lt;");
    }
    if (!is_new(element, name)) {
      return fail(begin, fmt::format("'{}' is written twice in one tag <{}>", name.substr(0, 80), tag),
                  "keep one of them");
    }
    references(value, end);
    at_ = end + 1;
    spans_.attributes.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(name_end),
                                 static_cast<std::uint32_t>(value), static_cast<std::uint32_t>(end)});
  }

  bool is_new(std::size_t element, std::string_view name) {
    const std::size_t first = spans_.elements[element].first_attribute;
    if (spans_.attributes.size() - first >= kMostOfOneTag) {
      fail(at_, fmt::format("a tag has more than {} attributes", kMostOfOneTag), "no element of X3D has so many");
      return true;
    }
    return std::none_of(
        spans_.attributes.begin() + static_cast<std::ptrdiff_t>(first), spans_.attributes.end(),
        [&](const XmlAttributeSpan& other) { return text_.substr(other.begin, other.name_end - other.begin) == name; });
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<std::size_t> open_;
  XmlSpans spans_;
  std::optional<std::size_t> suspect_;  // an element
  std::optional<XmlFault> fault_;
};

}  // namespace

tl::expected<XmlSpans, XmlFault> scan_xml(std::string_view text) {
  return Scanner(text).run();
}

}  // namespace mechane::x3d
