// All that changes while a world runs. dynamics, haptics, machines and agents do not include each other: what one of them tells
// another is a field here. Everything is sized when the world is built; a tick only overwrites.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "server/base/ids.hpp"
#include "server/base/math.hpp"
#include "server/hand/governor.hpp"
#include "server/state/coupling.hpp"
#include "server/state/description.hpp"
#include "server/state/event.hpp"
#include "server/state/input.hpp"
#include "server/state/limits.hpp"

namespace mechane::state {

struct BodyState {
  Pose X_WB;
  Twist V_WB;           ///< of the body frame's origin
  bool movable = true;  ///< false: held still by the step (dynamics gives it infinite mass)
  bool visible = true;
  bool graspable = false;
  bool use_gravity = true;
  HapticMaterial
      haptic;  ///< what hands feel in this tick: the body's own, or what an agent sets. `run_agents` writes it.
  Wrench
      load_W;  ///< on the body's origin, this tick: contact forces of hands, loads of machines. Cleared by `step_dynamics`.
};

struct JointState {
  bool enabled = false;
  double position = 0;  ///< rad or m; a hinge counts whole turns on
  double velocity = 0;
  double min_position = 0;  ///< min > max: none
  double max_position = -1;
  double friction = 0;         ///< Coulomb friction, N m or N, as felt (already scaled)
  double viscous = 0;          ///< N m s/rad or N s/m, as felt
  double pitch_m_per_rad = 0;  ///< hinge: if not 0, it is a screw, which goes this far along its axis as it turns
  Vec3 cone_axis_J =
      Vec3::Zero();     ///< ball: if not 0, a unit vector, in either joint frame, that stays within the cone
  double cone_rad = 0;  ///< ball: half the cone's opening
  double load = 0;  ///< torque or force along the axis this tick, from machines (signed). Cleared by `step_dynamics`.
  double resistance =
      0;  ///< torque or force this tick, from machines, that only opposes motion (>= 0). Cleared by `step_dynamics`.
};

/// One point where a hand and a body overlap.
struct Contact {
  BodyId body;
  std::uint8_t segment = 0;    ///< 0 palm .. 15; 0 for a one-point device
  Vec3 p_WC = Vec3::Zero();    ///< the point, on the surface of the body
  Vec3 n_BH_W = Vec3::Zero();  ///< unit normal, from the body into the hand: the way out for the hand
  double depth_m = 0;          ///< > 0: how far they overlap along the normal
};

/// Where friction holds a segment of a hand on a body. The two points were at the same place when they met; what lies between them along
/// the surface is the stretch of a spring, and where that is too much for the friction, the body's point slides after the hand's.
struct FrictionAnchor {
  BodyId body;
  std::uint8_t segment = 0;
  bool slides = false;       ///< dynamic friction holds, not static
  Vec3 p_SA = Vec3::Zero();  ///< on the hand, in the segment's frame; that of a one-point device does not turn
  Vec3 p_BA = Vec3::Zero();  ///< on the body, in its frame
};

/// From which side a tip or palm came to a body that it touches.
struct WallSide {
  BodyId body;
  std::uint8_t segment = 0;
  Vec3 n_B = Vec3::Zero();  ///< unit, in the body's frame: the way out
  double height_m = 0;      ///< along n_B from the body's origin: where a ball in the segment is when it touches
};

/// A hand holds a body by a force-limited spring that dynamics solves as a constraint.
struct Grasp {
  bool active = false;
  BodyId body;
  Pose X_HB;                 ///< the body in the hand's frame at the moment of grasping
  Vec3 p_BG = Vec3::Zero();  ///< the grip's centre, in the body's frame
  double force_limit_n = 0;  ///< what the hand's spring can pull with, as felt
  double torque_limit_nm = 0;
  Wrench reaction_W;  ///< out of dynamics: what the body does to the hand, at the grip
};

struct UserState {
  bool present = false;
  bool stale = false;       ///< no new sample for 10 ms
  bool jumped = false;      ///< this tick's sample is farther from the last than a hand can move: let go, start anew
  double freshness = 0;     ///< 1 while samples are new, falling to 0 from 10 ms to 50 ms of age
  Duration age{0};          ///< of the last new sample
  hand::SentSample sample;  ///< the last one (frozen while stale)
  Pose X_WH;                ///< the hand as the tick uses it
  Twist V_WH;
  std::array<Pose, hand::kHandSegments> X_WS{};  ///< segments; one-point: only the first
  std::array<Contact, kMaxContacts> contacts{};
  std::uint32_t contact_count = 0;
  std::array<Contact, hand::kMaxLocalContacts> near{};  ///< surfaces not yet touched, with the gap as a depth <= 0
  std::uint32_t near_count = 0;
  std::array<FrictionAnchor, kMaxPatches> anchors{};  ///< of the touches of the last tick
  std::uint32_t anchor_count = 0;
  std::array<WallSide, kMaxSides> sides{};  ///< of the touches of the last tick
  std::uint32_t side_count = 0;
  Grasp grasp;
  hand::HapticOutput output;
  hand::Clicks clicks;           ///< that it has felt; part of each output
  std::uint64_t click_tick = 0;  ///< of the newest

