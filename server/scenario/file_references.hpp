// The places in a scenario that name other files: urls of X3D's nodes, sounds of its steps.
#pragma once

#include <string>
#include <vector>

#include "server/x3d/document.hpp"

namespace mechane::scenario {

/// An attribute that names files, with its value as strings.
struct FileReference {
  x3d::NodeId node;
  std::string attribute;
  std::vector<std::string> urls;  ///< as written: paths like "../models/screw.glb", and what is not a path
};

/// All of them, in the order written. Attributes that do not hold a list of strings are left out.
[[nodiscard]] std::vector<FileReference> file_references(const x3d::Document& document);

}  // namespace mechane::scenario
