// A world as a scenario describes it: compiled once, never changed while the world runs. World state points into it by index.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "server/base/ids.hpp"
#include "server/base/math.hpp"
#include "server/collision/object.hpp"
#include "server/state/event_description.hpp"

namespace mechane::state {

/// Text by language code: {"el", "..."}, {"en", "..."}.
using Texts = std::map<std::string, std::string>;

/// What touch feels. Stiffness and damping are those that the visitor's device renders.
struct HapticMaterial {
  double stiffness_n_per_m = 600;
  double damping_ns_per_m = 1.5;
  double static_friction = 0.5;
  double dynamic_friction = 0.3;
  double viscosity_ns_per_m = 0;      ///< along the surface, 0 .. hand::kMaxViscosity_ns_per_m
  double knock_ns_per_m = 0;          ///< the click of a first touch, per speed of approach
  double groove_depth_m = 0;          ///< from ridge to bottom; 0: smooth
  Vec3 groove_wave_B = Vec3::Zero();  ///< across the grooves, in the body's frame: 2 pi over their distance, rad/m
};

/// Where a body's picture is: a node of a mesh file.
struct MeshReference {
  std::string uri;           ///< relative to the scenario file
  std::string content_hash;  ///< hex XXH3-128 of the file
  std::string node;          ///< name of the node in the file; empty: the whole file
};

struct BodyDescription {
  std::string name;     ///< DEF of the RigidBody
  bool fixed = false;   ///< never moves; mass is not used
  bool driven = false;  ///< events alone move it, until a step makes it movable
  bool use_gravity = true;
  double mass_kg = 1;                     ///< the real one; the simulation uses mass * effort_scale
  Mat3 inertia_kg_m2 = Mat3::Identity();  ///< about the centre of mass, in the body's frame, unscaled
  Vec3 p_BCm = Vec3::Zero();              ///< centre of mass in the body's frame
  double effort_scale = 1;                ///< what a visitor's hand has to lift of it (reference: caption says so)
  double linear_damping = 0.02;           ///< share of velocity lost in a second, as Bullet's
  double angular_damping = 0.02;
  Pose X_WB;     ///< at the start
  Twist V_WB;    ///< of the body's origin, at the start
  Wrench drive;  ///< acts on the centre of mass all the time, in W, unscaled as the mass is
  HapticMaterial haptic;
  std::shared_ptr<const collision::Object> object;  ///< null: cannot be touched
  MeshReference mesh;
  bool visible = true;
  bool graspable = false;
  bool collides = false;  ///< with other bodies that do; see dynamics::DynamicsWorld for those that never meet
  double restitution =
      0;        ///< share of the approach speed that a collision gives back, 0 to 1; of a pair: the geometric mean
  Texts title;  ///< what visitors call it; empty: it has no title (`name` is not meant for them)
};

/// Two bodies that never collide, because one is made to fit into the other, more closely than distance maps are exact.
struct Mates {
  BodyId body1;
  BodyId body2;
};

enum class JointKind { hinge, slider, ball };

/// An X3D joint. The constraint is on only while its agent, or a step, enables it.
struct JointDescription {
  std::string name;
  JointKind kind = JointKind::hinge;
  BodyId body1;             ///< the frame side
  BodyId body2;             ///< the moving side; position and torque are of body2 against body1
  Pose X_B1J;               ///< joint frame in body1: z is the axis of a hinge, x that of a slider
  Pose X_B2J;               ///< joint frame in body2, coinciding with the former at position 0
  double min_position = 0;  ///< rad or m; min > max: no limits
  double max_position = -1;
  bool enabled_at_start = true;
};

/// A parameter as an author writes it.
using Parameter = std::variant<bool, std::vector<double>, std::vector<std::string>>;

/// An agent or a machine: a type from the registry, and its parameters. `line` is where the author wrote it.
struct ComponentDescription {
  std::string name;
  std::string type;  ///< "geometry.hinge", "simulation.grasp", "machine.screw_pump" ...
  std::map<std::string, Parameter> parameters;
  int line = 0;
  std::map<std::string, int> parameter_lines = {};  ///< of each written parameter; empty where no file was read

