// What a client sends and receives, as plain structs. Frames and units: ARCHITECTURE.md (W: right-handed, y up, metres, radians).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/base/clock.hpp"
#include "server/base/math.hpp"

namespace mechane::client {

inline constexpr std::size_t kFingers = 5;
inline constexpr std::size_t kHandJoints = 20;
inline constexpr std::size_t kHandSegments = 16;
inline constexpr std::size_t kMaxLocalContacts = 8;

enum class HandKind : std::uint8_t { one_point = 0, glove = 1 };

/// One sample of a device, at the moment of sending.
struct HandInput {
  HandKind kind = HandKind::one_point;
  Pose X_WH;                                 ///< wrist (glove) or tip (one-point)
  Twist V_WH;                                ///< its velocity, m/s and rad/s
  std::array<double, kHandJoints> joints{};  ///< per finger (thumb first): abduction, then three flexions, rad
  double hand_scale = 1;                     ///< the visitor's hand against the model's, 0.5 .. 1.5
  std::uint32_t buttons = 0;
  double grasp_intent = 0;  ///< 0 open .. 1 closed
};

/// A contact that the client can render at its device's own rate.
struct LocalContact {
  Vec3 p_W = Vec3::Zero();
  Vec3 n_W = Vec3::Zero();  ///< unit, into the hand
  Vec3 v_W = Vec3::Zero();  ///< velocity of the surface
  double depth_m = 0;
  double curvature_per_m = 0;
  double stiffness_n_per_m = 0;
  double damping_ns_per_m = 0;
  double friction = 0;
  Duration valid_for{0};  ///< from receipt
};

/// What the server wants a device to render. The device's own ForceGovernor has the last word.
struct ForceSample {
  std::uint64_t sequence = 0;
  std::uint64_t echo_sequence = 0;  ///< the input that this answers
  TimePoint echo_sent;              ///< when that input was sent, on this client's clock
  TimePoint received;               ///< on this client's clock
  Duration waited{0};               ///< how long that input waited at the server for this tick to take it
  Wrench force_W;                   ///< on the hand, N and N m
  std::array<double, kFingers> finger_force_n{};
  std::array<LocalContact, kMaxLocalContacts> contacts{};
  std::uint32_t contact_count = 0;
  std::uint32_t reasons = 0;  ///< force::ForceReason bits of the server's governor
  bool holding = false;
};

struct BodyPose {
  std::uint32_t object = 0;  ///< index into Scene::objects
  Pose X_WB;
};

struct HandPose {
  std::string kiosk;
  std::uint32_t user = 0;
  HandKind kind = HandKind::one_point;
  bool stale = false;
  std::array<Pose, kHandSegments> X_WS{};  ///< one-point: only the first
  Vec3 force_W = Vec3::Zero();             ///< what this hand feels, N
  bool holding = false;
};

/// A rope's middle as a line, from what is wound on a drum to its end.
struct RopeShape {
  double diameter_m = 0.02;
  std::vector<Vec3> points_W;  ///< as many in each frame
};

/// One frame of a world: every movable pose, every quantity, every hand, every rope.
struct Frame {
  std::uint64_t sequence = 0;
  std::uint64_t tick = 0;
  TimePoint received;
  std::vector<BodyPose> bodies;
  std::vector<std::uint8_t> visible;  ///< by object index
  std::vector<double> quantities;     ///< in the order of WorldStatus::quantities
  std::vector<HandPose> hands;
  std::vector<RopeShape> ropes;
};

/// Text by language code.
using Texts = std::map<std::string, std::string>;

/// One object of the manifest.
struct SceneObject {
  std::uint32_t index = 0;
  std::string name;
  std::string mesh_uri;   ///< relative to the scenario's folder
  std::string mesh_hash;  ///< hex XXH3-128
  std::string mesh_node;
  std::string parent;
  Pose X_WB;  ///< at the start; bodies that never move stay here
  bool movable = false;
  Texts title;  ///< what visitors call it; empty: `name` is not for them
};

struct QuantityInfo {
  /// What the step waits for.
  struct Goal {
    double value = 0;
    bool from_above = false;  ///< the quantity must fall below it; else it must rise above it
  };
  std::string name;
  std::string unit;
  std::optional<Goal> goal{};
};

/// Where the visit is.
struct WorldStatus {
  std::string world;
  std::string scenario;  ///< id
  std::string scenario_hash;
  std::string scenario_folder;  ///< as the server sees it; for clients on the same machine
  std::string activity;
  std::string step;
  std::uint32_t steps_done = 0;
  std::uint32_t steps_total = 0;
  bool done = false;
  bool hint = false;
  std::vector<std::string> enabled_agents;
  std::vector<QuantityInfo> quantities;
  Texts title;
  Texts caption;
  Texts hint_text;
  std::vector<std::string> activities;
  Texts narration;     ///< what is read aloud in this step
  Texts audio;         ///< its recording, by path from the scenario's folder, where the author named one
  std::string detail;  ///< a view of the presentation: a close-up belongs to this step; empty: none
};

/// A question of an activity, for before and after it.
struct Question {
  enum class Kind { choice, scale };
  struct Answer {
    std::string name;
    Texts text;
  };
  std::string name;
  Kind kind = Kind::choice;
  Texts text;
  std::vector<Answer> answers;  ///< choice: in the order shown
  std::uint32_t marks = 0;      ///< scale: how many
  Texts low;                    ///< scale: what its ends mean
  Texts high;
};

struct Activity {
  std::string name;
  Texts title;
  Texts goal;  ///< what a visitor shall learn
  std::vector<Question> questions;
};

/// From where to look.
struct View {
  std::string name;
  Pose X_WV;                           ///< looks along -z, y up
  double field_of_view_rad = kPi / 4;  ///< of the picture's shorter side
};

/// Something seen or heard of a machine's working, driven by a quantity of the frames.
struct Effect {
  std::string name;
  std::string kind;                     ///< level, flow, stream, jet, spray, steam, smoke, fire, dust, or sound.NAME
  std::optional<std::uint32_t> object;  ///< that it stays with; none: fixed in W
  std::string node;                     ///< level, flow: the node of the mesh file that rises or flows
  Vec3 p_BE = Vec3::Zero();             ///< in the object's frame
  Vec3 direction_B = Vec3::UnitY();     ///< unit
  std::uint32_t quantity = 0;           ///< into Frame::quantities; of a flow, which nothing drives, none of them
  double full = 1;                      ///< its value at which the effect is at its strongest
  double size_m = 0;
  double speed_m_per_s = 0;
};

/// What a hand can do with an object. A is the base's frame, or W; B the object's.
struct Way {
  enum class Kind : std::uint8_t {
    taken,    ///< by a hand
    turns,    ///< about z of its joint
    slides,   ///< along x of its joint
    placed,   ///< where X_BJ comes to X_AJ, it stays
    brought,  ///< where the point of X_BJ comes to that of X_AJ, something happens
  };
  Kind kind = Kind::taken;
  std::string agent;  ///< holds while WorldStatus::enabled_agents has it; empty: always
  std::uint32_t object = 0;
  std::optional<std::uint32_t> base;  ///< none: W
  Pose X_AJ;
  Pose X_BJ;
};

/// What a display shows of a world and that never changes.
struct WorldPresentation {
  std::string world;
  std::vector<std::string> languages;  ///< codes; the first is shown first
  std::vector<Activity> activities;
  std::vector<View> views;  ///< the first is where a display stands
  std::vector<Effect> effects;
  std::vector<Way> ways;
};

struct WorldEvent {
  std::uint64_t tick = 0;
  std::string kind;  ///< "grasped", "placed", "step_started" ...
  std::string subject;
  std::string object;
  double value = 0;
};

/// The server's health, ten times a second.
struct ServerStatus {
  std::string server;
  std::string version;
  std::uint32_t worlds = 0;
  std::uint32_t worlds_limit = 0;
  std::uint32_t users = 0;
  std::uint64_t ticks = 0;
  std::uint64_t overruns = 0;  ///< own CPU time over 1 ms
  std::uint64_t late_wakeups = 0;
  std::uint64_t preemptions = 0;
  double tick_us_median = 0, tick_us_p99 = 0, tick_us_p999 = 0, tick_us_max = 0;
  double wake_us_p99 = 0, wake_us_max = 0;
  bool realtime = false;  ///< SCHED_FIFO was granted
  bool records_ok = true;
  std::vector<std::string> scenarios{};  ///< ids of what it can open, home first
};

}  // namespace mechane::client
