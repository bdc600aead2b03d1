#include "server/scenario/schema.hpp"

#include <array>

#include <fmt/format.h>

namespace mechane::scenario {
namespace {

using enum ValueKind;

constexpr Key kScenarioKeys[] = {
    {.name = "format", .kind = number, .summary = "version of these tables", .example = "1", .required = true},
    {.name = "id",
     .summary = "the exhibit's name in logs and on the wire",
     .example = "\"archimedes-screw\"",
     .required = true},
    {.name = "languages",
     .kind = strings,
     .summary = "codes, the first is shown first",
     .example = "\"el\" \"en\"",
     .required = true},
    {.name = "effortScale",
     .kind = number,
     .summary = "share of a machine's loads that the hand feels",
     .example = "0.06",
     .default_number = 1,
     .min = 1e-4,
     .max = 1},
    {.name = "text", .kind = set, .summary = "title.<language>"},
    {.name = "agents", .kind = set, .summary = "sets named as the agents, each with its type and parameters"},
    {.name = "machines", .kind = set, .summary = "sets named as the machines, each with its type and parameters"},
    {.name = "quantities",
     .kind = set,
     .summary = "what rules and displays read: a set, or a string with the source, each"},
    {.name = "activities", .kind = set, .summary = "sets named as the activities", .required = true},
    {.name = "visits", .kind = set, .summary = "sets named as the scripted visits"},
};

constexpr Key kQuantityKeys[] = {
    {.name = "source", .summary = "<component>.<value>", .example = "\"PUMP.basin_l\"", .required = true},
    {.name = "unit", .summary = "as a visitor reads it; rpm and deg convert", .example = "\"l\""},
};

constexpr Key kActivityKeys[] = {
    {.name = "first", .summary = "the step to begin with; else the first one written", .example = "\"grasp\""},
    {.name = "text", .kind = set, .summary = "title.<language>"},
    {.name = "steps", .kind = set, .summary = "sets named as the steps", .required = true},
};

constexpr Key kStepKeys[] = {
    {.name = "enable", .kind = strings, .summary = "agents to switch on", .example = "\"HINGE\""},
    {.name = "disable", .kind = strings, .summary = "agents to switch off", .example = "\"SNAP\""},
    {.name = "object:*", .kind = set, .summary = "what changes of a body", .example = "object:INNER"},
    {.name = "text", .kind = set, .summary = "caption.<language>, narration.<language>, hint.<language>"},
    {.name = "trigger:*", .kind = set, .summary = "what ends the step", .example = "trigger:1"},
    {.name = "hintSeconds",
     .kind = number,
     .unit = "s",
     .summary = "when the hint is shown",
     .example = "20",
     .default_number = 20,
     .min = 0,
     .max = 3600},
};

constexpr Key kOverrideKeys[] = {
    {.name = "movable", .kind = boolean, .summary = "false: held still"},
    {.name = "visible", .kind = boolean, .summary = "false: not drawn"},
    {.name = "graspable", .kind = boolean, .summary = "a hand may take it"},
    {.name = "position",
     .kind = vector,
     .unit = "m",
     .summary = "put it there when the step begins, in W",
     .example = "0 0.8 0.75"},
    {.name = "orientation",
     .kind = rotation,
     .unit = "rad",
     .summary = "turn it so when the step begins, in W",
     .example = "0 1 0 1.57"},
};

constexpr Key kTriggerKeys[] = {
    {.name = "quantity", .summary = "what is compared", .example = "\"level\"", .required = true},
    {.name = "op", .summary = "how", .example = "\">\"", .required = true, .choices = "< = >"},
    {.name = "value",
     .kind = number,
     .summary = "with what, in the quantity's unit",
     .example = "40",
     .required = true},
    {.name = "tolerance", .kind = number, .summary = "how near is equal", .default_number = 1e-6, .min = 0},
    {.name = "holdSeconds",
     .kind = number,
     .unit = "s",
     .summary = "how long it must hold",
     .example = "0.3",
     .min = 0,
     .max = 3600},
    {.name = "next",
     .summary = "the step that follows; end: the activity is done",
     .example = "\"turn\"",
     .default_text = "end"},
};

constexpr Key kTextKeys[] = {
    {.name = "*", .kind = string, .summary = "<what>.<language>", .example = "caption.el"},
};

constexpr Key kVisitKeys[] = {
    {.name = "activity", .summary = "which activity it plays", .example = "\"use\"", .required = true},
    {.name = "move:*", .kind = set, .summary = "the moves, played in the order written", .example = "move:1"},
};

constexpr Key kMoveKeys[] = {
    {.name = "kind",
     .summary = "what the hand does",
     .example = "\"reach\"",
     .required = true,
     .choices = "reach grasp move_to turn release wait"},
    {.name = "body", .summary = "reach, grasp, move_to: of which body", .example = "\"INNER\""},
    {.name = "grip",
     .kind = vector,
     .unit = "m",
     .summary = "reach: the grip's centre in the body's frame",
     .example = "0.25 0 1.36"},
    {.name = "position",
     .kind = vector,
     .unit = "m",
     .summary = "move_to: where the body goes, in W",
     .example = "0 0.55 0"},
    {.name = "orientation",
     .kind = rotation,
     .unit = "rad",
     .summary = "move_to: how the body stands, in W",
     .example = "0 1 0 1.57"},
    {.name = "joint", .summary = "turn: which joint", .example = "\"HINGE\""},
    {.name = "turns", .kind = number, .summary = "turn: how far", .example = "8", .min = -1000, .max = 1000},
    {.name = "rpm",
     .kind = number,
     .unit = "1/min",
     .summary = "turn: how fast",
     .example = "30",
     .default_number = 20,
     .min = 0.1,
     .max = 300},
    {.name = "seconds",
     .kind = number,
     .unit = "s",
     .summary = "how long, but for turn",
     .example = "1.5",
     .default_number = 1,
     .min = 0,
     .max = 600},
};

constexpr Key kHapticKeys[] = {
    {.name = "stiffness",
     .kind = number,
     .unit = "N/m",
     .summary = "how hard it feels",
     .example = "600",
     .default_number = 600,
     .min = 0,
     .max = 20000},
    {.name = "damping",
     .kind = number,
     .unit = "N s/m",
     .summary = "how dull",
     .example = "1.5",
     .default_number = 1.5,
     .min = 0,
     .max = 100},
    {.name = "staticFriction",
     .kind = number,
     .summary = "before it slips",
     .example = "0.5",
     .default_number = 0.5,
     .min = 0,
     .max = 4},
    {.name = "dynamicFriction",
     .kind = number,
     .summary = "while it slips",
     .example = "0.3",
     .default_number = 0.3,
     .min = 0,
     .max = 4},
    {.name = "effortScale",
     .kind = number,
     .summary = "share of its weight that the hand lifts",
     .example = "0.05",
     .default_number = 1,
     .min = 1e-4,
     .max = 1},
    {.name = "graspable", .kind = boolean, .summary = "a hand may take it"},
};

constexpr Key kBodyKeys[] = {
    {.name = "model",
     .summary = "DEF of the Inline whose file holds the shape",
     .example = "\"MODEL\"",
     .required = true},
    {.name = "node", .summary = "the node in that file; else the one named as the body", .example = "\"INNER\""},
    {.name = "touchable", .kind = boolean, .summary = "false: drawn only", .default_number = 1},
    {.name = "collides",
     .kind = boolean,
     .summary = "with every other body that does, but for those joined or snapped to it"},
    {.name = "restitution",
     .kind = number,
     .summary = "share of its speed that a collision gives back",
     .example = "0.2",
     .min = 0,
     .max = 1},
};

constexpr Table kScenario{"mechane:scenario", "on the WorldInfo: all that X3D itself cannot say", kScenarioKeys};
constexpr Table kQuantity{"quantity", "a number with a name", kQuantityKeys};
constexpr Table kActivity{"activity", "a task for a visitor", kActivityKeys};
constexpr Table kStep{"step", "one thing to do", kStepKeys};
constexpr Table kOverride{"object:NAME", "what a step changes of a body", kOverrideKeys};
constexpr Table kTrigger{"trigger:N", "when a step is over, and what follows", kTriggerKeys};
constexpr Table kText{"text", "words for people", kTextKeys};
constexpr Table kVisit{"visit", "a scripted hand", kVisitKeys};
constexpr Table kMove{"move:N", "one move of a visit", kMoveKeys};
constexpr Table kHaptic{"mechane:haptic", "on a RigidBody: what touch feels", kHapticKeys};
constexpr Table kBody{"mechane:body", "on a RigidBody: its shape in a mesh file", kBodyKeys};

constexpr std::array<const Table*, 11> kAll{&kScenario, &kQuantity, &kActivity, &kStep,   &kOverride, &kTrigger,
                                            &kText,     &kVisit,    &kMove,     &kHaptic, &kBody};

std::string_view kind_name(ValueKind kind) {
  switch (kind) {
    case string:
      return "string";
    case strings:
      return "strings";
    case number:
      return "number";
    case vector:
      return "3 numbers";
    case rotation:
      return "4 numbers (axis, angle)";
    case boolean:
      return "true or false";
    case set:
      return "MetadataSet";
  }
  return "";
}

std::string describe_key(const Key& key) {
  std::string line = fmt::format("  {:<16} {:<24} {}", key.name, kind_name(key.kind), key.summary);
  if (!key.unit.empty()) line += fmt::format(" [{}]", key.unit);
  if (!key.choices.empty()) line += fmt::format(", one of: {}", key.choices);
  if (key.required) {
    line += ", required";
  } else if (key.kind == number) {
    line += fmt::format(", default {}", key.default_number);
  }
  if (!key.example.empty()) line += fmt::format(" (example: {})", key.example);
  return line + "\n";
}

}  // namespace

const Table& scenario_table() {
  return kScenario;
}
const Table& quantity_table() {
  return kQuantity;
}
const Table& activity_table() {
  return kActivity;
}
const Table& step_table() {
  return kStep;
}
const Table& override_table() {
  return kOverride;
}
const Table& trigger_table() {
  return kTrigger;
}
const Table& text_table() {
  return kText;
}
const Table& visit_table() {
  return kVisit;
}
const Table& move_table() {
  return kMove;
}
const Table& haptic_table() {
  return kHaptic;
}
const Table& body_table() {
  return kBody;
}
std::span<const Table* const> all_tables() {
  return kAll;
}

std::string describe_tables() {
  std::string text;
  for (const Table* table : kAll) {
    text += fmt::format("{}: {}\n", table->name, table->summary);
    for (const Key& key : table->keys)
      text += describe_key(key);
  }
  return text;
}

}  // namespace mechane::scenario
