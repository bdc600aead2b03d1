// What a client sends and receives, as plain structs. Frames and units: ARCHITECTURE.md (W: right-handed, y up, metres,
// radians).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/base/clock.hpp"
#include "server/base/math.hpp"
#include "server/hand/calibration_pose.hpp"
#include "server/hand/hand_force.hpp"

namespace mechane::client {

// The types of a hand are declared once, for server and clients, in server/hand.
using hand::HandKind;
using hand::HandSample;
using hand::HandSide;
using hand::HeldPath;
using hand::kFingers;
using hand::kHandJoints;
using hand::kHandSegments;
using hand::kMaxLocalContacts;
using hand::LocalContact;

/// What a visitor has to know of a haptic device.
enum class DeviceState : std::uint8_t {
  none,       ///< no device, or its program says nothing of it
  preparing,  ///< it is being opened, or fitted to the visitor's hand
  ready,
  let_go,        ///< its dead-man's switch is released
  not_ready,     ///< not held or not powered: its driver does not say which
  uncalibrated,  ///< somebody has to calibrate it
  warm,          ///< its force is lowered, to spare the motors
  hot,           ///< too warm for any force
  lost,          ///< gone or faulty
};

/// What a glove's program asks a visitor to show, so that the glove fits the hand.
enum class CalibrationStep : std::uint8_t { none, flat, fist, pinch, done };
/// The steps that ask for a pose, by hand::CalibrationPose.
inline constexpr std::array<CalibrationStep, hand::kCalibrationPoses> kPoseSteps{
    CalibrationStep::flat, CalibrationStep::fist, CalibrationStep::pinch};
/// The pose that a step asks for; none: it asks for nothing.
[[nodiscard]] constexpr std::optional<hand::CalibrationPose> pose_of(CalibrationStep step) noexcept {
  for (std::size_t pose = 0; pose < kPoseSteps.size(); ++pose)
    if (kPoseSteps[pose] == step) return static_cast<hand::CalibrationPose>(pose);
  return std::nullopt;
}

/// Why a pose is asked for once more.
enum class PoseRefusal : std::uint8_t {
  none,
  moved,    ///< the hand did not keep still
  unlike,   ///< not this pose, or too much like another one
  swapped,  ///< the first two poses were shown in the wrong order: all begins again
  unseen,   ///< not shown for long enough, or the glove was not ready
};

/// How far a glove's program is with its visitor. Nothing of the hand itself.
struct CalibrationNews {
  CalibrationStep step = CalibrationStep::none;
  float held = 0;  ///< how much of its time the pose was held, 0..1, in tenths that have begun: few messages tell it
  PoseRefusal refusal = PoseRefusal::none;
  friend bool operator==(const CalibrationNews&, const CalibrationNews&) = default;
};

/// The device of one hand of a kiosk.
struct DeviceReport {
  std::uint32_t user = 0;  ///< filled in by the client
  DeviceState state = DeviceState::none;
  HandKind kind = HandKind::one_point;
  HandSide side = HandSide::right;
  std::string name{};  ///< maker and model; at most 63 bytes, longer ones are cut
  CalibrationNews calibration{};
  friend bool operator==(const DeviceReport&, const DeviceReport&) = default;
};

/// What the server wants a device to render: the force, or, for a client that computes it at its device's own rate, the
/// contacts and the path of what is held. The device's own ForceGovernor has the last word.
struct ForceSample : hand::HapticOutput {
  std::uint64_t sequence = 0;  ///< rises by one with each force received
  TimePoint received;          ///< on this client's clock
  Duration waited{0};          ///< how long the answered input had waited at the server for this tick
  /// When the answered input was sent, on this client's clock.
  [[nodiscard]] TimePoint echo_sent() const noexcept {
    return TimePoint(Duration(static_cast<std::int64_t>(echo_sent_ns)));
  }
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
  std::array<Pose, kHandSegments> X_WS{};  ///< of a one-point hand only the first
  Vec3 force_W = Vec3::Zero();             ///< what this hand feels, N
  bool holding = false;
};

/// A rope's centre line, from the drum on which it is wound to its end.
struct RopeShape {
  double diameter_m = 0.02;
  std::vector<Vec3> points_W;  ///< equally many in each frame
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
  Pose X_WB;  ///< at the start; of bodies that never move, always
  bool movable = false;
  Texts title;  ///< its name for visitors; empty: it has none
};

struct QuantityInfo {
  /// The quantity that completes the step when it reaches a value.
  struct Goal {
    double value = 0;
    bool from_above = false;  ///< true: the quantity must fall below the value; false: rise above it
  };
  /// Where its gauge begins and ends: least < greatest.
  struct Range {
    double least = 0;
    double greatest = 1;
  };
  std::string name;
  std::string unit;
  std::optional<Goal> goal{};
  Texts label{};                 ///< its name for visitors; empty: its unit says what it is
  std::optional<Range> range{};  ///< none: its gauge begins at 0 and grows
};

/// The state of a world and its visit.
struct WorldStatus {
  std::string world;
  std::string scenario;  ///< id
  std::string scenario_hash;
  std::string scenario_folder;  ///< on the server's machine; for clients on the same machine
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
  Texts audio;         ///< its recording, as a path from the scenario's folder, where the author named one
  std::string detail;  ///< the view of this step's close-up; empty: none
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
  std::uint32_t marks = 0;      ///< scale: its number of marks
  Texts low;                    ///< scale: what its lowest and highest mark mean
  Texts high;
};

struct Activity {
  std::string name;
  Texts title;
  Texts goal;  ///< what a visitor should learn
  std::vector<Question> questions;
};

/// When a question is answered. The difference between before and after shows what was learnt.
enum class AnswerTime { before, after };

/// A visitor's answer, with the names of the presentation. The server checks it.
struct VisitAnswer {
  AnswerTime when = AnswerTime::after;
  std::string activity;
  std::string question;
  std::string answer;  ///< choice: the answer's name; scale: the mark, from 1 on
};

/// A viewpoint.
struct View {
  std::string name;
  Pose X_WV;                           ///< looks along -z, y up
  double field_of_view_rad = kPi / 4;  ///< of the picture's shorter side
};

/// Something that is seen or heard while a machine works, driven by a quantity of the frames.
struct Effect {
  std::string name;
  std::string kind;                     ///< level, flow, stream, jet, spray, steam, smoke, fire, dust, or sound.NAME
  std::optional<std::uint32_t> object;  ///< moves with this object; none: fixed in W
  std::string node;                     ///< level, flow: the node of the mesh file that rises or flows
  Vec3 p_BE = Vec3::Zero();             ///< in the object's frame
  Vec3 direction_B = Vec3::UnitY();     ///< unit
  std::uint32_t quantity = 0;           ///< into Frame::quantities; beyond its end for a flow, which nothing drives
  double full = 1;                      ///< the quantity's value at which the effect is strongest
  double size_m = 0;
  double speed_m_per_s = 0;
};

/// What a hand can do with an object. A is the base's frame, or W; B the object's.
struct Affordance {
  enum class Kind : std::uint8_t {
    taken,    ///< by a hand
    turns,    ///< about z of its joint
    slides,   ///< along x of its joint
    placed,   ///< where X_BJ reaches X_AJ, it snaps into place
    brought,  ///< where the point of X_BJ reaches that of X_AJ, something happens
  };
  Kind kind = Kind::taken;
  std::string agent;  ///< valid only while WorldStatus::enabled_agents contains this agent; empty: always
  std::uint32_t object = 0;
  std::optional<std::uint32_t> base;  ///< none: W
  Pose X_AJ;
  Pose X_BJ;
};

/// What a display shows of a world, as far as it never changes.
struct WorldPresentation {
  std::string world;
  std::vector<std::string> languages;  ///< codes; the first is shown first
  std::vector<Activity> activities;
  std::vector<View> views;  ///< the first is a display's usual viewpoint
  std::vector<Effect> effects;
  std::vector<Affordance> affordances;
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
  std::uint64_t overruns = 0;  ///< ticks of more than 1 ms CPU time
  std::uint64_t late_wakeups = 0;
  std::uint64_t preemptions = 0;
  double tick_us_median = 0, tick_us_p99 = 0, tick_us_p999 = 0, tick_us_max = 0;
  double wake_us_p99 = 0, wake_us_max = 0;
  bool realtime = false;  ///< SCHED_FIFO was granted
  bool records_ok = true;
  std::vector<std::string> scenarios{};  ///< ids of what it can open, home first
  std::uint64_t input_gaps = 0;          ///< how often a hand that was sending paused for 10 to 100 ms
  double input_gap_ms = 0;               ///< the longest of these pauses in the last ten seconds
  std::string overload{};                ///< what overloads the server, and what to do; empty: nothing
};

}  // namespace mechane::client
