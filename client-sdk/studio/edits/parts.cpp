#include "client-sdk/studio/edits/parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace mechane::studio {
namespace {

constexpr std::string_view kAlongZ = " rotation='1 0 0 1.5708'";
constexpr std::string_view kBronze = "0.62 0.46 0.26";

/// Of oak, but for the post, which stands fast. Inertias are those of the solid shapes, about the body's origin.
constexpr std::array<Part, 10> kParts{{
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
    // Spur gears about the body's z axis: a tooth for each centimetre of the radius, so that all mesh with each other, their axles as far
    // apart as their radii together. The peg shows how they turn.
    {"gear-12",
     "GEAR",
     "Γρανάζι, 12 δόντια",
     "Gear, 12 teeth",
     "mass='1.9' inertia='0.0074 0 0 0 0.0074 0 0 0 0.0137'",
     "0.2",
     {{{"TEETH_12", kAlongZ, kBronze, ""},
       {"PEG", " translation='0 0.06 0.05' rotation='1 0 0 1.5708'", "0.45 0.38 0.3",
        "<Cylinder radius='0.015' height='0.06'/>"}}},
     12},
    {"gear-24",
     "GEAR",
     "Γρανάζι, 24 δόντια",
     "Gear, 24 teeth",
     "mass='7.6' inertia='0.112 0 0 0 0.112 0 0 0 0.219'",
     "0.1",
     {{{"TEETH_24", kAlongZ, kBronze, ""},
       {"PEG", " translation='0 0.16 0.05' rotation='1 0 0 1.5708'", "0.45 0.38 0.3",
        "<Cylinder radius='0.02' height='0.06'/>"}}},
     24},
    {"gear-36",
     "GEAR",
     "Γρανάζι, 36 δόντια",
     "Gear, 36 teeth",
     "mass='17.1' inertia='0.559 0 0 0 0.559 0 0 0 1.11'",
     "0.1",
     {{{"TEETH_36", kAlongZ, kBronze, ""},
       {"PEG", " translation='0 0.27 0.05' rotation='1 0 0 1.5708'", "0.45 0.38 0.3",
        "<Cylinder radius='0.025' height='0.06'/>"}}},
     36},
}};

constexpr std::string_view kTaken = R"(
  <MetadataSet containerField='{}' name='mechane:haptic'>
    <MetadataDouble containerField='value' name='effortScale' value='{}'/>
    <MetadataBoolean containerField='value' name='graspable' value='true'/>
  </MetadataSet>)";
constexpr std::string_view kFixed = R"(
  <MetadataSet containerField='metadata' name='mechane:haptic'>
    <MetadataDouble containerField='value' name='stiffness' value='800'/>
  </MetadataSet>)";
/// Teeth that mesh do not push each other away: what joins them is the gear's agent.
constexpr std::string_view kMeshing = R"(
  <MetadataSet containerField='metadata' name='mechane'>
  <MetadataSet containerField='value' name='mechane:body'>
    <MetadataBoolean containerField='value' name='collides' value='false'/>
  </MetadataSet>{}
  </MetadataSet>)";
constexpr std::string_view kShape = R"(
  <CollidableShape DEF='{}_{}' containerField='geometry'{}>
    <Shape containerField='shape'>
      <Appearance><Material diffuseColor='{}'/></Appearance>
      {}
    </Shape>
  </CollidableShape>)";

/// The outline of a gear's teeth in metres, swept along its axle. Teeth begin a quarter of their distance after the x axis: two gears
/// beside or above each other mesh as they are inserted, for both have a number of teeth that 4 divides.
std::string gear_text(int teeth) {
  constexpr double kTooth = 0.01, kTip = 0.018, kFoot = 0.022;  // m; of the radius, over and under it
  constexpr double kHalfTip = 0.16, kHalfFoot = 0.34;           // of the distance from tooth to tooth
  const double radius = kTooth * teeth, pitch = 2 * std::numbers::pi / teeth;
  std::string outline;
  for (int i = 0; i <= 4 * teeth; ++i) {
    const int corner = i % 4;
    const double r = corner == 1 || corner == 2 ? radius + kTip : radius - kFoot;
    const double half = corner == 1 || corner == 2 ? kHalfTip : kHalfFoot;
    const double angle = (i / 4 % teeth + 0.25 + (corner < 2 ? -half : half)) * pitch;
    outline += fmt::format("{}{:.4f} {:.4f}", i == 0 ? "" : "  ", r * std::cos(angle), -r * std::sin(angle));
  }
  return fmt::format("<Extrusion convex='false' creaseAngle='0.3' spine='0 -0.03 0  0 0.03 0' crossSection='{}'/>",
                     outline);
}

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
  const bool meshes = part.teeth > 0;
  const std::string haptic =
      part.effort.empty() ? std::string(kFixed) : fmt::format(kTaken, meshes ? "value" : "metadata", part.effort);
  text += meshes ? fmt::format(kMeshing, haptic) : haptic;
  for (const PartShape& shape : part.shapes) {
    const bool is_gear = meshes && &shape == part.shapes.data();
    if (!shape.geometry.empty() || is_gear)
      text += fmt::format(kShape, def, shape.suffix, shape.place, shape.colour,
                          is_gear ? gear_text(part.teeth) : std::string(shape.geometry));
  }
  return text + "\n</RigidBody>";
}

}  // namespace mechane::studio
