// The promises of ImportedScene, checked: by the child, to name what is wrong with the file, and by the parent, which trusts no child.
#pragma once

#include "server/base/error.hpp"
#include "server/content/import_limits.hpp"
#include "server/content/imported_scene.hpp"

namespace mechane::content {

/// Errors: damaged (an index out of range, a parent after its child, an attribute of the wrong length), invalid_value (a number that is not
/// finite, a model of a wrong size), missing (no triangle), too_large. The error's `where` is the node, mesh or texture inside the file.
[[nodiscard]] Expected<void> check_scene(const ImportedScene& scene, const ImportLimits& limits);

}  // namespace mechane::content
