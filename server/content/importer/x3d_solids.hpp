// Box, Sphere, Cone, Cylinder and Extrusion as faces: each is its outline, carried around or along.
#pragma once

#include "server/base/error.hpp"
#include "server/content/importer/faces.hpp"
#include "server/x3d/node_fields.hpp"

namespace mechane::content {

[[nodiscard]] Faces faces_of_box(const x3d::NodeFields& box);
/// Round things are polygons of 144 corners: they are thinner than a circle by a four-thousandth of its radius.
[[nodiscard]] Faces faces_of_sphere(const x3d::NodeFields& sphere);
[[nodiscard]] Faces faces_of_cone(const x3d::NodeFields& cone);
[[nodiscard]] Faces faces_of_cylinder(const x3d::NodeFields& cylinder);
/// `spine`, `crossSection`, `scale` and `orientation` have as many values as they need. Points of the spine that lie upon each other, or
/// in line, turn the cross-section as those before them do.
[[nodiscard]] Faces faces_of_extrusion(const x3d::NodeFields& extrusion);

}  // namespace mechane::content
