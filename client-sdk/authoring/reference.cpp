#include "client-sdk/authoring/reference.hpp"

#include <limits>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "client-sdk/authoring/reference_example.hpp"
#include "server/agents/registry.hpp"
#include "server/machines/registry.hpp"
#include "server/scenario/schema.hpp"
#include "server/state/component_type.hpp"
#include "server/x3d/schema.hpp"

namespace mechane::authoring {
namespace {

constexpr std::string_view kIntroduction = R"(# The scenario format

An exhibit of Mechane is one X3D file with mesh files (`.glb`) beside it. X3D is a standard for scenes in XML; any text editor opens it.
X3D says what is where: bodies, the joints between them, the viewpoints. What X3D cannot say, what visitors do and what
happens then, is written in its metadata, in sets whose names begin with `mechane:`.

This page lists everything that may be written. `mechane reference` makes it from the tables by which the program itself reads files.

## How to work

1. Copy an exhibit that is like yours, or the example below, and give it a new `id`: a server cannot have two exhibits with the same id.
2. Change it, and run `mechane check FILE.x3d`. It names each mistake with its line, and says what to write instead.
   With errors the exhibit cannot run; warnings are of what is likely not meant; notes are of what Mechane ignores.
3. Try it: `mechane server --scenario FILE.x3d`, in another window `mechane display`, and in a third `mechane visitor --scenario FILE.x3d`,
   which plays its visits as a hand would. After a change restart the server: the display finds it. A copy in another folder needs its
   mesh files where its `url` says.
4. `mechane merge A.x3d B.x3d -o C.x3d` puts two exhibits into one.

## How to write a value

| a key of the type | is written as |
|---|---|
| text | `<MetadataString containerField='value' name='KEY' value='"words"'/>` |
| texts | `<MetadataString containerField='value' name='KEY' value='"one" "two"'/>` |
| number | `<MetadataDouble containerField='value' name='KEY' value='0.25'/>` |
| 3 numbers | `<MetadataDouble containerField='value' name='KEY' value='0 0.8 0.75'/>`: x y z, y is up |
| 4 numbers | `<MetadataDouble containerField='value' name='KEY' value='0 1 0 1.5708'/>`: an axis, then the angle about it in radians |
| yes or no | `<MetadataBoolean containerField='value' name='KEY' value='true'/>` |
| set | `<MetadataSet containerField='value' name='KEY'> ... </MetadataSet>` |

- `containerField` is always written: `'metadata'` for the set on a node itself, `'value'` for everything in a set.
- Lengths are metres, masses kilograms, times seconds, angles radians. A half turn is 3.1416, a quarter 1.5708.
- The letters `&`, `<` and, in single quotes, `'` are written `&amp;`, `&lt;` and `&apos;`. Greek needs no tricks: save as UTF-8.
- You choose the names, but each name is used once. Names are how things find each other: a joint finds its bodies, a trigger its quantity.

## An example

A wheel on a post. A visitor takes its rim and turns it once. The mesh file has two nodes, `POST` and `WHEEL`.

```xml
)";

constexpr std::string_view kMeshIntroduction = R"(
## The mesh file

A `.glb` (glTF 2.0 in one file), in metres, with y up, as Blender exports it. Its nodes are found by their names:

| a node | what becomes of it |
|---|---|
| of a body's name, or the one that the body's `node` names | the body's shape, with all that lies below it. What counts is how the shape lies in the node; where the node lies in the file does not matter |
| `part_*` below such a node | what a hand feels: a closed surface, best near to convex. Where a body has none, each mesh is such a part |
| `SCENE` | ground and scenery: drawn where it is in the file, and cannot be touched |
| `WATER_*` | drawn as water. A `level` effect raises it: let it lie at the floor. A `flow` lets it flow, and carries it on over the plain where the model ends: let it reach the model's border, straight across |
| any other | is not drawn |

What a material named `earth` paints looks like the plain that a display lays about the exhibit, whatever its own colours: its edge is not seen, and
trees grow about `SCENE`, 13 m beyond it and its viewpoint (unless the model is a landscape, 40 m or more in any direction).

`mechane fit FILE.glb` shows how true each part feels.
)";

constexpr std::string_view kShapesIntroduction = R"(
## Shapes without a modelling program

X3D has shapes of its own, and a body may have them in place of a mesh file: its `geometry` is a `CollidableShape` with a `Shape`, or
several, each shifted and turned by `translation` and `rotation` (`CollidableOffset` shifts what it holds once more). This is a whole file,
which runs as it is: a ball falls onto a table.

```xml
)";

constexpr std::string_view kShapesRules = R"(```

- Shapes are `Box`, `Sphere`, `Cone`, `Cylinder`, `Extrusion`, `ElevationGrid`, `IndexedFaceSet`, `IndexedTriangleSet` and `TriangleSet`.
  Their looks are an `Appearance` with `Material` or `PhysicalMaterial`, and `ImageTexture`s in the file's folder (PNG, JPEG).
- A body with a `geometry` collides with others that have one, unless its `mechane:body` says otherwise. Where that names a `model`, the
  model is the shape.
- Where a `ROUTE` leads a body's `position` or `orientation` to a `Transform`, that Transform is what is seen of the body; else its
  `geometry` is.
- All other shapes, in groups and `Transform`s, are scenery: they are seen and touched where they are, and do not collide with bodies. An
  `Inline` of an X3D file in this file's folder is a part of it; one that a body names as its `model` is a mesh file like a `.glb`, in which
  nodes have their `DEF` for a name.
- A `CollisionCollection` gives the bodies of its `collidables` their `bounce` and, where its `appliedParameters` say so, the first of its
  `frictionCoefficients`.
- Events run in the world's time, from the beginning of its activity: `TimeSensor`, `ScalarInterpolator`, `PositionInterpolator`,
  `OrientationInterpolator`, `ScalarDamper`, `PositionDamper`, `OrientationDamper`, `CollisionSensor`, `ProximitySensor` (of hands),
  `BooleanFilter`, `BooleanToggle`, `BooleanTrigger`, `TimeTrigger`, and `ROUTE`s among them. They move a `Transform` with shapes
  (`translation`, `rotation`), which is then a body of its `DEF`, and a `RigidBody` with `fixed='true'` (`position`, `orientation`), which
  pushes others. What a body does can be routed on, and quantities can read each field, such as `CLOCK.fraction_changed` and
  `DAMPER.value_changed.x`. A `startTime` of 0 is past: without `loop`, such a clock waits for an event.
- A file without `mechane:scenario` moves as X3D has it: without `autoDamp` nothing slows its bodies down.
- VRML files (`.wrl`, `.x3dv`) are not read: `tovrmlx3d --encoding xml IN.wrl > OUT.x3d` makes X3D of them.
)";

