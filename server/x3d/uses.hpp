// DEF and USE: which element each USE refers to. A part of reading a document.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "server/x3d/document.hpp"
#include "server/x3d/problem.hpp"

namespace mechane::x3d {

/// Fills Node::used, and `defs` with the DEFs outside prototypes (a prototype's body has its own names). Problems: a DEF given twice; a
/// USE whose name no element has, that names an element of another type, that closes a circle, or (a warning) that is written before
/// its DEF.
void resolve_uses(std::vector<Node>& nodes, std::map<std::string, NodeId, std::less<>>& defs, Problems& problems);

}  // namespace mechane::x3d