  /// A parameter as it was written, before it is checked against the type; null where it is not there, or of another type than T.
  template <class T>
  [[nodiscard]] const T* written(const std::string& parameter) const {
    const auto it = parameters.find(parameter);
    return it == parameters.end() ? nullptr : std::get_if<T>(&it->second);
  }
  /// The same of a parameter that is one text; null also where it is several.
  [[nodiscard]] const std::string* written_text(const std::string& parameter) const {
    const auto* texts = written<std::vector<std::string>>(parameter);
    return texts != nullptr && texts->size() == 1 ? &texts->front() : nullptr;
  }
};

/// Where a quantity's gauge begins and ends, in the quantity's unit: least < greatest.
struct GaugeRange {
  double least = 0;
  double greatest = 1;
};

struct QuantityDescription {
  std::string name;  ///< what rules and displays call it
  std::string
      source;        ///< "HINGE.angle", "HINGE.rate", "SNAP.placed", "PUMP.basin_l", "GRASP.active", "CRANK.position.y"
  std::string unit;  ///< SI or a unit that a visitor reads: "l", "rpm"
  Texts label{};     ///< what visitors call it; empty: displays name it by its unit
  std::optional<GaugeRange> range{};  ///< none: the gauge begins at 0 and grows
};

/// The units of quantities that displays show without a label of the author's, separated by blanks.
[[nodiscard]] constexpr std::string_view gauge_units() {
  return "l rpm l/min N degC km";
}

enum class Comparison { less, equal, greater };

/// One comparison of a trigger that has several.
struct RuleDescription {
  QuantityId quantity;
  Comparison comparison = Comparison::greater;
  double value = 0;
  double tolerance = 1e-6;  ///< for `equal`
};

struct TriggerDescription {
  QuantityId quantity;
  Comparison comparison = Comparison::greater;
  double value = 0;
  double tolerance = 1e-6;              ///< for `equal`
  double hold_s = 0;                    ///< how long it must hold
  StepId next;                          ///< none: the activity is done
  std::vector<RuleDescription> more{};  ///< rules beside the one above
  bool any = false;                     ///< one rule that holds is enough; else all must hold at once
};

/// What a step changes of a body, against its description.
struct BodyOverride {
  BodyId body;
  std::optional<bool> movable;
  std::optional<bool> visible;
  std::optional<bool> graspable;
  std::optional<Pose> X_WB;  ///< where the step puts it when it begins, at rest
  std::optional<bool> use_gravity{};
};

struct StepDescription {
  std::string name;
  ActivityId activity;
  std::vector<AgentId> enable;
  std::vector<AgentId> disable;
  std::vector<BodyOverride> bodies;
  std::vector<TriggerDescription> triggers;
  std::map<std::string, Texts>
      texts;  ///< "caption", "narration", "hint"; "audio": sound files, relative to the scenario
  double hint_after_s = 20;
  double timeout_s = 0;   ///< the step is left after so long, whatever holds; 0: never
  StepId timeout_next{};  ///< the step that follows then; none: the activity is done
  std::string detail{};   ///< name of the Viewpoint from which a close-up is shown; empty: none
  std::string opens{};    ///< id of the scenario that the visitors go on to as this step begins; empty: they stay
};

/// A question to a visitor after an activity.
struct QuestionDescription {
  enum class Kind { choice, scale };
  struct Answer {
    std::string name;
    Texts text;
  };
  std::string name;
  Kind kind = Kind::choice;
  Texts question;
  std::vector<Answer> answers;  ///< choice: in the order shown
  std::string correct;          ///< choice: the right answer's name; empty: no answer is right or wrong
  int marks = 5;                ///< scale: how many
  Texts low;                    ///< scale: what its ends mean
  Texts high;
};

struct ActivityDescription {
  std::string name;
  StepId first;
  Texts title;
  Texts goal{};  ///< what a visitor is to learn
  std::vector<QuestionDescription> questionnaire{};
};

/// One move of a scripted visit: what a person would do with one hand.
struct VisitMove {
  enum class Kind { reach, grasp, move_to, turn, swing, release, wait };
  Kind kind = Kind::wait;
  BodyId body;                ///< reach, grasp, move_to
  Vec3 p_BG = Vec3::Zero();   ///< reach: the grip's centre in the body's frame
  Pose X_WB;                  ///< move_to: where the body goes
  JointId joint;              ///< turn, swing
  double turns = 0;           ///< turn: how far, in turns of the joint
  double rate_rpm = 0;        ///< turn: how fast
  double amplitude_rad = 0;   ///< swing: how far to either side of the joint's 0; above 0: to positive angles first
  double cycles = 0;          ///< swing: how often to and fro
  double cycles_per_min = 0;  ///< swing: how fast
  double duration_s = 1;      ///< reach, grasp, move_to, release, wait
};

struct VisitDescription {
  std::string name;
  ActivityId activity;
  std::vector<VisitMove> moves;
};

struct Viewpoint {
  std::string name;  ///< DEF; empty: it has none
  std::string description;
  Pose X_WV;  ///< looks along -z, y up, as X3D
  double field_of_view_rad = kPi / 4;
};

/// What is seen, heard or felt of a working machine besides its bodies: water, steam, fire, a ratchet's teeth. It has no part in the
/// physics; a quantity of the world drives it, so that it stands still when the world does.
struct EffectDescription {
  std::string name;
  std::string kind;  ///< one of effect_kinds()
  BodyId body;       ///< none: fixed in W
  std::string node;  ///< `level`, `flow`: the node of the mesh file that rises or flows
  Vec3 p_BE = Vec3::Zero();
  Vec3 direction_B = Vec3::UnitY();  ///< unit
  QuantityId quantity;               ///< none: a `flow`
  double full = 1;                   ///< value of the quantity at which it is at its strongest
  double size_m = 0.02;
  double speed_m_per_s = 0.5;
  double force_n = 0.5;  ///< `touch.click`: at its strongest
  bool felt = false;     ///< `touch.click`: by hands, and not shown by displays
};

/// The kinds of effects, separated by blanks.
[[nodiscard]] constexpr std::string_view effect_kinds() {
  return "level flow stream jet spray steam smoke fire dust sound.water sound.wood sound.rope sound.stone sound.fire "
         "sound.steam "
         "sound.ratchet sound.bow touch.click";
}

struct WorldDescription {
  std::string id;            ///< "archimedes-screw"
  std::string content_hash;  ///< hex, of the scenario file and every mesh and setting that the physics depends on
  std::string folder;        ///< where the scenario file lies; mesh URIs are relative to it
  std::vector<std::string> languages;
  Texts title;
  Vec3 gravity_W{0, -9.81, 0};
  double effort_scale = 1;  ///< of the machine's loads at the hand
  double touch_scale = 1;   ///< the server's own, of every surface's stiffness and damping; `bodies` have it already
  std::vector<BodyDescription> bodies;
  std::vector<JointDescription> joints;
  std::vector<Mates> mates;
  std::vector<ComponentDescription> agents;
  std::vector<ComponentDescription> machines;
  std::vector<QuantityDescription> quantities;
  std::vector<ActivityDescription> activities;
  std::vector<StepDescription> steps;
  std::vector<VisitDescription> visits;
  std::vector<Viewpoint> viewpoints;  ///< the first is where a display stands
  std::vector<EffectDescription> effects;
  EventDescription events;

  [[nodiscard]] BodyId find_body(const std::string& name) const;
  [[nodiscard]] JointId find_joint(const std::string& name) const;
  [[nodiscard]] AgentId find_agent(const std::string& name) const;
  [[nodiscard]] MachineId find_machine(const std::string& name) const;
  [[nodiscard]] QuantityId find_quantity(const std::string& name) const;
  [[nodiscard]] StepId find_step(const std::string& name) const;
  [[nodiscard]] ActivityId find_activity(const std::string& name) const;
};

}  // namespace mechane::state