constexpr std::string_view kNodesIntroduction = R"(
## Nodes of X3D

Attributes of these elements are read. All other nodes and attributes of X3D 4.0 may stand in the file, and other X3D programs show
them: backgrounds, lights and navigation without a word, the rest with a note from `mechane check` that it is not simulated.
Every element may have `DEF` (its name), `USE` (it stands for the element of that name) and `containerField` (which field of its
parent it fills). Two bodies in a joint are `<RigidBody containerField='body1' USE='POST'/>` and the same with `body2`, the one that moves.
)";

constexpr std::string_view kFormulaRules = R"(
## Formulas

The parameters of `machine.formula` are formulas. Each value is `NAME = FORMULA`, or `NAME = FORMULA in UNIT`: then a quantity can read it
as `MACHINE.NAME`, in that unit (`in 1`: a pure number). Values are computed a thousand times a second in the order in which they stand.

| in a formula | is |
|---|---|
| `9.81 m/s^2`, `3 N m/rad`, `5 l/min`, `20 degC` | a number with its unit: a blank between words, none at a slash |
| `AXLE.angle`, `AXLE.position`, `AXLE.rate` | of a joint: rad and rad/s of a hinge, m and m/s of a slider |
| `quantity.NAME` | a quantity, in its unit, as it was at the beginning of the tick |
| `NAME` | a value that stands before this one |
| `last(NAME)` | what this value, or one after it, was a tick ago; its formula must end with its unit |
| `+ - * / ^`, `( )`, `pi` | as usual; after `^` a whole number from -9 to 9 |
| `< <= > >=`, `and or not` | conditions; in XML `<` is written `&lt;` |
| `if(CONDITION, A, B)`, `step(CONDITION)` | A or B; 1 or 0 |
| `min(A, B)`, `max(A, B)`, `clamp(A, LOW, HIGH)`, `abs(A)`, `sqrt(A)`, `sin(A)`, `cos(A)` | as usual |
| `integral(RATE, START, LOW, HIGH)` | grows by RATE in a second, from START, and never leaves LOW to HIGH; the last three may be left out |
| `count(CONDITION)`, `sum(A, CONDITION)` | how often the condition has become true; the sum of what A was each time |

