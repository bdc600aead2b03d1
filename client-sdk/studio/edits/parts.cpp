#include "client-sdk/studio/edits/parts.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace mechane::studio {
namespace {

/// Of oak, but for the post, which stands fast. Inertias are those of the solid shapes, about the body's origin.
constexpr std::array<Part, 7> kParts{{
    {"box",
     "BOX",
     "Κουτί",
     "Box",
     "mass='1.2' inertia='0.0029 0 0 0 0.0029 0 0 0 0.0029'",
     "0.2",
     {{{"SHAPE", "", "0.55 0.4 0.25", "<Box size='0.12 0.12 0.12'/>"}}}},
    {"ball",
     "BALL",
     "Σφαίρα",
     "Ball",
     "mass='0.63' inertia='0.0009 0 0 0 0.0009 0 0 0 0.0009'",
     "0.2",
     {{{"SHAPE", "", "0.6 0.35 0.2", "<Sphere radius='0.06'/>"}}}},
    {"cylinder",
     "CYLINDER",
     "Κύλινδρος",
     "Cylinder",
     "mass='1.6' inertia='0.0068 0 0 0 0.0029 0 0 0 0.0068'",
     "0.2",
     {{{"SHAPE", "", "0.5 0.42 0.3", "<Cylinder radius='0.06' height='0.2'/>"}}}},
    {"post",
     "POST",
     "Στύλος",
     "Post",
     "fixed='true'",
     "",
     {{{"SHAPE", "", "0.45 0.38 0.3", "<Box size='0.1 1 0.1'/>"}}}},
    // Its axle is the body's z axis; the handle is 0.25 m from it. Taken as balanced.
    {"crank",
     "CRANK",
     "Μανιβέλα",
     "Crank",
     "mass='1.5' inertia='0.03 0 0 0 0.004 0 0 0 0.031'",
     "0.2",
     {{{"ARM", " translation='0 0.12 0'", "0.4 0.4 0.42", "<Box size='0.05 0.3 0.03'/>"},
       {"HANDLE", " translation='0 0.25 0.09' rotation='1 0 0 1.5708'", "0.55 0.4 0.25",
        "<Cylinder radius='0.02' height='0.15'/>"}}}},
    // Along the body's z axis.
    {"drum",
     "DRUM",
     "Τύμπανο",
     "Drum",
     "mass='3.2' inertia='0.046 0 0 0 0.046 0 0 0 0.0058'",
     "0.2",
     {{{"SHAPE", " rotation='1 0 0 1.5708'", "0.55 0.42 0.28", "<Cylinder radius='0.06' height='0.4'/>"}}}},
    {"wheel",
     "WHEEL",
     "Τροχός",
     "Wheel",
     "mass='8' inertia='0.183 0 0 0 0.183 0 0 0 0.36'",
     "0.1",
     {{{"SHAPE", " rotation='1 0 0 1.5708'", "0.5 0.38 0.25", "<Cylinder radius='0.3' height='0.06'/>"}}}},
}};

constexpr std::string_view kTaken = R"(
    <MetadataDouble containerField='value' name='effortScale' value='{}'/>
    <MetadataBoolean containerField='value' name='graspable' value='true'/>)";
constexpr std::string_view kFixed = R"(
    <MetadataDouble containerField='value' name='stiffness' value='800'/>)";
constexpr std::string_view kShape = R"(
  <CollidableShape DEF='{}_{}' containerField='geometry'{}>
    <Shape containerField='shape'>
      <Appearance><Material diffuseColor='{}'/></Appearance>
      {}
    </Shape>
  </CollidableShape>)";

}  // namespace

std::span<const Part> parts() {
  return kParts;
}

const Part* find_part(std::string_view name) {
  const auto found = std::ranges::find(kParts, name, &Part::name);
  return found == kParts.end() ? nullptr : &*found;
}

std::vector<std::string> part_names() {
  std::vector<std::string> names(kParts.size());
  std::ranges::transform(kParts, names.begin(), [](const Part& part) { return std::string(part.name); });
  return names;
}

std::string text_of(const Part& part, std::string_view def, std::string_view position) {
  std::string text = fmt::format("<RigidBody DEF='{}' {} position='{}'>", def, part.body, position);
  text += "\n  <MetadataSet containerField='metadata' name='mechane:haptic'>";
  text += part.effort.empty() ? std::string(kFixed) : fmt::format(kTaken, part.effort);
  text += "\n  </MetadataSet>";
  for (const PartShape& shape : part.shapes)
    if (!shape.geometry.empty())
      text += fmt::format(kShape, def, shape.suffix, shape.place, shape.colour, shape.geometry);
  return text + "\n</RigidBody>";
}

}  // namespace mechane::studio