  [[nodiscard]] std::span<const Contact> contact_span() const { return {contacts.data(), contact_count}; }
  [[nodiscard]] std::span<const Contact> near_span() const { return {near.data(), near_count}; }
  [[nodiscard]] std::span<const WallSide> side_span() const { return {sides.data(), side_count}; }
  /// Whether the hand touches that body, also where it is pressed through a thin wall and so past all contact.
  [[nodiscard]] bool touches(BodyId body) const noexcept;
  [[nodiscard]] bool holds(BodyId body) const noexcept { return grasp.active && grasp.body == body; }
};

/// Where the visit is in the scenario.
struct Progress {
  ActivityId activity;
  StepId step;
  bool done = false;            ///< the activity's last trigger has fired
  std::uint64_t step_tick = 0;  ///< when the step began
  std::uint64_t activity_tick = 0;
  std::uint32_t steps_done = 0;  ///< in this activity
  bool hint_shown = false;
};

struct WorldState {
  explicit WorldState(const WorldDescription& description);

  std::uint64_t tick = 0;
  std::vector<BodyState> bodies;
  std::vector<BodyId>
      weighed;  ///< bodies whose gravity steps change, each once: of the others `use_gravity` never changes
  std::vector<JointState> joints;
  std::vector<double> quantities;           ///< by QuantityId; written by `update_quantities` in agents
  std::vector<std::uint8_t> agent_enabled;  ///< by AgentId
  std::vector<Coupling> couplings;          ///< of the agents; see MemoryLayout::add_coupling
  std::vector<double> click_steps;          ///< by effect: the step that its quantity is on; NaN: not yet looked at
  std::vector<double> memory;  ///< what agents and machines remember: slots given out when the world is built
  std::array<UserState, hand::kMaxUsers> users{};
  std::array<hand::GovernorState, hand::kMaxUsers> governors{};  ///< by user; a hand that left still ramps down
  Progress progress;
  std::array<Event, kMaxEventsPerTick> events{};  ///< of this tick
  std::uint32_t event_count = 0;
  std::uint64_t events_dropped = 0;

  /// Adds an event of this tick; counts it as dropped where the table is full.
  void emit(EventKind kind, std::uint32_t subject, std::uint32_t object = 0xffffffffu, double value = 0) noexcept;
  [[nodiscard]] std::span<const Event> event_span() const { return {events.data(), event_count}; }

  BodyState& operator[](BodyId id) noexcept { return bodies[id.index()]; }
  const BodyState& operator[](BodyId id) const noexcept { return bodies[id.index()]; }
  JointState& operator[](JointId id) noexcept { return joints[id.index()]; }
  const JointState& operator[](JointId id) const noexcept { return joints[id.index()]; }
};

/// Adds a force (N, in W) at a point (in W) to a body's load. Called in the tick; allocates nothing.
void add_force(BodyState& body, const Vec3& f_B_W, const Vec3& p_WQ) noexcept;

/// Names and values that a component of the world offers to quantities: "HINGE.angle" is value 0 of agent HINGE, for example.
/// A component keeps its values in WorldState::memory, so that snapshots and hashes hold them without knowing what they mean.
struct MemorySlot {
  std::string name;       ///< "PUMP.basin_l"
  std::size_t index = 0;  ///< into WorldState::memory
};

/// Gives out slots of WorldState::memory while a world is built.
class MemoryLayout {
 public:
  /// A new slot named "<component>.<value>", starting at `initial`. Not in the tick.
  std::size_t add(const std::string& component, const std::string& value, double initial = 0);
  [[nodiscard]] const MemorySlot* find(const std::string& name) const;
  /// A coupling of that component: its index into WorldState::couplings. Not in the tick.
  std::size_t add_coupling(const std::string& component, const Coupling& coupling);
  /// The component's first coupling; null where it has none.
  [[nodiscard]] const MemorySlot* find_coupling(const std::string& component) const;
  /// What WorldState::couplings is at the start.
  [[nodiscard]] const std::vector<Coupling>& couplings() const { return couplings_; }
  [[nodiscard]] const std::vector<MemorySlot>& slots() const { return slots_; }
  [[nodiscard]] const std::vector<double>& initial() const { return initial_; }

 private:
  std::vector<MemorySlot> slots_;
  std::vector<double> initial_;
  std::vector<MemorySlot> coupling_slots_;
  std::vector<Coupling> couplings_;
};

/// Which fields are hashed and saved, and by which physics they were computed. Journals and snapshots say theirs; they are compared and
/// read over these fields, and journals are replayed with the forces on hands of their time. Powers of two: a flipped bit of a file does
/// not make another version of one.
enum class StateVersion : std::uint32_t {
  without_governors = 1,  ///< journals of version 1
  with_governors = 2,     ///< and with the age of each user's last sample
  with_anchors = 4,       ///< friction has static hold, before it was a damping; the normals of touches are smooth
  with_sides = 8,         ///< thin walls hold tips, and their normals are smooth
  with_builds = 16,       ///< hands are right or left, and their fingers have lengths of their own
  with_corners = 32,  ///< thin walls hold palms, corners of them hold by both; carried things have their whole weight
  with_direct_joints = 64,  ///< joints, couplings and grips are solved directly, no longer by sweeps alone
  with_gravity = 128,       ///< steps switch the gravity of bodies; where none does, the bytes are those of before
};
inline constexpr StateVersion kStateVersion = StateVersion::with_gravity;
/// The first whose bodies move as today's to the bit. Older journals replay closely, but their hashes cannot be compared.
inline constexpr StateVersion kSameMotion = StateVersion::with_direct_joints;
[[nodiscard]] constexpr bool is_known(StateVersion version) noexcept {
  return std::has_single_bit(static_cast<std::uint32_t>(version)) && version <= kStateVersion;
}

/// 64-bit XXH3 over the bits of everything that the next tick depends on, in a fixed order. Equal hashes: equal worlds.
[[nodiscard]] std::uint64_t state_hash(const WorldState& state, StateVersion version = kStateVersion) noexcept;

}  // namespace mechane::state
