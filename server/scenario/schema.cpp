// The tables of metadata keys, from the inside out: each table comes before those that refer to it.
#include <algorithm>
#include <array>

#include "server/base/assert.hpp"
#include "server/hand/hand_force.hpp"
#include "server/scenario/schema_visits.hpp"
#include "server/state/component_type.hpp"
#include "server/state/description.hpp"
#include "server/state/surface_keys.hpp"

namespace mechane::scenario {
namespace {

using enum ValueKind;

constexpr Key kTextKeys[] = {
    {.name = "*", .kind = string, .summary = "the words, as WHAT.LANGUAGE", .example = "caption.el"},
};
constexpr Table kText{"text", "words for people", kTextKeys};

constexpr Key kQuantityKeys[] = {
    {.name = "source",
     .summary = "what it reads, as NAME.VALUE",
     .example = "\"PUMP.basin_l\"",
     .required = true,
     .names = Names::source},
    {.name = "unit", .summary = "as a visitor reads it; rpm and deg convert", .example = "\"l\""},
    {.name = "least",
     .kind = number,
     .summary = "where its gauge begins, in its unit",
     .example = "0",
     .min = -1e9,
     .max = 1e9},
    {.name = "greatest",
     .kind = number,
     .summary = "where its gauge ends; left out: the gauge begins at 0 and grows",
     .example = "20",
     .min = -1e9,
     .max = 1e9},
    {.name = "text",
     .kind = set,
     .summary =
         "label.LANGUAGE: what its gauge is called. Displays show quantities with a label; of those without, the "
         "first in l, l/min, rpm, N, degC and km, where no other in that unit has a label",
     .inner = &kText},
};
constexpr Table kQuantity{"quantity", "a number with a name", kQuantityKeys};

constexpr Key kOverrideKeys[] = {
    {.name = "movable", .kind = boolean, .summary = "false: held still", .default_text = "as it was"},
    {.name = "visible", .kind = boolean, .summary = "false: not drawn", .default_text = "as it was"},
    {.name = "graspable", .kind = boolean, .summary = "a hand may take it", .default_text = "as it was"},
    {.name = "useGlobalGravity",
     .kind = boolean,
     .summary = "true: it has its weight; false: it floats, as if balanced",
     .default_text = "as it was"},
    {.name = "position",
     .kind = vector,
     .unit = "m",
     .summary = "put it there when the step begins, in W",
     .example = "0 0.8 0.75",
     .min = -state::kFarthest_m,
     .max = state::kFarthest_m},
    {.name = "orientation",
     .kind = rotation,
     .unit = "rad",
     .summary = "turn it so when the step begins, in W",
     .example = "0 1 0 1.57",
     .min = -kLargest,
     .max = kLargest},
};
constexpr Table kOverride{"object:NAME", "what a step changes of a body", kOverrideKeys};

constexpr Key kRuleQuantity{.name = "quantity",
                            .summary = "what is compared",
                            .example = "\"level\"",
                            .required = true,
                            .names = Names::quantity};
constexpr Key kRuleOp{
    .name = "op", .summary = "how: below, equal, above", .example = "\">\"", .required = true, .choices = "< = >"};
constexpr Key kRuleValue{
    .name = "value", .kind = number, .summary = "with what, in the quantity's unit", .example = "40", .required = true};
constexpr Key kRuleTolerance{.name = "tolerance",
                             .kind = number,
                             .summary = "how near is equal",
                             .example = "0.1",
                             .default_number = 1e-6,
                             .min = 0};

constexpr Key kRuleKeys[] = {kRuleQuantity, kRuleOp, kRuleValue, kRuleTolerance};
constexpr Table kRule{"rule:N", "one comparison of a trigger that has several", kRuleKeys};

constexpr Key unless_rules(Key key) {
  key.unless = "rule:*";
  return key;
}

constexpr Key kTriggerKeys[] = {
    unless_rules(kRuleQuantity),
    unless_rules(kRuleOp),
    unless_rules(kRuleValue),
    kRuleTolerance,
    {.name = "rule:*",
     .kind = set,
     .summary = "instead of quantity, op and value: a comparison each",
     .example = "rule:1",
     .inner = &kRule},
    {.name = "match",
     .summary = "whether all rules must hold at once, or any one",
     .example = "\"any\"",
     .default_text = "all",
     .choices = "all any"},
    {.name = "holdSeconds",
     .kind = number,
     .unit = "s",
     .summary = "how long it must hold without a break",
     .example = "0.3",
     .min = 0,
     .max = 3600},
    {.name = "next",
     .summary = "the step that follows; end: the activity is done",
     .example = "\"turn\"",
     .default_text = "end",
     .names = Names::step},
};
constexpr Table kTrigger{"trigger:N", "when a step is over, and what follows", kTriggerKeys};

constexpr Key kStepKeys[] = {
    {.name = "enable",
     .kind = strings,
     .summary = "agents to switch on; before, in every activity, they are off",
     .example = "\"HINGE\"",
     .names = Names::agent},
    {.name = "disable",
     .kind = strings,
     .summary = "agents to switch off; a snap that is off leaves what it has placed fixed",
     .example = "\"SNAP\"",
     .names = Names::agent},
    {.name = "object:*",
     .kind = set,
     .summary = "what changes of a body",
     .example = "object:INNER",
     .names = Names::body,
     .inner = &kOverride},
    {.name = "text",
     .kind = set,
     .summary = "caption, narration, hint, each with .LANGUAGE; audio.LANGUAGE: a sound file of the narration",
     .inner = &kText},
    {.name = "trigger:*",
     .kind = set,
     .summary = "what ends the step; the first that fires decides. Displays mark on a gauge what `trigger:1` waits for",
     .example = "trigger:1",
     .inner = &kTrigger},
    {.name = "timeoutSeconds",
     .kind = number,
     .unit = "s",
     .summary = "the step ends after this time, whatever happens; 0: never",
     .example = "60",
     .min = 0,
     .max = 3600},
    {.name = "timeoutNext",
     .summary = "the step that follows then; end: the activity is done",
     .example = "\"show\"",
     .default_text = "end",
     .names = Names::step},
    {.name = "detail",
     .summary = "the DEF of the Viewpoint from which a close-up is shown in a corner of the picture",
     .example = "\"MECHANISM\"",
     .names = Names::view},
    {.name = "opens",
     .summary =
         "the id of the scenario that the visitors go on to as this step begins. If the server does not have this "
         "scenario, they stay, and this is an ordinary step: give it a timeoutSeconds that leads back. Not for an "
         "activity's first step",
     .example = "\"archimedes-screw\""},
    {.name = "hintSeconds",
     .kind = number,
     .unit = "s",
     .summary = "when the hint is shown",
     .example = "20",
     .default_number = 20,
     .min = 0,
     .max = 3600},
};
constexpr Table kStep{"step", "one thing to do", kStepKeys};

constexpr Key kQuestionKeys[] = {
    {.name = "kind",
     .summary = "choice: one of several answers; scale: a number from low to high",
     .example = "\"choice\"",
     .required = true,
     .choices = "choice scale"},
    {.name = "answers",
     .kind = strings,
     .summary = "choice: names of the answers, in the order shown",
     .example = "\"pitch\" \"speed\""},
    {.name = "correct", .summary = "choice: the right answer, if there is one", .example = "\"speed\""},
    {.name = "steps",
     .kind = number,
     .summary = "scale: how many marks it has",
     .example = "5",
     .default_number = 5,
     .min = 2,
     .max = 11},
    {.name = "text",
     .kind = set,
     .summary = "question.LANGUAGE; choice: answer:NAME.LANGUAGE; scale: low.LANGUAGE, high.LANGUAGE",
     .required = true,
     .inner = &kText},
};
constexpr Table kQuestion{"question", "one question after an activity", kQuestionKeys};

constexpr Key kActivityKeys[] = {
    {.name = "first",
     .summary = "the step to begin with; else the first one written",
     .example = "\"grasp\"",
     .names = Names::step},
    {.name = "text",
     .kind = set,
     .summary = "title.LANGUAGE; goal.LANGUAGE: what a visitor should learn",
     .inner = &kText},
    {.name = "steps",
     .kind = set,
     .summary = "sets named as the steps",
     .required = true,
     .inner = &kStep,
     .free_names = true},
    {.name = "questionnaire",
     .kind = set,
     .summary = "sets named as the questions, asked in the order written",
     .inner = &kQuestion,
     .free_names = true},
};
constexpr Table kActivity{"activity", "a task for a visitor", kActivityKeys};

constexpr Key kEffectKeys[] = {
    {.name = "kind",
     .summary =
         "what is seen, heard or felt. level: a surface of water that rises; flow: one that flows, as a river does; "
         "stream: water that runs out; jet: water or steam under pressure, its speed from flow and size; "
         "sound.NAME: a sound at that place; touch.click: a short shake in the hands that hold or touch the body, "
         "each time the quantity has changed by another full",
     .example = "\"stream\"",
     .required = true,
     .choices = state::effect_kinds()},
    {.name = "quantity",
     .summary =
         "what drives it: l/s or l/min for stream and jet, a height in m for level, else any number; not for a flow",
     .example = "\"flow\"",
     .required = true,
     .unless = "node",
     .names = Names::quantity},
    {.name = "body",
     .summary = "what it stays with, or is felt in; none: fixed in W",
     .example = "\"BARREL\"",
     .names = Names::body},
    {.name = "node", .summary = "level, flow: the mesh file's node that rises or flows", .example = "\"WATER_BASIN\""},
    {.name = "point",
     .kind = vector,
     .unit = "m",
     .summary = "where, in the body's frame",
     .example = "0 0.2 1.4",
     .min = -state::kFarthest_m,
     .max = state::kFarthest_m},
    {.name = "direction",
     .kind = vector,
     .summary = "which way, in the body's frame, of a flow in W; none: 0 1 0",
     .example = "0 0 1",
     .min = -kLargest,
     .max = kLargest},
    {.name = "full",
     .kind = number,
     .summary = "the quantity's value at which it is at its strongest",
     .example = "1.5",
     .default_number = 1,
     .min = 1e-9,
     .max = 1e9},
    {.name = "size",
     .kind = number,
     .unit = "m",
     .summary = "how large: a jet's bore, a fire's width",
     .example = "0.3",
     .default_number = 0.02,
     .min = 1e-3,
     .max = 10},
    {.name = "speed",
     .kind = number,
     .unit = "m/s",
     .summary = "how fast water or steam leaves, or a river flows; not for a jet of water, whose flow says it",
     .example = "0.6",
     .default_number = 0.5,
     .min = 0,
     .max = 100},
    {.name = "force",
     .kind = number,
     .unit = "N",
     .summary = "how strong a touch.click is",
     .example = "0.5",
     .default_number = 0.5,
     .min = 0,
     .max = hand::kMaxClick_n},
};
constexpr Table kEffect{"effect", "something seen, heard or felt of a machine's working, driven by a quantity",
                        kEffectKeys};

constexpr Key kScenarioKeys[] = {
    {.name = "format", .kind = number, .summary = "version of these tables", .example = "1", .required = true},
    {.name = "id",
     .summary = "the exhibit's name in logs and on the wire: small letters, digits, '-'",
     .example = "\"archimedes-screw\"",
     .required = true},
    {.name = "languages",
     .kind = strings,
     .summary = "codes, the first is shown first",
     .example = "\"el\" \"en\"",
     .required = true,
     .names = Names::language},
    {.name = "effortScale",
     .kind = number,
     .summary = "share of a machine's loads that the hand feels",
     .example = "0.06",
     .default_number = 1,
     .min = 1e-4,
     .max = 1},
    {.name = "text", .kind = set, .summary = "title.LANGUAGE", .inner = &kText},
    {.name = "agents",
     .kind = set,
     .summary = "sets named as the agents, each with its type and parameters",
     .free_names = true},
    {.name = "machines",
     .kind = set,
     .summary = "sets named as the machines, each with its type and parameters",
     .free_names = true},
    {.name = "quantities",
     .kind = set,
     .summary = "what rules and displays read, by name: a set each, or only a string with the source",
     .inner = &kQuantity,
     .free_names = true},
    {.name = "activities",
     .kind = set,
     .summary = "sets named as the activities",
     .required = true,
     .inner = &kActivity,
     .free_names = true},
    {.name = "visits",
     .kind = set,
     .summary = "sets named as the scripted visits",
     .inner = &kVisitTable,
     .free_names = true},
    {.name = "effects",
     .kind = set,
     .summary = "sets named as what is seen, heard and felt beside the bodies: water, steam, fire, a ratchet's clicks",
     .inner = &kEffect,
     .free_names = true},
};
constexpr Table kScenario{"mechane:scenario", "on the WorldInfo: all that X3D itself cannot say", kScenarioKeys};

constexpr Key surface_key(std::string_view name, std::string_view example) {
  const state::ParameterType& key = state::surface_key(name);
  return {.name = key.name,
          .kind = key.kind == state::ParameterKind::numbers ? vector : number,
          .unit = key.unit,
          .summary = key.summary,
          .example = example,
          .default_number = key.default_value,
          .min = key.min,
          .max = key.max};
}

constexpr Key kHapticKeys[] = {
    surface_key("stiffness", "600"),
    surface_key("damping", "1.5"),
    surface_key("staticFriction", "0.5"),
    surface_key("dynamicFriction", "0.3"),
    surface_key("viscosity", "1"),
    surface_key("knock", "5"),
    surface_key("grooveDepth", "0.00005"),
    surface_key("grooveDistance", "0.004"),
    surface_key("grooveDirection", "0 0 1"),
    {.name = "effortScale",
     .kind = number,
     .summary = "share of its weight that the hand lifts",
     .example = "0.05",
     .default_number = 1,
     .min = 1e-4,
     .max = 1},
    {.name = "graspable", .kind = boolean, .summary = "a hand may take it"},
};
constexpr Table kHaptic{"mechane:haptic", "on a RigidBody: what touch feels", kHapticKeys};

constexpr Key kCopiesKeys[] = {
    {.name = "count",
     .kind = number,
     .summary = "how many bodies there are: NAME-1, NAME-2 and so on",
     .example = "20",
     .required = true,
     .unless = "positions",
     .default_number = 2,
     .min = 2,
     .max = 200},
    {.name = "step",
     .kind = vector,
     .unit = "m",
     .summary = "a row, or a pile: from each to the next, in W",
     .example = "0 0.003 0",
     .min = -state::kFarthest_m,
     .max = state::kFarthest_m},
    {.name = "columns",
     .kind = number,
     .summary = "a grid: how many stand in each row",
     .example = "5",
     .default_number = 200,
     .min = 1,
     .max = 200},
    {.name = "rowStep",
     .kind = vector,
     .unit = "m",
     .summary = "a grid: from each row to the next, in W",
     .example = "0 0 0.05",
     .min = -state::kFarthest_m,
     .max = state::kFarthest_m},
    {.name = "ringCentre",
     .kind = vector,
     .unit = "m",
     .summary = "a ring: they stand evenly about this point of W, each turned as its place is",
     .example = "0 0.8 0",
     .min = -state::kFarthest_m,
     .max = state::kFarthest_m},
    {.name = "ringAxis",
     .kind = vector,
     .summary = "a ring: what it lies about, in W; none: 0 1 0",
     .example = "0 0 1",
     .min = -kLargest,
     .max = kLargest},
    {.name = "positions",
     .kind = numbers,
     .unit = "m",
     .summary = "a list: x y z of each, in W, the first one's too",
     .example = "0 0.8 0 0.1 0.8 0",
     .min = -state::kFarthest_m,
     .max = state::kFarthest_m},
};
constexpr Table kCopies{
    "copies", "in a mechane:body: one RigidBody for many bodies, which differ in name and place alone", kCopiesKeys};

constexpr Key kBodyKeys[] = {
    {.name = "model",
     .summary = "DEF of the Inline whose file holds the shape; left out: the shape is the body's `geometry`",
     .example = "\"MODEL\"",
     .names = Names::model},
    {.name = "node", .summary = "the node in that file; else the one named as the body", .example = "\"INNER\""},
    {.name = "touchable", .kind = boolean, .summary = "false: drawn only", .default_number = 1},
    {.name = "solid",
     .summary = "what is inside, where the mesh is open: closed closes its holes, sheet T makes its surface T metres "
                "thick, auto closes what encloses something and makes a sheet of 1 mm of the rest",
     .example = "\"sheet 0.002\"",
     .default_text = "auto"},
    {.name = "collides",
     .kind = boolean,
     .summary = "with every other body that does, but for those joined or snapped to it",
     .default_text = "false; true with a `geometry`"},
    {.name = "restitution",
     .kind = number,
     .summary = "share of its speed that a collision gives back",
     .example = "0.2",
     .min = 0,
     .max = 1},
    {.name = "text",
     .kind = set,
     .summary = "title.LANGUAGE: what it is called; displays write it above what a hand comes near or points at",
     .inner = &kText},
    {.name = "copies", .kind = set, .summary = "many such bodies instead of one", .inner = &kCopies},
};
constexpr Table kBody{"mechane:body", "on a RigidBody: its shape in a mesh file", kBodyKeys};

constexpr std::array<const Table*, 15> kTables{&kScenario,  &kQuantity, &kActivity, &kQuestion, &kStep,
                                               &kOverride,  &kTrigger,  &kRule,     &kText,     &kVisitTable,
                                               &kMoveTable, &kEffect,   &kHaptic,   &kBody,     &kCopies};

}  // namespace

const Key* Table::find(std::string_view wanted) const {
  const auto it = std::find_if(keys.begin(), keys.end(), [&](const Key& key) { return matches(key.name, wanted); });
  return it == keys.end() ? nullptr : &*it;
}

const Key& Table::key(std::string_view wanted, ValueKind kind) const {
  const Key* found = find(wanted);
  MECHANE_ASSERT(found != nullptr && found->kind == kind);
  return *found;
}

const Table& scenario_table() {
  return kScenario;
}
const Table& quantity_table() {
  return kQuantity;
}
const Table& activity_table() {
  return kActivity;
}
const Table& question_table() {
  return kQuestion;
}
const Table& step_table() {
  return kStep;
}
const Table& effect_table() {
  return kEffect;
}
const Table& override_table() {
  return kOverride;
}
const Table& trigger_table() {
  return kTrigger;
}
const Table& rule_table() {
  return kRule;
}
const Table& text_table() {
  return kText;
}
const Table& haptic_table() {
  return kHaptic;
}
const Table& body_table() {
  return kBody;
}
const Table& copies_table() {
  return kCopies;
}
std::span<const Table* const> all_tables() {
  return kTables;
}

}  // namespace mechane::scenario
