// What the stages of one compilation share. Inside this room only.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "server/scenario/attributes.hpp"
#include "server/scenario/compiler.hpp"
#include "server/scenario/fields.hpp"
#include "server/state/component_type.hpp"
#include "server/state/description.hpp"
#include "server/x3d/document.hpp"
#include "server/x3d/metadata.hpp"

namespace mechane::scenario {

/// A rule as written, for what can be said of it only when all components are known.
struct WrittenRule {
  int line = 0;
  std::string where;
  StepId step;
  state::RuleDescription rule;
};

/// A world in the making. Each stage reads the document and adds to the world; a fault becomes a problem and the stage goes on, so that
/// an author sees all faults at once.
/// Small letters, digits and '-', 64 at most.
[[nodiscard]] bool is_id(const std::string& text);

struct Compilation {
  const x3d::Document& document;
  ObjectLoader& loader;
  x3d::Problems& problems;
  state::WorldDescription world;
  std::optional<x3d::Metadata> scenario;            ///< the tree of the WorldInfo
  std::map<std::string, std::string> model_hashes;  ///< by url as written
  std::vector<int> body_lines;                      ///< by BodyId
  std::vector<int> activity_lines;                  ///< by ActivityId
  std::vector<int> step_lines;                      ///< by StepId
  std::vector<std::vector<int>> question_lines;     ///< by ActivityId, then as in its questionnaire
  std::set<std::string> foreign_languages;          ///< of texts, and not the scenario's: said once each
  std::vector<WrittenRule> rules;                   ///< of all triggers, but for those that are faulty
  std::map<std::pair<std::string, std::string>, int> parameter_lines;  ///< by agent or machine, and parameter
  std::set<std::pair<std::string, std::string>> misspelt_parameters;   ///< what was meant by them, by agent or machine
};

/// Stages, in the order in which they need each other.
void check_nodes(Compilation& c);         // elements against X3D's schema
void compile_scenario(Compilation& c);    // id, languages, title, units
void compile_bodies(Compilation& c);      // RigidBodyCollection, RigidBody, mechane:body, mechane:haptic
void compile_joints(Compilation& c);      // X3D's joints
void compile_components(Compilation& c);  // mechane:agent on nodes, agents and machines of the tree
void compile_quantities(Compilation& c);
void compile_viewpoints(Compilation& c);
void compile_effects(Compilation& c);     // of quantities, seen and heard
void compile_activities(Compilation& c);  // activities and their steps
void check_components(Compilation& c);    // parameters against their types; names may be of anything above
void check_goals(Compilation& c);         // rules that no value of their quantity can meet
void compile_visits(Compilation& c);
void compile_hash(Compilation& c);

/// What a careful author would want to hear of a world that compiles: warnings.
void lint(Compilation& c);
/// Of bodies that fall, or stay immovable, because an agent is off. Part of lint().
void lint_bodies(Compilation& c);

/// Whether a step's list of agents has this one.
[[nodiscard]] bool names(const std::vector<AgentId>& list, AgentId agent);

/// The steps that its triggers and its time-out lead to.
[[nodiscard]] std::vector<StepId> next_steps(const state::StepDescription& step);

/// The steps that can be reached from these, they included, each once, through steps that pass; without `passes` all do.
[[nodiscard]] std::vector<StepId> steps_from(const state::WorldDescription& world, std::vector<StepId> open,
                                             const std::function<bool(StepId)>& passes = {});

/// All of it.
void compile_all(Compilation& c);

/// A set of the scenario's tree; null where there is none.
[[nodiscard]] const x3d::Metadata* tree_set(const Compilation& c, std::string_view name);

/// Texts of a `text` set: keys "<what>.<language>", with `what` among `allowed` (separated by blanks). By what, then by language.
[[nodiscard]] std::map<std::string, state::Texts> read_texts(Compilation& c, const x3d::Metadata* set,
                                                             const std::string& where, std::string_view allowed);

/// The questions of an activity; their lines go to Compilation::question_lines.
[[nodiscard]] std::vector<state::QuestionDescription> read_questionnaire(Compilation& c, const Fields& activity);

/// The type of an agent or machine; null where none has that name.
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
