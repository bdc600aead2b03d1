// What the stages of one compilation share. Inside this room only.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "server/scenario/attributes.hpp"
#include "server/scenario/compiler.hpp"
#include "server/scenario/copies.hpp"
#include "server/scenario/fields.hpp"
#include "server/state/component_type.hpp"
#include "server/state/description.hpp"
#include "server/x3d/document.hpp"
#include "server/x3d/metadata.hpp"
#include "server/x3d/shape_tree.hpp"

namespace mechane::scenario {

/// A rule as written, to be checked when all components are known.
struct WrittenRule {
  int line = 0;
  std::string where;
  StepId step;
  state::RuleDescription rule;
  bool marked = false;  ///< of the step's first trigger: displays mark it on a gauge
};

/// A world in the making. Each stage reads the document and adds to the world. A fault becomes a problem and the stage goes on, so that
/// an author sees all faults at once.
struct Compilation {
  const x3d::Document& document;
  ObjectLoader& loader;
  x3d::Problems& problems;
  x3d::ShapeTree shapes;  ///< of the document
  state::WorldDescription world;
  std::optional<x3d::Metadata> scenario;            ///< the tree of the WorldInfo
  std::map<std::string, std::string> model_hashes;  ///< by url as written
  std::vector<int> body_lines;                      ///< by BodyId
  std::map<std::string, std::size_t> copies;        ///< how many bodies a RigidBody stands for, by its DEF
  std::map<std::string, int> quantity_lines;        ///< by the quantity's name, of those written as sets
  std::vector<int> activity_lines;                  ///< by ActivityId
  std::vector<int> step_lines;                      ///< by StepId
  std::vector<std::vector<int>> question_lines;     ///< by ActivityId, then as in its questionnaire
  std::set<std::string>
      foreign_languages;           ///< of texts in languages that the scenario does not have: each is reported once
  std::vector<WrittenRule> rules;  ///< of all triggers, without faulty ones
  /// Names of agents, machines and quantities, each with a parameter that it has misspelt or malformed, in its right spelling.
  std::set<std::pair<std::string, std::string>> misspelt_parameters;
  std::vector<bool> touchable;  ///< by BodyId: whether hands can touch it
};

/// Stages, in the order in which they need each other.
void check_nodes(Compilation& c);         // elements against X3D's schema
void compile_scenario(Compilation& c);    // id, languages, title, units
void compile_bodies(Compilation& c);      // RigidBodyCollection, RigidBody, mechane:body, mechane:haptic
void compile_scenery(Compilation& c);     // shapes of X3D that belong to no body
void compile_joints(Compilation& c);      // X3D's joints
void compile_components(Compilation& c);  // mechane:agent on nodes, agents and machines of the tree
void compile_events(Compilation& c);  // X3D's sensors, interpolators, dampers and ROUTEs, and the bodies that they move
void compile_quantities(Compilation& c);
void compile_viewpoints(Compilation& c);
void compile_effects(Compilation& c);     // of quantities, seen and heard
void compile_activities(Compilation& c);  // activities and their steps
void check_presented(Compilation& c);     // no more of a kind than displays take
void check_components(Compilation& c);    // parameters against their types; they may name anything above
void check_goals(Compilation& c);         // rules that their quantity can never meet
void compile_visits(Compilation& c);
void compile_hash(Compilation& c);
void check_agents(Compilation& c);    // what their makers refuse; only of a world without errors
void check_machines(Compilation& c);  // the same
void check_formulas(Compilation& c);  // whether the quantities that formulas read are in the units that they say

/// Warns of what compiles, but is likely not meant.
void lint(Compilation& c);
/// Warns of bodies that fall, drift away, or stay immovable or tied. Part of lint().
void lint_bodies(Compilation& c);
/// Warns of surfaces and pulls that no hand can feel, or not as meant. Part of lint().
void lint_touch(Compilation& c);

/// Whether a text can be an id: small letters, digits and '-', 64 at most.
[[nodiscard]] bool is_id(const std::string& text);

/// Whether a list of agents has this one.
[[nodiscard]] bool names(const std::vector<AgentId>& list, AgentId agent);

/// Whether the file is X3D without our metadata: then it is taken as X3D means it.
[[nodiscard]] inline bool is_plain(const Compilation& c) {
  return !c.scenario;
}

/// What a step changes of a body; null where it changes nothing.
[[nodiscard]] const state::BodyOverride* override_of(const state::StepDescription& step, BodyId body);

/// All agents are on at the start, except those that a step enables.
[[nodiscard]] bool on_at_start(const state::WorldDescription& world, AgentId agent);
[[nodiscard]] bool on_after(const state::StepDescription& step, AgentId agent, bool before);

/// The steps that its triggers and its time-out lead to.
[[nodiscard]] std::vector<StepId> next_steps(const state::StepDescription& step);

/// The steps that can be reached from `open` (those included), each once, by way of steps that pass; without `passes` all do.
[[nodiscard]] std::vector<StepId> steps_from(const state::WorldDescription& world, std::vector<StepId> open,
                                             const std::function<bool(StepId)>& passes = {});

/// All stages.
void compile_all(Compilation& c);

/// A set of the scenario's tree; null where the scenario has no such set.
[[nodiscard]] const x3d::Metadata* tree_set(const Compilation& c, std::string_view name);

/// Reports that nothing has this name: "no body is called 'X'". The remedy names what is known; `if_none` where nothing is.
void report_unknown(Compilation& c, const Place& at, std::string_view word, const std::string& name,
                    std::span<const std::string> known, const std::string& if_none);

/// Where the copies of a RigidBody stand, itself the first; empty where it is one body. `body`: of its mechane:body.
[[nodiscard]] std::vector<Pose> read_copies(Compilation& c, x3d::NodeId id, const Fields& body, const Pose& X_WB);
/// COIN-1, COIN-2 ... of COIN-*; the name itself where it is not of that form.
[[nodiscard]] std::vector<std::string> all_copies(const Compilation& c, const std::string& name);
/// Where the name stands for several bodies, reports that one of them must be named. False where it does not.
bool report_copies(Compilation& c, const Place& at, const std::string& name);
/// The bodies of a RigidBody: its copies, or the one.
[[nodiscard]] std::vector<BodyId> bodies_of(const Compilation& c, x3d::NodeId id);

/// Finds the body with this name. If there is none, reports it and returns BodyId::none().
[[nodiscard]] BodyId find_body(Compilation& c, const std::string& name, const Place& at);
/// What the key "body", "quantity" names; none where it is not given, or where nothing has that name, which is reported.
[[nodiscard]] BodyId find_body(Compilation& c, const Fields& fields);
[[nodiscard]] QuantityId find_quantity(Compilation& c, const Fields& fields);

/// Texts of a `text` set: keys "<what>.<language>", with `what` among `allowed` (separated by blanks). By what, then by language.
[[nodiscard]] std::map<std::string, state::Texts> read_texts(Compilation& c, const x3d::Metadata* set,
                                                             const std::string& where, std::string_view allowed);

/// The questions of an activity; their lines go to Compilation::question_lines.
[[nodiscard]] std::vector<state::QuestionDescription> read_questionnaire(Compilation& c, const Fields& activity);

/// Adds the body of shapes that the file itself holds: of a node of that name, at an element's line.
state::BodyDescription& add_own_body(Compilation& c, const std::string& name, x3d::NodeId id);

/// A parameter's written number, or the type's default; infinity where neither is known.
[[nodiscard]] double parameter_of(const state::ComponentDescription& component, const state::ComponentType& type,
                                  std::string_view name);

/// The type of an agent or machine; null where there is no type of that name.
[[nodiscard]] const state::ComponentType* find_agent_type(std::string_view name);
[[nodiscard]] const state::ComponentType* find_machine_type(std::string_view name);

template <class Item>
[[nodiscard]] std::vector<std::string> names_of(const std::vector<Item>& items) {
  std::vector<std::string> names;
  names.reserve(items.size());
  for (const Item& item : items)
    names.push_back(item.name);
  return names;
}

}  // namespace mechane::scenario
