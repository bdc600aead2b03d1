#include "server/scenario/file_references.hpp"

#include "server/x3d/metadata.hpp"
#include "server/x3d/schema.hpp"
#include "server/x3d/values.hpp"

namespace mechane::scenario {

std::vector<FileReference> file_references(const x3d::Document& document) {
  std::vector<FileReference> found;
  for (std::size_t i = 0; i < document.size(); ++i) {
    const x3d::NodeId id(i);
    const x3d::Node& node = document[id];
    if (node.kind != x3d::NodeKind::element) continue;
    const x3d::NodeType* type = x3d::Schema::standard().find(node.name);
    const bool sound = node.name == "MetadataString" && x3d::name_of(document, id).starts_with("audio.");
    for (const x3d::Attribute& attribute : node.attributes) {
      const bool url = type != nullptr && type->field(attribute.name) != nullptr &&
                       (attribute.name == "url" || attribute.name.ends_with("Url"));
      if (!url && !(sound && attribute.name == "value")) continue;
      if (auto urls = x3d::parse_strings(attribute.value)) found.push_back({id, attribute.name, std::move(*urls)});
    }
  }
  return found;
}

}  // namespace mechane::scenario
