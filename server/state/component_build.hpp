// What the maker of an agent or a machine gets, and the checks that several makers need.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"
#include "server/state/component_type.hpp"
#include "server/state/world_state.hpp"

namespace mechane::state {

/// Parameters are checked against the type already. The references live until the set is made, the description as long as the set.
/// Errors name the component and have the line of the parameter.
struct ComponentBuild {
  const WorldDescription& description;
  const ComponentDescription& component;
  const Parameters& parameters;
  MemoryLayout& layout;

  /// A slot for a value that quantities may read, or that only the component reads.
  [[nodiscard]] std::size_t slot(const std::string& value, double initial = 0) const {
    return layout.add(component.name, value, initial);
  }
  [[nodiscard]] const ComponentDescription& agent(AgentId other) const { return description.agents[other.index()]; }

  /// For an Error: the component, at the line of a parameter where the author wrote it.
  [[nodiscard]] Place place(std::string_view parameter = {}) const { return parameter_place(component, parameter); }

  /// The joint that a parameter names. invalid_value: it is of another kind.
  [[nodiscard]] Expected<JointId> joint(std::string_view parameter, JointKind kind) const;
  /// The same of a joint with one axis, a hinge or a slider.
  [[nodiscard]] Expected<JointId> hinge_or_slider(std::string_view parameter) const;

  /// Three numbers, such as a point.
  [[nodiscard]] Vec3 vector(std::string_view parameter) const;
  /// Three numbers as a unit vector; `otherwise` where the author wrote none. invalid_value: 0 0 0.
  [[nodiscard]] Expected<Vec3> direction(std::string_view parameter, const Vec3& otherwise) const;

  /// A number without fraction. invalid_value: it has one.
  [[nodiscard]] Expected<double> whole_number(std::string_view parameter) const;
};

/// A type of agents or machines, and its maker.
template <class Component, class Build>
struct ComponentKind {
  ComponentType type;
  Expected<std::unique_ptr<Component>> (*make)(const Build& build);
};

/// Makes the agent or machine `id` of `components`. A Build holds a ComponentBuild and the id. `word` is for messages: "agent" or
/// "machine". Errors: unknown_name (no kind has the component's type), and those of Parameters::check() and of the maker.
template <class Component, class Build, class Id>
[[nodiscard]] Expected<std::unique_ptr<Component>> make_component(
    std::span<const ComponentKind<Component, Build>* const> kinds, const std::string& word,
    const WorldDescription& description, const std::vector<ComponentDescription>& components, Id id,
    MemoryLayout& layout) {
  const ComponentDescription& component = components[id.index()];
  std::string known;
  for (const auto* kind : kinds) {
    known += (known.empty() ? "" : ", ") + std::string(kind->type.name);
    if (kind->type.name != component.type) continue;
    const auto parameters = Parameters::check(kind->type, component, description);
    if (!parameters) return tl::unexpected(parameters.error());
    return kind->make({{description, component, *parameters, layout}, id});
  }
  return fail(ErrorCode::unknown_name, "there is no " + word + " of type '" + component.type + "'",
              parameter_place(component, {}), "use one of: " + known);
}

/// What X3D calls a joint of this kind: "SingleAxisHingeJoint".
[[nodiscard]] std::string_view x3d_name(JointKind kind);

}  // namespace mechane::state
