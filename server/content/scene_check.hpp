// The promises of ImportedScene, checked: by the child, to name what is wrong with the file, and by the parent, which trusts no child.
#pragma once

#include "server/base/error.hpp"
#include "server/content/import_limits.hpp"
#include "server/content/imported_scene.hpp"

namespace mechane::content {

/// Fails when an index is out of range, a number is not finite, a parent comes after its child, an attribute has the wrong length,
/// there is no triangle, or a limit of size is passed. The error's `where` is the node, mesh or texture inside the file.
[[nodiscard]] Expected<void> check_scene(const ImportedScene& scene, const ImportLimits& limits);

}  // namespace mechane::content
