// How hard a hand pulls or pushes a body, and how far the body goes with it. Inside this room only.
#pragma once

#include "server/agents/agent.hpp"

namespace mechane::agents {

/// How a hand acts on the body.
enum class Effort {
  pull,  ///< it holds the body
  push,  ///< it touches the body and does not hold it
};

/// Measures what hands do to one body. The force is the one that the hand feels, along `axis` (in the body's frame; none: in any
/// direction). Travel counts from where the body was when the hand came: along the joint if one is named, else along the axis, else in
/// any direction.
class HandEffort {
 public:
  /// Errors: neither force nor travel, a ball joint, an axis of 0 0 0. The type must have the parameters kEffort... below.
  [[nodiscard]] static Expected<HandEffort> create(const Build& build, Effort effort);

  /// One tick. Writes force and travel; returns whether they have been enough for the required time.
  bool run(state::WorldState& state, bool enabled, double dt_s) const noexcept;

  [[nodiscard]] BodyId body() const noexcept { return body_; }

 private:
  struct Now {
    bool any = false;
    double force_n = 0;
  };
  [[nodiscard]] Now measure(const state::WorldState& state) const noexcept;
  void note_start(state::WorldState& state) const noexcept;
  [[nodiscard]] double travel(const state::WorldState& state) const noexcept;

  Effort effort_ = Effort::pull;
  BodyId body_;
  JointId joint_;
  bool has_axis_ = false;
  Vec3 axis_B_ = Vec3::Zero();
  double sign_ = 1;
  bool asks_force_ = false;
  bool asks_travel_ = false;
  double least_n_ = 0;
  double least_travel_ = 0;
  double time_s_ = 0;
  std::size_t force_ = 0;
  std::size_t travel_ = 0;
  std::size_t on_ = 0;                  // a hand is there
  std::size_t held_s_ = 0;              // how long it has been enough
  std::array<std::size_t, 3> start_{};  // where the body was when the hand came: the joint's position, or p_WB
  std::array<std::size_t, 3> way_{};    // the axis then, in W
};

// Of force and travel at least one must be given: create() checks it.
inline constexpr state::ParameterType kEffortBody{.name = "body",
                                                  .kind = state::ParameterKind::text,
                                                  .summary = "the body that a hand moves",
                                                  .required = true,
                                                  .reference = state::Reference::body};
inline constexpr state::ParameterType kEffortForce{.name = "force",
                                                   .unit = "N",
                                                   .summary = "enough from this force of the hand on, as felt",
                                                   .default_value = state::kNoDefault,
                                                   .min = 0,
                                                   .max = 1e4};
inline constexpr state::ParameterType kEffortTravel{
    .name = "travel",
    .unit = "m, rad of a hinge",
    .summary = "enough from this way on; with force: one of them is enough",
    .default_value = state::kNoDefault,
    .min = 0,
    .max = 1e4};
inline constexpr state::ParameterType kEffortAxis =
    state::direction("axis", "the direction that counts, in the body's frame; none: any");
inline constexpr state::ParameterType kEffortJoint{.name = "joint",
                                                   .kind = state::ParameterKind::text,
                                                   .summary = "the joint whose way is the travel; none: the body's own",
                                                   .reference = state::Reference::joint};
inline constexpr state::ParameterType kEffortReverse{
    .name = "reverse", .kind = state::ParameterKind::boolean, .summary = "with joint: towards lower positions"};
inline constexpr state::ParameterType kEffortTime{
    .name = "time", .unit = "s", .summary = "how long it must be enough", .min = 0, .max = 60};

}  // namespace mechane::agents
