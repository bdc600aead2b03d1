// A mesh file that was read, as glTF 2.0 in one file (.glb): for browsers, which do not read X3D.
#pragma once

#include <string>

#include "server/content/imported_scene.hpp"

namespace mechane::studio {

/// Nodes, triangles and materials; images are left out. Any thread.
[[nodiscard]] std::string glb_of(const content::ImportedScene& scene);

}  // namespace mechane::studio
