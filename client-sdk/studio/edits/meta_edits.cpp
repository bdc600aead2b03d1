#include "client-sdk/studio/edits/meta_edits.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "client-sdk/authoring/text_edits.hpp"
#include "server/scenario/head_facts.hpp"

namespace mechane::studio {
namespace {

using x3d::NodeId;

void add_meta(const x3d::Document& document, const SetMeta& meta, authoring::TextEdits& edits) {
  const std::string element =
      fmt::format("<meta name='{}' content='{}'/>", meta.name, authoring::escape_attribute(meta.value));
  const auto children = document.child_elements(document.x3d());
  const auto head = std::ranges::find(children, "head", [&](NodeId id) { return document[id].name; });
  if (head != children.end())
    return authoring::append_inside(document, *head, authoring::inner_margin_of(document, *head) + element, edits);
  const std::string margin(authoring::margin_of(document, document.scene()));
  const std::string inner = margin.empty() ? "" : margin + "  ";
  edits.insert(document[document.scene()].span.begin,
               fmt::format("<head>{}{}{}</head>{}", inner, element, margin, margin));
}

}  // namespace

Expected<std::string> with_meta(const x3d::Document& document, const SetMeta& meta) {
  const auto same = scenario::same_meta_names(meta.name);
  if (same.empty())
    return fail(ErrorCode::unknown_name, fmt::format("no <meta> is called '{}' here", meta.name), "",
                "take description, license, creator, reference, version or subject");
  authoring::TextEdits edits;
  bool written = meta.value.empty();
  for (const NodeId id : scenario::meta_elements(document)) {
    if (std::ranges::find(same, *document[id].attribute("name")) == same.end()) continue;
    if (written)
      authoring::remove_element(document, id, edits);
    else
      authoring::set_attribute(document, id, "content", meta.value, edits);
    written = true;
  }
  if (!written) add_meta(document, meta, edits);
  return edits.apply(document.source());
}

}  // namespace mechane::studio
