#include "client-sdk/drivers/joints/hand_datagram.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace mechane::drivers {
namespace {

using nlohmann::json;

constexpr int kDeepestJson = 4;         // a number in a joint is at depth 3
constexpr double kFarthestJointM = 10;  // from the tracker: what lies beyond this is in other units
constexpr std::size_t kMostJoints = 26;

/// How a format numbers the joints that we use, and its axes.
struct JointsFormat {
  const char* name;
  std::size_t count;
  std::size_t wrist;
  bool metacarpals;  // each finger but the thumb begins with one
  bool camera;       // y is down, and z forwards
};
constexpr JointsFormat kJointsFormats[] = {
    {"openxr", kMostJoints, 1, true, false}, {"webxr", 25, 0, true, false}, {"mediapipe", 21, 0, false, true}};

const json* joints_member(const json& object, const char* name) {
  const auto found = object.find(name);
  return found == object.end() ? nullptr : &*found;
}

bool read_joint(const json& joint, bool camera, HandPoint& out) {
  if (!joint.is_array() || joint.size() != out.size()) return false;
  for (std::size_t axis = 0; axis < out.size(); ++axis) {
    if (!joint[axis].is_number()) return false;
    const double part = joint[axis].get<double>();
    if (!(std::abs(part) <= kFarthestJointM)) return false;
    out[axis] = camera && axis > 0 ? -part : part;
  }
  return true;
}

const char* read_joints(const json* joints, const JointsFormat& format, HandPoints& out) {
  if (joints == nullptr || !joints->is_array() || joints->size() != format.count)
    return "its joints are not a list of 26 for openxr, 25 for webxr or 21 for mediapipe";
  std::array<HandPoint, kMostJoints> all;
  for (std::size_t i = 0; i < format.count; ++i)
    if (!read_joint((*joints)[i], format.camera, all[i]))
      return "a joint is not three numbers within 10 m; the unit is the metre";
  out[0] = all[format.wrist];
  for (std::size_t f = 0; f < MECHANE_FINGERS; ++f)
    for (std::size_t j = 0; j < kJointsOfFinger; ++j)
      out[point_of(f, j)] = all[format.wrist + point_of(f, j) + (format.metacarpals ? f : 0)];
  return "";
}

/// A boolean, or one for each joint, of which all count: an angle needs its neighbours.
bool read_tracked(const json* tracked, std::size_t count, bool& out) {
  out = true;
  if (tracked == nullptr) return true;
  if (tracked->is_boolean()) {
    out = tracked->get<bool>();
    return true;
  }
  if (!tracked->is_array() || tracked->size() != count) return false;
  if (!std::ranges::all_of(*tracked, [](const json& one) { return one.is_boolean(); })) return false;
  out = std::ranges::all_of(*tracked, [](const json& one) { return one.get<bool>(); });
  return true;
}

const char* read_optional(const json& message, HandDatagram& hand) {
  if (const json* const sequence = joints_member(message, "seq")) {
    if (!sequence->is_number_unsigned()) return "its seq is not a whole number from 0 on";
    hand.sequence = sequence->get<std::uint64_t>();
  }
  if (const json* const pinch = joints_member(message, "pinch")) {
    if (!pinch->is_number()) return "its pinch is not a number";
    hand.pinch = pinch->get<double>();
    if (!(*hand.pinch >= 0 && *hand.pinch <= 1)) return "its pinch is not 0 to 1";
  }
  return "";
}

const char* read_hand(const json& message, HandDatagram& hand) {
  const json* const name = joints_member(message, "format");
  const auto* const format = std::ranges::find_if(
      kJointsFormats, [&](const JointsFormat& known) { return name != nullptr && *name == known.name; });
  if (format == std::end(kJointsFormats)) return "its format is not openxr, webxr or mediapipe";
  const json* const side = joints_member(message, "hand");
  if (side == nullptr || (*side != "left" && *side != "right")) return "its hand is not left or right";
  hand.left = *side == "left";
  if (!read_tracked(joints_member(message, "tracked"), format->count, hand.tracked))
    return "its tracked is not a boolean, or one for each joint";
  if (const char* const why = read_optional(message, hand); *why != '\0') return why;
  const json* const joints = joints_member(message, "joints");
  return joints == nullptr && !hand.tracked ? "" : read_joints(joints, *format, hand.points);
}

}  // namespace

const char* parse_hand_datagram(std::string_view text, HandDatagram& out) {
  if (text.size() > kLongestHandDatagram) return "it is longer than 16 KiB";
  bool too_deep = false;
  const json message = json::parse(
      text,
      [&](int depth, json::parse_event_t, json&) {
        too_deep = too_deep || depth > kDeepestJson;
        return !too_deep;
      },
      false);
  if (too_deep) return "its JSON is nested too deeply";
  if (message.is_discarded()) return "it is not JSON with finite numbers";
  if (!message.is_object()) return "it is not a JSON object";
  HandDatagram hand;
  const char* const why = read_hand(message, hand);
  if (*why == '\0') out = hand;
  return why;
}

}  // namespace mechane::drivers
