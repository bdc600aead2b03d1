#include "server/x3d/xml_fault.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "server/base/suggestion.hpp"

namespace mechane::x3d {
namespace {

class FaultFinder {
 public:
  FaultFinder(std::string_view text, const std::vector<Node>& nodes, NodeId open, const Refusal& refusal)
      : text_(text), nodes_(nodes), open_(open), refusal_(refusal), at_(refusal.begin) {}

  XmlFault find() const {
    if (at_ >= text_.size() && open_) return never_closed();
    if (at_ >= text_.size() || text_[at_] != '<') return characters();
    if (sees("<!--")) return comment();
    if (sees("<![CDATA[")) return cdata();
    if (sees("<?")) return instruction();
    if (sees("<!DOCTYPE")) return doctype();
    if (sees("</")) return end_tag();
    if (at_ + 1 < text_.size() && begins_name(text_[at_ + 1])) return start_tag();
    return fault(at_, "the text has a bare <", "write &lt; for the letter <");
  }

 private:
  [[nodiscard]] bool sees(std::string_view word) const { return text_.substr(at_).starts_with(word); }

  XmlFault fault(std::size_t offset, std::string what, std::string remedy) const {
    return {offset, open_ ? shown_name(open().name) : std::string(), std::move(what), std::move(remedy)};
  }

  /// The parser's own words, where nothing better is known.
  XmlFault as_the_parser_says() const {
    const std::size_t at = refusal_.offset;
    const unsigned byte = at < text_.size() ? static_cast<unsigned char>(text_[at]) : ' ';
    if (byte < ' ' && !is_space(static_cast<char>(byte))) {
      return fault(at, fmt::format("the text has a control character (0x{:02x})", byte), "remove it");
    }
    return fault(at, fmt::format("the parser stops here: {}", refusal_.words),
                 "close what is open and quote every attribute; an XML editor shows the place");
  }

  const Node& open() const { return nodes_[open_.index()]; }

  XmlFault never_closed() const {
    const std::string name = shown_name(open().name);
    return fault(open().span.begin, fmt::format("<{}> is never closed", name),
                 fmt::format("write </{}> where it ends, or /> at the end of its tag{}", name, by_indentation()));
  }

  XmlFault characters() const {
    const std::size_t end = std::min(text_.find('<', at_), text_.size());
    if (!open_)
      return fault(at_, "there is text outside of the outermost element",
                   "remove it, or write it as a comment: <!-- ... -->");
    if (auto reference = reference_fault(text_, at_, end))
      return fault(reference->offset, std::move(reference->what), std::move(reference->remedy));
    const std::size_t brackets = text_.substr(0, end).find("]]>", at_);
    if (brackets != std::string_view::npos) return fault(brackets, "the text has ]]>", "write ]]&gt; there");
    return as_the_parser_says();
  }

  /// For something that begins at at_ and should end with `end`.
  XmlFault unclosed(std::string_view what, std::string_view end) const {
    if (text_.find(end, at_) != std::string_view::npos) return as_the_parser_says();
    return fault(at_, fmt::format("{} is never closed", what), fmt::format("write {} where it ends", end));
  }

  XmlFault comment() const {
    const std::size_t dashes = text_.find("--", at_ + 4);
    if (dashes == std::string_view::npos || text_.substr(dashes).starts_with("-->"))
      return unclosed("a comment", "-->");
    return fault(dashes, "a comment has -- in it", "XML forbids it: write one dash, or end the comment with -->");
  }

  XmlFault cdata() const {
    if (!open_) return fault(at_, "there is text outside of the outermost element", "remove it");
    return unclosed("a CDATA section", "]]>");
  }

  XmlFault instruction() const {
    if (name_at(text_, at_ + 2) == "xml" && at_ > 0 && text_.find("?>", at_) != std::string_view::npos)
      return fault(at_, "<?xml ...?> is not the first thing in the file", "remove everything before it, blanks too");
    return unclosed("an instruction <?", "?>");
  }

