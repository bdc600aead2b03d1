// Reading a mesh file that nobody vouches for. A child process alone touches the file's bytes: whatever it does to the parser, the
// caller gets a scene or an Error.
#pragma once

#include <filesystem>
#include <stop_token>

#include "server/base/error.hpp"
#include "server/content/import_limits.hpp"
#include "server/content/imported_scene.hpp"

namespace mechane::content {

/// Reads a .glb, .gltf, .obj, .stl or .ply file. Blocks for as long as the child takes (limits.wall_time at most); any thread but one
/// of the loop. The child is the program mechane-mesh-import: limits.helper, or $MECHANE_LIBEXEC/mechane-mesh-import, or beside the
/// running program, or in ../libexec/mechane from there. It gets no descriptors of ours, limited memory and processor time, and reads
/// nothing outside the file's own folder. Errors: no such file, a format that is not read, a faulty file, a file over the limits, a
/// child that crashed, ran too long or took too much memory, no helper program. When `stop` asks for it, the child is killed and the import
/// ends at once, with an Error.
[[nodiscard]] Expected<ImportedScene> import_mesh(const std::filesystem::path& file, const ImportLimits& limits = {},
                                                  const std::stop_token& stop = {});

}  // namespace mechane::content
