// X3D's geometry nodes as faces.
#pragma once

#include <cstdint>

#include "server/base/error.hpp"
#include "server/content/importer/faces.hpp"
#include "server/x3d/node_fields.hpp"

namespace mechane::content {

/// An error at an element: "line 12, IndexedFaceSet ROOF".
[[nodiscard]] tl::unexpected<Error> fail_at(const x3d::Document& document, x3d::NodeId id, ErrorCode code,
                                            std::string what, std::string remedy);

/// Faces of a geometry that x3d::ShapeTree takes, with `most_corners` at most. Errors: too_large; missing (of coordinates or of a size);
/// invalid_value (an index that names nothing, a list that is too short, a number that a float cannot hold).
[[nodiscard]] Expected<Faces> faces_of(const x3d::Document& document, x3d::NodeId geometry, std::uint64_t most_corners);

}  // namespace mechane::content