- **Units are checked.** Both sides of `+` and of a comparison must have the same unit, and a load must come out in N m for a hinge, in N
  for a slider or a force; `mechane check` says which part is in which unit. Angles are pure numbers, as in SI: N m/rad is N m. A bare 0
  fits all.
- Units are made of m, cm, mm, km, l, ml, kg, g, t, s, ms, min, h, Hz, rpm, N, kN, J, kJ, W, kW, Pa, kPa, bar, K, degC, rad, deg, turns
  and %, with powers like `m2`, `m^2` or `m²`.
- **There is always a number.** A division by zero and the root of a negative number give 0, and what is beyond 1e30 is 1e30;
  `MACHINE.faults` counts the ticks in which that happened. The branch of an `if` that is not taken does not count.
- A load is never beyond `limit`. `load` is signed as the joint's position; `resistance` only brakes.
- A quantity that is read must have the unit of its source. One that reads another machine is a tick late, and so is `last`.
)";

constexpr std::string_view kWaterRules = R"(
## Water networks

The lists of `machine.water_network`. Each part is `NAME: KEY VALUE, KEY VALUE`. Numbers are written with their units, and may be computed
(`area pi * (5 cm)^2`); where FORMULA stands, all of the chapter above may be used. Heights are the world's, so that 0 is its y = 0.

| list | key | what it is |
|---|---|---|
| `vessels` | `area 0.02 m2`, `height 0.3 m` | cross section, and height of the walls; both are needed |
| | `floor 0.5 m` | the height of its floor; not written: 0 |
| | `start 2 l` | the water in it at the start; not written: none |
| | `air BELL` | it is closed, and over its water is this air; vessels that name the same air share it. Not written: it is open |
| | `vent FORMULA` | above 0.5 a vent lets its air in or out, as in `vent step(PLUG.position > 1 cm)` |
| | `on PAIL.body` | its water weighs on this body, at its origin |
| `pipes` | `from TANK at 0.5 m` | the vessel that it leaves, and the height of its mouth there |
| | `to TUB at 0.1 m`, `to air` | where it leads; without a height it ends as high as it begins. Water may fall into an open vessel |
| | `bore 8 mm` | its width; it is needed |
| | `discharge 0.8` | share of what Torricelli's law gives: 0.6 (not written) is a hole with a sharp edge, 0.8 a short spout |
| | `open FORMULA` | a valve: the share that is open, from 0 to 1, as in `open TAP.angle / 1.5 rad`; not written: 1 |
| | `crest 0.9 m` | a siphon: it starts once water stands over this height, and runs until its mouth in `from` is dry |
| | `oneway` | a flap keeps water from running back |
| `feeds` | `into TANK`, `flow FORMULA` | a spring or a pump, as in `flow 2 l/min`; less than 0 is 0 |
| `floats` | `in TANK`, `of CORK.body` | a body, guided by a slider or a hinge, that this vessel's water lifts |
| | `area 40 cm2`, `height 3 cm` | of the part that swims, an upright prism |
| | `bottom -2 cm` | its underside over the body's origin; not written: half of `height` below it |

Quantities can read, and the network's own formulas without `MACHINE.`:

| value | unit | what it is |
|---|---|---|
| `MACHINE.VESSEL_level`, `MACHINE.VESSEL_volume` | m, l | how deep its water is, from its floor; how much it is |
| `MACHINE.VESSEL_pressure` | Pa | of its air, more than the room's |
| `MACHINE.VESSEL_overflow` | l/s | what runs over its rim |
| `MACHINE.PIPE_flow`, `MACHINE.FEED_flow` | l/s | what runs through; a pipe's is below 0 while water runs back |
| `MACHINE.FLOAT_lift` | N | the force on the body |

- Water goes by Torricelli's law, as long as its mouth is under water: never more than stands over the mouth, finds room, or makes the
  levels equal. What was there at the start and what feeds supplied is always in the vessels, delivered or spilled.
- **An overflow** is a vessel's rim, or a pipe at the height that its water must not pass. What runs over a rim is gone; to catch it,
  write a wide pipe just below the rim.
- **A valve that a float works**: `open (0.3 m - TANK_level) / 1 cm` on a pipe into TANK shuts as TANK fills.
- Shut-in air keeps its temperature: half the room, twice the pressure. It leaves by its vent alone: a pipe whose mouth is above the water
  lets no air through.
- A float is slowed as a body in water is. It does not raise the water that it swims in. A joint that guides it starts where the body stands
  in the file: best where it swims.
- Formulas see joints as they are, and the network's values and quantities as they were a tick ago.
)";

