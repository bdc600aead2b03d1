// An X3D file's own shapes to an ImportedScene. Runs in the child process only.
#pragma once

#include <filesystem>

#include "server/base/error.hpp"
#include "server/content/import_limits.hpp"
#include "server/content/imported_scene.hpp"

namespace mechane::content {

/// A root node for each RigidBody with a shape, named as x3d::node_name() says, where the body is at the start; one for each Transform that
/// is a body's picture, by its DEF; and SCENE, which holds all other shapes. Under them groups and Shapes, and Inlines of X3D files of
/// the same folder, 8 deep at most. The error's `where` is a line and an element. Errors: what read_document and check_nodes find;
/// too_large; missing and invalid_value (of a geometry); not_found (a file).
[[nodiscard]] Expected<ImportedScene> read_x3d(const std::filesystem::path& file, const ImportLimits& limits);

}  // namespace mechane::content
