#include "client-sdk/haptic/virtual_hand.hpp"

#include <cmath>

#include "client-sdk/drivers/options.hpp"
#include "client-sdk/haptic/tracked_hand.hpp"
#include "server/hand/calibration_pose.hpp"

namespace mechane::haptic {
namespace {

constexpr std::string_view kWholeHandOptions = "kind=phantom|glove|tracked hand=right|left";
constexpr double kMaxDelay_ms = 20;
constexpr double kMaxResolution_m = 0.001;
constexpr double kLeastContinuous_n = 0.1;
constexpr double kFist_rad = 1.2;  // each joint of a closed finger

}  // namespace

Expected<VirtualChoice> read_virtual_options(const std::string& options) {
  const std::vector<std::string> kinds = {"phantom", "glove", "tracked"};
  const bool whole = drivers::Options(options, kVirtualOptions).choice("kind", kinds) > 0;
  drivers::Options given(options, whole ? kWholeHandOptions : kVirtualOptions);
  const std::vector<std::string> kHeld = {"on", "off"}, kSides = {"right", "left"};
  VirtualChoice choice;
  if (whole) choice.hand = client::HandKind::glove;
  choice.tracked = given.choice("kind", kinds) == 2;
  const double delay_ms = given.number("delay", 0, 0, kMaxDelay_ms);
  choice.stylus.delay = static_cast<std::uint32_t>(delay_ms);
  const bool second = given.choice("hand", whole ? kSides : kHeld) == 1;
  if (whole && second) choice.side = client::HandSide::left;
  if (!whole && second) choice.stylus.hand.reset();
  choice.stylus.resolution_m = given.number("resolution", choice.stylus.resolution_m, 0, kMaxResolution_m);
  choice.stylus.continuous_n =
      given.number("continuous", choice.stylus.continuous_n, kLeastContinuous_n, choice.stylus.continuous_n);
  std::string fault = given.fault();
  if (fault.empty() && delay_ms != choice.stylus.delay) fault = "the delay is not in whole milliseconds";
  if (fault.empty()) return choice;
  if (whole) fault = "for a whole hand: " + fault;
  return fail(ErrorCode::invalid_value, std::move(fault), std::string(kVirtualName) + ":" + options,
              "'mechane devices' lists the options");
}

std::unique_ptr<SimulatedDevice> make_virtual_device(const VirtualChoice& choice, const Vec3& p_WH) {
  if (choice.hand == client::HandKind::one_point) return std::make_unique<SimulatedStylus>(choice.stylus, p_WH);
  std::unique_ptr<SimulatedDevice> whole;
  if (choice.tracked)
    whole = std::make_unique<TrackedHand>(choice.side);
  else
    whole = std::make_unique<VirtualDevice>(ArmConfig{}, choice.side);
  HandIntent begin;
  begin.kind = choice.hand;
  begin.X_WH.p = p_WH;
  whole->intend(begin);
  return whole;
}

HandIntent stroke(client::HandKind kind, const Vec3& center, double radius_m, double t_s) {
  HandIntent intent;
  intent.kind = kind;
  const double angle = 2 * kPi * t_s / 4;
  intent.X_WH.p = center + radius_m * Vec3(std::cos(angle), std::sin(angle), 0);
  if (kind == client::HandKind::one_point) return intent;
  intent.grasp_intent = 0.5 - 0.5 * std::cos(angle);
  for (std::size_t joint = 0; joint < intent.joints.size(); ++joint)
    if (joint % hand::kFingerJoints != 0) intent.joints[joint] = kFist_rad * intent.grasp_intent;
  return intent;
}

HandIntent show(client::CalibrationStep asked, const Vec3& p_WH, double t_s) {
  HandIntent intent = stroke(client::HandKind::glove, p_WH, 0, t_s);
  if (const auto pose = client::pose_of(asked)) intent.joints = hand::model_pose(*pose);
  return intent;
}

}  // namespace mechane::haptic
