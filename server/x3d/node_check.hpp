// Checks every element of a document against X3D's own tables.
#pragma once

#include "server/x3d/document.hpp"
#include "server/x3d/problem.hpp"

namespace mechane::x3d {

/// Checks types, attributes and their values, which field of its parent an element fills, and the ends of routes. read_metadata() checks
/// the values of metadata. Any thread.
void check_nodes(const Document& document, Problems& problems);

}  // namespace mechane::x3d
