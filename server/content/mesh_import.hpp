// Reading a mesh file from anywhere. Only a child process touches the file's bytes: whatever they do to the parser, the caller gets a
// scene or an Error.
#pragma once

#include <filesystem>
#include <stop_token>

#include "server/base/error.hpp"
#include "server/content/import_limits.hpp"
#include "server/content/imported_scene.hpp"

namespace mechane::content {

/// Reads a .glb, .gltf, .obj, .stl, .ply or .x3d file. Blocks for as long as the child takes (limits.wall_time at most); any thread but
/// those of loops. The child is the program mechane-mesh-import: limits.helper, or $MECHANE_LIBEXEC/mechane-mesh-import, or beside the
/// running program, or in ../libexec/mechane from there. It gets no descriptors of ours, limited memory and processor time, and reads
/// nothing outside the file's own folder. Errors: not_found (the file, or the helper program), not_supported (the format), too_large,
/// timed_out, failed_process, and what check_scene and the reader say of a faulty file. When `stop` asks for it, the child is killed and
/// the import ends at once, with cancelled.
[[nodiscard]] Expected<ImportedScene> import_mesh(const std::filesystem::path& file, const ImportLimits& limits = {},
                                                  const std::stop_token& stop = {});

}  // namespace mechane::content