constexpr std::string_view kMetadataIntroduction = R"(
## Metadata

A name in capitals or a star stands for a name of your own: `trigger:*` is `trigger:1`, `trigger:2` and so on.
)";

std::string_view kind_word(scenario::ValueKind kind) {
  switch (kind) {
    case scenario::ValueKind::string:
      return "text";
    case scenario::ValueKind::strings:
      return "texts";
    case scenario::ValueKind::number:
      return "number";
    case scenario::ValueKind::numbers:
      return "numbers";
    case scenario::ValueKind::vector:
      return "3 numbers";
    case scenario::ValueKind::rotation:
      return "4 numbers";
    case scenario::ValueKind::matrix:
      return "9 numbers";
    case scenario::ValueKind::boolean:
      return "yes or no";
    case scenario::ValueKind::set:
      return "set";
  }
  return "";
}

std::string code(std::string_view text) {
  return text.empty() ? std::string() : fmt::format("`{}`", text);
}

std::string range_in_words(double min, double max) {
  const bool has_min = min > -std::numeric_limits<double>::infinity();
  const bool has_max = max < std::numeric_limits<double>::infinity();
  if (has_min && has_max) return fmt::format("{} to {}", min, max);
  if (has_min) return fmt::format("{} or more", min);
  return has_max ? fmt::format("{} or less", max) : std::string();
}

