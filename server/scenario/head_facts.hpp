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

/// The names that say the same as this one, itself first: X3D's own, after Dublin Core. Empty: it is none that is read here.
[[nodiscard]] std::span<const std::string_view> same_meta_names(std::string_view name);

}  // namespace mechane::scenario
