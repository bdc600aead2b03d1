// The tables of scripted visits.
#include "server/scenario/schema_visits.hpp"

#include "server/state/description.hpp"

namespace mechane::scenario {
namespace {

using enum ValueKind;

constexpr Key kMoveKeys[] = {
    {.name = "kind",
     .summary = "what the hand does",
     .example = "\"reach\"",
     .required = true,
     .choices = "reach grasp move_to turn swing release wait"},
    {.name = "body", .summary = "reach, grasp, move_to: of which body", .example = "\"INNER\"", .names = Names::body},
    {.name = "grip",
     .kind = vector,
     .unit = "m",
     .summary = "reach: the grip's centre in the body's frame",
     .example = "0.25 0 1.36",
     .min = -state::kFarthest_m,
     .max = state::kFarthest_m},
    {.name = "position",
     .kind = vector,
     .unit = "m",
     .summary = "move_to: where the body goes, in W",
     .example = "0 0.55 0",
     .min = -state::kFarthest_m,
     .max = state::kFarthest_m},
    {.name = "orientation",
     .kind = rotation,
     .unit = "rad",
     .summary = "move_to: how the body stands, in W",
     .example = "0 1 0 1.57",
     .min = -kLargest,
     .max = kLargest},
    {.name = "joint", .summary = "turn, swing: which hinge", .example = "\"AXLE\"", .names = Names::joint},
    {.name = "turns", .kind = number, .summary = "turn: how far", .example = "8", .min = -1000, .max = 1000},
    {.name = "rpm",
     .kind = number,
     .unit = "1/min",
     .summary = "turn: how fast",
     .example = "30",
     .default_number = 20,
     .min = 0.1,
     .max = 300},
    {.name = "angle",
     .kind = number,
     .unit = "rad",
     .summary = "swing: how far to either side of the joint's 0; below 0: backwards first",
     .example = "0.2",
     .min = -3,
     .max = 3},
    {.name = "cycles",
     .kind = number,
     .summary = "swing: how often to and fro",
     .example = "8",
     .default_number = 1,
     .min = 0.25,
     .max = 1000},
    {.name = "perMinute",
     .kind = number,
     .unit = "1/min",
     .summary = "swing: how many cycles a minute",
     .example = "30",
     .default_number = 20,
     .min = 0.1,
     .max = 300},
    {.name = "seconds",
     .kind = number,
     .unit = "s",
     .summary = "how long it lasts; not for turn and swing",
     .example = "1.5",
     .default_number = 1,
     .min = 0,
     .max = 600},
};
}  // namespace

constexpr Table kMoveTable{"move:N", "one move of a visit", kMoveKeys};

namespace {

constexpr Key kVisitKeys[] = {
    {.name = "activity",
     .summary = "which activity it plays",
     .example = "\"use\"",
     .required = true,
     .names = Names::activity},
    {.name = "move:*",
     .kind = set,
     .summary = "the moves, played in the order written",
     .example = "move:1",
     .inner = &kMoveTable},
};
}  // namespace

constexpr Table kVisitTable{"visit", "a scripted hand", kVisitKeys};

const Table& visit_table() {
  return kVisitTable;
}
const Table& move_table() {
  return kMoveTable;
}

}  // namespace mechane::scenario