std::string row(const std::vector<std::string>& cells) {
  return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

constexpr std::string_view kKeyHead =
    "| key | type | unit | range | default | what it is | example |\n|---|---|---|---|---|---|---|\n";

std::string choices_of(const scenario::Key& key) {
  std::string words;
  std::string_view left = key.choices;
  while (!left.empty()) {
    const std::size_t end = std::min(left.find(' '), left.size());
    words += (words.empty() ? "" : ", ") + code(left.substr(0, end));
    left.remove_prefix(std::min(end + 1, left.size()));
  }
  return words.empty() ? range_in_words(key.min, key.max) : words;
}

std::string default_of(const scenario::Key& key) {
  if (key.required) return key.unless.empty() ? "**required**" : fmt::format("**required** without `{}`", key.unless);
  if (key.kind == scenario::ValueKind::number) return fmt::format("{}", key.default_number);
  if (key.kind == scenario::ValueKind::boolean && !key.default_text.empty()) return std::string(key.default_text);
  if (key.kind == scenario::ValueKind::boolean) return key.default_number != 0 ? "true" : "false";
  return code(key.default_text);
}

std::string key_row(const scenario::Key& key) {
  return row({code(key.name), std::string(kind_word(key.kind)), std::string(key.unit), choices_of(key), default_of(key),
              std::string(key.summary), code(key.example)});
}

std::string node_row(const scenario::Key& key, const x3d::NodeType& type) {
  const x3d::Field* field = type.field(key.name);
  std::string value = field == nullptr ? "" : std::string(field->default_value);
  for (char& c : value)
    c = c == ',' ? ' ' : c;
  std::string range = choices_of(key);
  if (range.empty() && field != nullptr) range = field->range();
  return row({code(key.name), std::string(kind_word(key.kind)), std::string(key.unit), range,
              key.required ? "**required**" : code(value), std::string(key.summary), code(key.example)});
}

/// The words, beginning with a capital letter.
std::string sentence(std::string_view words) {
  std::string text(words);
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

std::string variation_text(const Variation& variation) {
  std::string text = fmt::format("\n## {}\n\n{}\n", variation.title, variation.introduction);
  for (const Variation::Piece& piece : variation.pieces)
    text += fmt::format("\n{}:\n\n```xml\n{}```\n", piece.where, piece.text);
  return text;
}

std::string node_tables_text() {
  std::string text(kNodesIntroduction);
  for (const scenario::Table& table : scenario::node_tables()) {
    text += fmt::format("\n### {}\n\n{}.\n\n{}", table.name, sentence(table.summary), kKeyHead);
    for (const scenario::Key& key : table.keys)
      text += node_row(key, *x3d::Schema::standard().find(table.name));
  }
  return text;
}

std::string key_tables_text() {
  std::string text(kMetadataIntroduction);
  for (const scenario::Table* table : scenario::all_tables()) {
    text += fmt::format("\n### {}\n\n{}.\n\n{}", table->name, sentence(table->summary), kKeyHead);
    for (const scenario::Key& key : table->keys)
      text += key_row(key);
  }
  return text;
}

std::string kind_of_parameter(const state::ParameterType& parameter) {
  switch (parameter.kind) {
    case state::ParameterKind::number:
      return "number";
    case state::ParameterKind::numbers:
      return parameter.count == 0 ? std::string("numbers") : fmt::format("{} numbers", parameter.count);
    case state::ParameterKind::text:
      return "text";
    case state::ParameterKind::texts:
      return "texts";
    case state::ParameterKind::boolean:
      return "yes or no";
  }
  return "";
}

std::string parameter_default(const state::ParameterType& parameter) {
  if (parameter.required) return "**required**";
  if (!parameter.default_text.empty()) return std::string(parameter.default_text);
  switch (parameter.kind) {
    case state::ParameterKind::number:
    case state::ParameterKind::numbers:
      return parameter.has_default() ? fmt::format("{}", parameter.default_value) : "";
    case state::ParameterKind::boolean:
      return parameter.default_value != 0 ? "true" : "false";
    default:
      return "";
  }
}

std::string range_of_value(const state::ValueType& value) {
  return value.max_parameter.empty() ? range_in_words(value.min, value.max)
                                     : fmt::format("{} to {}", value.min, code(value.max_parameter));
}

std::string component_text(const state::ComponentType& type) {
  std::string text = fmt::format("\n### {}\n\n{}.\n\n", type.name, type.summary);
  text += "| parameter | type | unit | range | default | what it is |\n|---|---|---|---|---|---|\n";
  for (const state::ParameterType& p : type.parameters) {
    text += row({code(p.name), kind_of_parameter(p), std::string(p.unit), range_in_words(p.min, p.max),
                 parameter_default(p), std::string(p.summary)});
  }
  if (type.values.empty()) return text;
  text += "\nQuantities can read:\n\n| value | unit | range | what it is |\n|---|---|---|---|\n";
  for (const state::ValueType& value : type.values) {
    text += row({code("NAME." + std::string(value.name)), std::string(value.unit), range_of_value(value),
                 std::string(value.summary)});
  }
  return text;
}

std::string components_text(std::string_view title, std::string_view introduction,
                            std::span<const state::ComponentType> types) {
  std::string text = fmt::format("\n## {}\n\n{}\n", title, introduction);
  for (const state::ComponentType& type : types)
    text += component_text(type);
  return text;
}

}  // namespace

std::string reference_page() {
  std::string page(kIntroduction);
  page += reference_example();
  page += "```\n";
  page += kMeshIntroduction;
  page += kShapesIntroduction;
  page += reference_shapes();
  page += kShapesRules;
  for (const Variation& variation : reference_variations())
    page += variation_text(variation);
  page += node_tables_text();
  page += key_tables_text();
  page += components_text(
      "Agents",
      "An agent makes things behave (`geometry.*`), changes how they feel (`touch.*`), or says what a visitor does "
      "with them\n(`simulation.*`). It is a set in `agents`,\n"
      "named as you like, with its `type` and its parameters; or it stands on a joint or body as "
      "the set `mechane:agent`, is called\n"
      "as that is, and need not name it again.\n\n"
      "**Which agents are on.** Steps switch agents on (`enable`) and off (`disable`). Every activity begins with "
      "all agents on, except those\nthat any step of the scenario enables, in this activity or another: they "
      "are off until a step enables them. A joint, tie or rope whose\nagent is off holds nothing: enable it in "
      "the first step, or its bodies fall meanwhile.\n\n"
      "**A snap that is off** leads nothing home any more, and lets go of nothing: a body that it has placed stays "
      "fixed there, and no hand\ncan take it, until a step writes `movable` true into its `object:NAME`. With "
      "`tied` the body stays tied; only a `geometry.breakable` parts it.",
      agents::registry());
  page += components_text(
      "Machines",
      "A machine is the physics behind a joint: water, springs, steam. It is a set in `machines`, as agents are.",
      machines::registry());
  page += kFormulaRules;
  page += kWaterRules;
  page += "\n## What else quantities can read\n\n| source | unit | what it is |\n|---|---|---|\n";
  page += row({"`JOINT.angle`, `JOINT.position`", "rad or m", "where body2 stands against body1; 0 at the start"});
  page += row({"`JOINT.turns`", "", "the angle in turns"});
  page += row({"`JOINT.rate`", "rad/s or m/s", "how fast it moves; with the unit `rpm`, turns a minute"});
  page += row({"`BODY.position.x`, `.y`, `.z`", "m", "where the body's origin is in the world"});
  page += row({"`BODY.speed`", "m/s", "how fast the body's origin moves: of what falls, or is thrown"});
  return page;
}

}  // namespace mechane::authoring
