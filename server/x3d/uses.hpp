// DEF and USE: which element stands for which. A part of reading a document.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "server/x3d/document.hpp"
#include "server/x3d/problem.hpp"

namespace mechane::x3d {

/// Fills Node::used, and `defs` with the DEFs outside prototypes (a prototype's body has names of its own). Problems: a DEF given
/// twice, a USE that names nothing, or an element of another type, or stands before its DEF (warning), or closes a circle.
void resolve_uses(std::vector<Node>& nodes, std::map<std::string, NodeId, std::less<>>& defs, Problems& problems);

}  // namespace mechane::x3d
