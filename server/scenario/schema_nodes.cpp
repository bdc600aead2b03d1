// The nodes of X3D that Mechane reads, with the fields that it reads.
#include <algorithm>
#include <iterator>

#include "server/scenario/schema.hpp"
#include "server/state/component_type.hpp"

namespace mechane::scenario {
namespace {

using enum ValueKind;

constexpr Key kDef{.name = "DEF", .summary = "its name: all else refers to it by this", .example = "INNER"};
constexpr Key kPosition{.name = "position",
                        .kind = vector,
                        .unit = "m",
                        .summary = "where its origin is at the start, in the world",
                        .example = "0 0.55 0",
                        .min = -state::kFarthest_m,
                        .max = state::kFarthest_m};
constexpr Key kOrientation{.name = "orientation",
                           .kind = rotation,
                           .unit = "rad",
                           .summary = "how it stands at the start: axis x y z, then the angle",
                           .example = "0 1 0 1.5708",
                           .min = -kLargest,
                           .max = kLargest};
constexpr Key kAnchor{.name = "anchorPoint",
                      .kind = vector,
                      .unit = "m",
                      .summary = "a point of the joint, in the world as it stands at the start",
                      .example = "0 0.55 0",
                      .min = -state::kFarthest_m,
                      .max = state::kFarthest_m};
constexpr Key kAxis{.name = "axis",
                    .kind = vector,
                    .summary = "its direction, in the world as it stands at the start; any length but 0",
                    .example = "0 0 1",
                    .min = -kLargest,
                    .max = kLargest};

constexpr Key kX3d[] = {
    {.name = "version", .summary = "of X3D", .example = "4.0", .required = true},
    {.name = "profile", .summary = "which parts of X3D a reader must know", .example = "Interactive"},
};
constexpr Key kUnit[] = {
    {.name = "category", .summary = "what is measured", .example = "length"},
    {.name = "name", .summary = "what the unit is called", .example = "metre"},
    {.name = "conversionFactor",
     .kind = number,
     .summary = "1: everything is in metres, kilograms, seconds and radians",
     .example = "1"},
};
constexpr Key kWorldInfo[] = {
    {.name = "title", .summary = "for people", .example = "Archimedes' screw"},
    {.name = "info", .kind = strings, .summary = "for people", .example = "\"after Vitruvius\""},
};
constexpr Key kInline[] = {
    kDef,
    {.name = "url",
     .kind = strings,
     .summary = "the mesh file (.glb), by its path from this file",
     .example = "\"../models/screw.glb\"",
     .required = true},
};
constexpr Key kViewpoint[] = {
    kDef,
    {.name = "description", .summary = "its name in lists; displays ask for it", .example = "front"},
    {.name = "position",
     .kind = vector,
     .unit = "m",
     .summary = "where the eye is",
     .example = "0 1.2 4",
     .min = -kLargest,
     .max = kLargest},
    {.name = "orientation",
     .kind = rotation,
     .unit = "rad",
     .summary = "how the eye is turned from looking along -z with y up",
     .example = "1 0 0 -0.12",
     .min = -kLargest,
     .max = kLargest},
    {.name = "fieldOfView", .kind = number, .unit = "rad", .summary = "how wide it sees", .example = "0.7854"},
};
constexpr Key kCollection[] = {
    {.name = "gravity",
     .kind = vector,
     .unit = "m/s2",
     .summary = "how all bodies fall",
     .example = "0 -9.81 0",
     .min = -1e3,
     .max = 1e3},
};
constexpr Key kRigidBody[] = {
    kDef,
    {.name = "fixed", .kind = boolean, .summary = "true: it never moves, and its mass does not matter"},
    {.name = "mass",
     .kind = number,
     .unit = "kg",
     .summary = "of the real thing",
     .example = "42",
     .min = 0,
     .max = 1e6},
    {.name = "inertia",
     .kind = matrix,
     .unit = "kg m2",
     .summary = "about the centre of mass, row by row; left out: computed from the mass and the mesh, as of a "
                "uniform solid, or of a thin shell where the mesh is open; without a mesh 1 about every axis",
     .example = "20.4 0 0 0 20.3 0 0 0 0.35",
     .min = -1e12,
     .max = 1e12},
    {.name = "centerOfMass",
     .kind = vector,
     .unit = "m",
     .summary = "from its origin, in its own frame",
     .example = "0 0 0.1",
     .min = -state::kFarthest_m,
     .max = state::kFarthest_m},
    kPosition,
    kOrientation,
    {.name = "useGlobalGravity", .kind = boolean, .summary = "false: it floats, as if balanced"},
    {.name = "autoDamp", .kind = boolean, .summary = "true: the two factors below slow it down"},
    {.name = "linearDampingFactor",
     .kind = number,
     .summary = "share of its speed lost in a second",
     .example = "0.9",
     .min = 0,
     .max = 1},
    {.name = "angularDampingFactor",
     .kind = number,
     .summary = "share of its turning lost in a second",
     .example = "0.5",
     .min = 0,
     .max = 1},
    {.name = "linearVelocity",
     .kind = vector,
     .unit = "m/s",
     .summary = "how fast its centre of mass moves at the start, in the world",
     .example = "0 0 2",
     .min = -1e3,
     .max = 1e3},
    {.name = "angularVelocity",
     .kind = vector,
     .unit = "rad/s",
     .summary = "how it turns at the start, in the world",
     .example = "0 6.28 0",
     .min = -1e3,
     .max = 1e3},
    {.name = "forces",
     .kind = vector,
     .unit = "N",
     .summary = "that act on its centre of mass all the time, in the world; several add up",
     .example = "0 0 3",
     .min = -1e6,
     .max = 1e6},
    {.name = "torques",
     .kind = vector,
     .unit = "N m",
     .summary = "that turn it all the time, in the world; several add up",
     .example = "3 0 0",
     .min = -1e6,
     .max = 1e6},
    {.name = "visible", .kind = boolean, .summary = "false: not drawn"},
};
constexpr Key kHinge[] = {
    kDef,
    kAnchor,
    kAxis,
    {.name = "minAngle",
     .kind = number,
     .unit = "rad",
     .summary = "how far it turns back; with both stops at a half turn or more it turns on for ever",
     .example = "-1.2"},
    {.name = "maxAngle", .kind = number, .unit = "rad", .summary = "how far it turns", .example = "1.2"},
};
constexpr Key kSlider[] = {
    kDef,
    kAxis,
    {.name = "minSeparation",
     .kind = number,
     .unit = "m",
     .summary = "how far it slides back",
     .example = "0",
     .min = -state::kFarthest_m,
     .max = state::kFarthest_m},
    {.name = "maxSeparation",
     .kind = number,
     .unit = "m",
     .summary = "how far it slides",
     .example = "0.4",
     .min = -state::kFarthest_m,
     .max = state::kFarthest_m},
};
constexpr Key kBall[] = {kDef, kAnchor};

constexpr Table kNodeTables[] = {
    {"X3D", "the file", kX3d},
    {"unit", "in the head: a unit of the file's numbers", kUnit},
    {"WorldInfo", "under the Scene: carries `mechane:scenario`", kWorldInfo},
    {"Inline", "under the Scene: a mesh file; bodies take their shapes from its nodes", kInline},
    {"Viewpoint", "under the Scene: where a display may look from", kViewpoint},
    {"RigidBodyCollection", "under the Scene: bodies and the joints between them", kCollection},
    {"RigidBody", "a body: what can be touched, moved, or stands in the way", kRigidBody},
    {"SingleAxisHingeJoint", "body2 turns about an axis against body1", kHinge},
    {"SliderJoint", "body2 slides along an axis against body1", kSlider},
    {"BallJoint", "body2 turns about a point against body1", kBall},
};

}  // namespace

std::span<const Table> node_tables() {
  return kNodeTables;
}

const Table* find_node_table(std::string_view node_type) {
  const auto it =
      std::find_if(std::begin(kNodeTables), std::end(kNodeTables), [&](const Table& t) { return t.name == node_type; });
  return it == std::end(kNodeTables) ? nullptr : &*it;
}

}  // namespace mechane::scenario
