// Checks every element of a document against X3D's own tables.
#pragma once

#include "server/x3d/document.hpp"
#include "server/x3d/problem.hpp"

namespace mechane::x3d {

/// Types, attributes and their values, which field of its parent an element fills, and the ends of routes. Values of metadata are
/// read_metadata()'s to check. Any thread.
void check_nodes(const Document& document, Problems& problems);

}  // namespace mechane::x3d
