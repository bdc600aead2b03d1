// Where a scenario names other files: urls of X3D's nodes, sounds of its steps.
#pragma once

#include <string>
#include <vector>

#include "server/x3d/document.hpp"

namespace mechane::scenario {

/// An attribute that names files, with its value as strings.
struct FileReference {
  x3d::NodeId node;
  std::string attribute;
  std::vector<std::string> urls;  ///< as written: "../models/screw.glb", or what is not a path at all
};

/// All of them, in the order written. What is not a list of strings is left out.
[[nodiscard]] std::vector<FileReference> file_references(const x3d::Document& document);

}  // namespace mechane::scenario
