#include "server/x3d/start_tag.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace mechane::x3d {
namespace {

bool is_name(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == '.' || c == ':' || byte >= 0x80;
}

/// Whether the text between & and ; is a character's number, like #233 or #xe9.
bool is_number_reference(std::string_view name) {
  if (!name.starts_with('#')) return false;
  name.remove_prefix(1);
  const bool hex = name.starts_with('x');
  if (hex) name.remove_prefix(1);
  return !name.empty() && name.size() <= 8 &&
         name.find_first_not_of(hex ? "0123456789abcdefABCDEF" : "0123456789") == std::string_view::npos;
}

class StartTag {
 public:
  StartTag(std::string_view text, std::size_t begin)
      : text_(text), begin_(begin), name_(name_at(text, begin + 1)), at_(begin + 1 + name_.size()) {}

  tl::expected<std::vector<AttributeSpan>, XmlFault> run() {
    while (!fault_) {
      const bool apart = at_ < text_.size() && is_space(text_[at_]);
      skip_spaces();
      if (at_ >= text_.size()) {
        fail(begin_, fmt::format("the tag <{}> is not closed", shown_name(name_)), "write >");
      } else if (text_[at_] == '>' || text_.substr(at_).starts_with("/>")) {
        return std::move(attributes_);
      } else {
        attribute(apart);
      }
    }
    return tl::unexpected(std::move(*fault_));
  }

 private:
  void fail(std::size_t offset, std::string what, std::string remedy) {
    fault_ = XmlFault{offset, shown_name(name_), std::move(what), std::move(remedy)};
  }

  void skip_spaces() {
    while (at_ < text_.size() && is_space(text_[at_]))
      ++at_;
  }

  void attribute(bool apart) {
    const std::size_t begin = at_;
    const std::string tag = shown_name(name_);
    if (!begins_name(text_[at_])) {
      const bool quote = text_[at_] == '"' || text_[at_] == '\'';
      return fail(begin, fmt::format("the tag <{1}> has '{0}' where an attribute should be", text_[at_], tag),
                  quote ? "a quote is left over, or the value before it holds a quote: write &quot; or &apos; there"
                        : "close the tag with > or />, and write attributes as name='value'");
    }
    const std::string_view name = name_at(text_, at_);
    const std::string shown = shown_name(name);
    at_ += name.size();
    const std::size_t name_end = at_;
    skip_spaces();
    if (at_ >= text_.size() || text_[at_] != '=') {
      return fail(begin, fmt::format("'{}' in the tag <{}> has no value", shown, tag),
                  !apart || (at_ < text_.size() && (text_[at_] == '\'' || text_[at_] == '"'))
                      ? "the quote before it ended the value: write &apos; there, or &quot; for a double quote"
                      : fmt::format("write {}='...', or close the tag before it", shown));
    }
    if (!apart) return fail(begin, fmt::format("there is no blank before '{}'", shown), "write a blank there");
    ++at_;
    skip_spaces();
    const char quote = at_ < text_.size() ? text_[at_] : ' ';
    if (quote != '\'' && quote != '"') {
      // Curly quotes are three bytes in UTF-8, and the first byte is 0xe2.
      const bool curly = static_cast<unsigned char>(quote) == 0xe2;
      return fail(begin,
                  fmt::format("the value of '{}' in the tag <{}> is {}", shown, tag,
                              curly ? "in curly quotes, not in straight ones" : "not in quotes"),
                  fmt::format("write {}='...'", shown));
    }
    const std::size_t value = ++at_;
    const std::size_t end = text_.find(quote, at_);
    if (text_.substr(value, end == std::string_view::npos ? end : end - value).find('<') != std::string_view::npos ||
        end == std::string_view::npos) {
      return fail(begin, fmt::format("the value of '{}' in the tag <{}> holds < or has no closing quote", shown, tag),
                  "write the closing quote; for the letter < write &lt;");
    }
    if ((fault_ = reference_fault(text_, value, end))) {
      fault_->element = tag;
      return;
    }
    at_ = end + 1;
    attributes_.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(name_end),
                           static_cast<std::uint32_t>(value), static_cast<std::uint32_t>(end)});
  }

  std::string_view text_;
  std::size_t begin_;
  std::string_view name_;
  std::size_t at_;
  std::vector<AttributeSpan> attributes_;
  std::optional<XmlFault> fault_;
};

}  // namespace

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

bool begins_name(char c) {
  return is_name(c) && !(c >= '0' && c <= '9') && c != '-' && c != '.';
}

std::string_view name_at(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && is_name(text[end]))
    ++end;
  return text.substr(std::min(at, text.size()), end - at);
}

std::string shown_name(std::string_view name) {
  return std::string(name.substr(0, 80));
}

std::optional<XmlFault> reference_fault(std::string_view text, std::size_t begin, std::size_t end) {
  constexpr std::array<std::string_view, 5> kKnown{"amp", "lt", "gt", "quot", "apos"};
  text = text.substr(0, end);  // a search to the file's end would take the square of the file's length
  for (std::size_t i = text.find('&', begin); i < end; i = text.find('&', i + 1)) {
    std::size_t stop = i + 1;
    while (stop < end && (is_name(text[stop]) || text[stop] == '#'))
      ++stop;
    const std::string_view name = text.substr(i + 1, stop - i - 1);
    if (name.empty() || stop >= end || text[stop] != ';')
      return XmlFault{i, {}, "the text has a bare &", "write &amp; for the letter &"};
    if (std::find(kKnown.begin(), kKnown.end(), name) != kKnown.end() || is_number_reference(name)) continue;
    return XmlFault{i,
                    {},
                    fmt::format("&{}; is not one of XML's own references", name.substr(0, 40)),
                    "write the letter itself, in UTF-8; for & write &amp;"};
  }
  return std::nullopt;
}

tl::expected<std::vector<AttributeSpan>, XmlFault> find_attributes(std::string_view text, std::size_t begin) {
  return StartTag(text, begin).run();
}

}  // namespace mechane::x3d