  XmlFault doctype() const {
    if (!nodes_.empty())
      return fault(at_, "the DOCTYPE comes after the first element", "remove it; a scenario needs none");
    if (text_.find('>', at_) == std::string_view::npos)
      return fault(at_, "the DOCTYPE is never closed", "write > where it ends");
    return fault(at_, fmt::format("the DOCTYPE cannot be read: {}", refusal_.words),
                 "remove it; a scenario needs none");
  }

  XmlFault end_tag() const {
    const std::string name = shown_name(name_at(text_, at_ + 2));
    const std::size_t end = text_.find_first_not_of(" \t\r\n", at_ + 2 + name_at(text_, at_ + 2).size());
    if (end == std::string_view::npos || text_[end] != '>')
      return fault(at_, fmt::format("the end tag </{} is not closed", name), "write > at its end");
    if (!open_)
      return fault(at_, fmt::format("</{}> closes nothing", name), "remove it, or write the start tag before it");
    const std::string wanted = shown_name(open().name);
    if (name == wanted) return as_the_parser_says();
    const std::vector<std::string> meant{wanted};
    return fault(at_, fmt::format("</{}> is written where </{}> should be", name, wanted),
                 nearest(name, meant).empty() ? fmt::format("<{}> of line {} is still open: close it first{}", wanted,
                                                            open().line, by_indentation())
                                              : fmt::format("write the same name here and in line {}", open().line));
  }

  XmlFault start_tag() const {
    if (!open_ && !nodes_.empty())
      return fault(at_, "there is a second outermost element", "an X3D file is one <X3D>...</X3D>");
    const auto attributes = find_attributes(text_, at_);
    if (!attributes) return attributes.error();
    const std::string tag = shown_name(name_at(text_, at_ + 1));
    const auto name_of = [&](const AttributeSpan& span) {
      return text_.substr(span.begin, span.name_end - span.begin);
    };
    for (auto one = attributes->begin(); one != attributes->end(); ++one) {
      if (one->begin > refusal_.offset && refusal_.offset > at_) break;
      const bool twice = std::any_of(attributes->begin(), one,
                                     [&](const AttributeSpan& other) { return name_of(other) == name_of(*one); });
      if (twice)
        return {one->begin, tag, fmt::format("'{}' is written twice in one tag <{}>", shown_name(name_of(*one)), tag),
                "keep one of them"};
    }
    return as_the_parser_says();
  }

  /// How far an element is indented; none where it is not the first thing on its line.
  std::optional<std::size_t> column_of(std::size_t begin) const {
    constexpr std::size_t kWidestIndent = 400;  // no author indents further
    const std::size_t from = begin > kWidestIndent ? begin - kWidestIndent : 0;
    const std::size_t found = text_.substr(from, begin - from).find_last_not_of(" \t");
    if (found == std::string_view::npos) return std::nullopt;
    const std::size_t last = from + found;
    return text_[last] == '\n' ? std::optional(begin - last - 1) : std::nullopt;
  }

  /// For tags that do not match: a hint where to look. Authors indent, so where an element is indented no further than the one around
  /// it, the outer one was likely meant to end before it.
  std::string by_indentation() const {
    for (const Node& node : nodes_) {
      if (node.kind != NodeKind::element || !node.parent) continue;
      const Node& around = nodes_[node.parent.index()];
      const auto column = column_of(node.span.begin);
      const auto outer = column ? column_of(around.span.begin) : std::nullopt;
      if (!outer || *outer == 0 || *column > *outer) continue;
      if (node.parent == open_) return {};
      return fmt::format("; by the indentation it is <{}> of line {} that is not closed", shown_name(around.name),
                         around.line);
    }
    return {};
  }

  std::string_view text_;
  const std::vector<Node>& nodes_;
  NodeId open_;
  const Refusal& refusal_;
  std::size_t at_;
};

}  // namespace

XmlFault explain(std::string_view text, const std::vector<Node>& nodes, NodeId open, const Refusal& refusal) {
  return FaultFinder(text, nodes, open, refusal).find();
}

}  // namespace mechane::x3d
