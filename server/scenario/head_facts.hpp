// What a scenario's file says of itself in the <meta> elements of its head.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/content/catalogue.hpp"
#include "server/x3d/document.hpp"

namespace mechane::scenario {

struct HeadFacts {
  std::string description;        ///< <meta name='description'>
  content::Credits credits;       ///< license, creator, reference, version
  std::vector<std::string> tags;  ///< keywords, in the order written
};

/// Where a name is given twice, both contents are kept: "A; B".
[[nodiscard]] HeadFacts head_facts(const x3d::Document& document);

/// The <meta> elements of the head that have a name, in the order written.
[[nodiscard]] std::vector<x3d::NodeId> meta_elements(const x3d::Document& document);

/// All names with the meaning of this one, and this one among them: X3D's own names, after Dublin Core. Empty for a name that is not read.
[[nodiscard]] std::span<const std::string_view> same_meta_names(std::string_view name);

}  // namespace mechane::scenario
