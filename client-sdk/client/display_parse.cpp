#include <cmath>

#include "client-sdk/client/clean_text.hpp"
#include "client-sdk/client/parse.hpp"
#include <mechane/client/client.hpp>
#include <mechane/proto/convert.hpp>

namespace mechane::client {
namespace {

static_assert(mechane_link_searching == static_cast<int>(LinkState::searching));
static_assert(mechane_link_joined == static_cast<int>(LinkState::joined));
static_assert(mechane_link_refused == static_cast<int>(LinkState::refused));
static_assert(mechane_link_lost == static_cast<int>(LinkState::lost));
static_assert(mechane_device_none == static_cast<int>(DeviceState::none));
static_assert(mechane_device_preparing == static_cast<int>(DeviceState::preparing));
static_assert(mechane_device_ready == static_cast<int>(DeviceState::ready));
static_assert(mechane_device_let_go == static_cast<int>(DeviceState::let_go));
static_assert(mechane_device_not_ready == static_cast<int>(DeviceState::not_ready));
static_assert(mechane_device_uncalibrated == static_cast<int>(DeviceState::uncalibrated));
static_assert(mechane_device_warm == static_cast<int>(DeviceState::warm));
static_assert(mechane_device_hot == static_cast<int>(DeviceState::hot));
static_assert(mechane_device_lost == static_cast<int>(DeviceState::lost));
static_assert(mechane_calibration_none == static_cast<int>(CalibrationStep::none));
static_assert(mechane_calibration_flat == static_cast<int>(CalibrationStep::flat));
static_assert(mechane_calibration_fist == static_cast<int>(CalibrationStep::fist));
static_assert(mechane_calibration_pinch == static_cast<int>(CalibrationStep::pinch));
static_assert(mechane_calibration_done == static_cast<int>(CalibrationStep::done));
static_assert(mechane_refusal_none == static_cast<int>(PoseRefusal::none));
static_assert(mechane_refusal_moved == static_cast<int>(PoseRefusal::moved));
static_assert(mechane_refusal_unlike == static_cast<int>(PoseRefusal::unlike));
static_assert(mechane_refusal_swapped == static_cast<int>(PoseRefusal::swapped));
static_assert(mechane_refusal_unseen == static_cast<int>(PoseRefusal::unseen));

template <class Sequence>
bool parse_settings(const Sequence& wire, std::vector<DisplaySetting>& out) {
  const auto settings = proto::elements(wire);
  if (settings.size() > kMaxSettings) return false;
  out.clear();
  for (const proto::WireSetting& setting : settings)
    out.push_back({clean(setting.name), clean(setting.value)});
  return true;
}

bool parse_lists(const proto::DisplayStatus& wire, DisplayStatus& out) {
  const auto missing = proto::elements(wire.missing);
  const auto answers = proto::elements(wire.answers);
  if (missing.size() > kMaxListed || answers.size() > kMaxListed) return false;
  out.missing.clear();
  for (const char* file : missing)
    out.missing.push_back(one_line(file));
  out.answers.clear();
  for (const proto::WireRequestAnswer& answer : answers)
    out.answers.push_back({answer.id, one_line(answer.refusal), one_line(answer.picture)});
  return parse_settings(wire.settings, out.settings);
}

}  // namespace

bool parse(const proto::DisplayStatus& wire, DisplayStatus& out) {
  if (wire.protocol != proto::kProtocol || wire.link > mechane_link_lost) return false;
  if (!proto::is_name(proto::text_of(wire.kiosk)) || !proto::is_name(proto::text_of(wire.display))) return false;
  for (const float number : {wire.pictures_per_s, wire.picture_ms_median, wire.picture_ms_p99, wire.wanted_per_s,
                             wire.frames_per_s, wire.frames_lost}) {
    if (!std::isfinite(number) || number < 0) return false;
  }
  if (wire.frames_lost > 1) return false;
  out.kiosk = proto::text_of(wire.kiosk);
  out.display = proto::text_of(wire.display);
  out.session = wire.session;
  out.version = one_line(wire.version);
  out.host = one_line(wire.host);
  out.process_id = wire.process_id;
  out.uptime_s = wire.uptime_s;
  out.width = wire.width;
  out.height = wire.height;
  out.offscreen = wire.offscreen;
  out.pictures = wire.pictures;
  out.pictures_per_s = wire.pictures_per_s;
  out.picture_ms_median = wire.picture_ms_median;
  out.picture_ms_p99 = wire.picture_ms_p99;
  out.wanted_per_s = wire.wanted_per_s;
  out.link = wire.link;
  out.refusal = one_line(wire.refusal);
  out.world = one_line(wire.world);
  out.scenario = one_line(wire.scenario);
  out.frames_per_s = wire.frames_per_s;
  out.frames_lost = wire.frames_lost;
  out.missing_total = wire.missing_total;
  out.renderer = one_line(wire.renderer);
  out.sound = one_line(wire.sound);
  out.sound_problem = one_line(wire.sound_problem);
  out.showing = one_line(wire.showing);
  out.warnings = wire.warnings;
  out.last_warning = one_line(wire.last_warning);
  return parse_lists(wire, out);
}

bool parse(const proto::KioskStatus& wire, DeviceReport& out) {
  if (wire.protocol != proto::kProtocol || !proto::is_name(proto::text_of(wire.kiosk))) return false;
  if (wire.role != mechane_role_hand || wire.user >= hand::kMaxUsers) return false;
  if (wire.device > mechane_device_lost || !hand::is_hand_kind(wire.device_kind)) return false;
  if (!hand::is_hand_side(wire.device_side)) return false;
  if (wire.calibration > mechane_calibration_done || wire.calibration_refusal > mechane_refusal_unseen) return false;
  if (!(wire.calibration_held >= 0 && wire.calibration_held <= 1)) return false;
  out.user = wire.user;
  out.state = static_cast<DeviceState>(wire.device);
  out.kind = static_cast<HandKind>(wire.device_kind);
  out.side = static_cast<HandSide>(wire.device_side);
  out.name = clean(wire.device_name);
  out.calibration = {static_cast<CalibrationStep>(wire.calibration), wire.calibration_held,
                     static_cast<PoseRefusal>(wire.calibration_refusal)};
  return true;
}

bool parse(const proto::ViewerHead& wire, ViewerHead& out) {
  if (wire.protocol != proto::kProtocol || !proto::is_name(proto::text_of(wire.kiosk))) return false;
  out.seen = wire.seen;
  out.X_SV = Pose{};
  if (!wire.seen) return true;
  if (!proto::all_finite(wire.X_SV)) return false;
  out.X_SV = proto::to_pose(wire.X_SV);
  return proto::normalise(out.X_SV);
}

bool parse(const proto::DisplayRequest& wire, DisplayRequest& out) {
  if (wire.protocol != proto::kProtocol || wire.id == 0) return false;
  out.id = wire.id;
  out.picture = wire.picture;
  out.restart = wire.restart;
  return parse_settings(wire.settings, out.settings);
}

}  // namespace mechane::client
