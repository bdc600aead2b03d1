#include "server/scenario/file_references.hpp"

#include "server/scenario/key_scope.hpp"
#include "server/scenario/values.hpp"
#include "server/scenario/x3d_schema.hpp"

namespace mechane::scenario {

std::vector<FileReference> file_references(const Document& document) {
  std::vector<FileReference> found;
  for (std::size_t i = 0; i < document.size(); ++i) {
    const NodeId id(i);
    const Node& node = document[id];
    if (node.kind != NodeKind::element) continue;
    const X3dType* type = X3dSchema::standard().find(node.name);
    const bool sound = node.name == "MetadataString" && name_of(document, id).starts_with("audio.");
    for (const Attribute& attribute : node.attributes) {
      const bool url = type != nullptr && type->field(attribute.name) != nullptr &&
                       (attribute.name == "url" || attribute.name.ends_with("Url"));
      if (!url && !(sound && attribute.name == "value")) continue;
      if (auto urls = parse_strings(attribute.value)) found.push_back({id, attribute.name, std::move(*urls)});
    }
  }
  return found;
}

}  // namespace mechane::scenario
