// What a client sends and receives, as plain structs. Frames and units: ARCHITECTURE.md (W: right-handed, y up, metres, radians).
#pragma once

#include <array>
#include <cstdint>
#include <map>
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

/// One frame of a world: every movable pose, every quantity, every hand.
struct Frame {
  std::uint64_t sequence = 0;
  std::uint64_t tick = 0;
  TimePoint received;
  std::vector<BodyPose> bodies;
  std::vector<std::uint8_t> visible;  ///< by object index
  std::vector<double> quantities;     ///< in the order of WorldStatus::quantities
  std::vector<HandPose> hands;
};

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
};

struct QuantityInfo {
  std::string name;
  std::string unit;
};

/// Where the visit is. Texts by language.
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
  std::map<std::string, std::string> title;  ///< by language
  std::map<std::string, std::string> caption;
  std::map<std::string, std::string> hint_text;
  std::vector<std::string> activities;
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
