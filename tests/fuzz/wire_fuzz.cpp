// Whatever bytes arrive as a sample: server and client accept or refuse it, and what they accept is fit for use.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "client-sdk/client/device_parse.hpp"
#include "client-sdk/client/exhibit_parse.hpp"
#include "client-sdk/client/frame_history.hpp"
#include "client-sdk/client/parse.hpp"
#include "server/hand/deadband.hpp"
#include "server/state/visit_answer.hpp"
#include "server/transport/exhibit_gate.hpp"
#include "server/transport/validate.hpp"
#include <mechane/client/types.hpp>
#include <mechane/proto/convert.hpp>
#include <mechane/proto/exhibit_key.hpp>
#include <mechane/proto/names.hpp>

namespace {

using namespace mechane;

/// Reads values from the input, and zeros after its end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  template <class T>
  T take() {
    T value{};
    const std::size_t n = std::min(sizeof(T), size_);
    std::memcpy(&value, data_, n);
    data_ += n;
    size_ -= n;
    return value;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

void must(bool held) {
  if (!held) std::abort();
}

void fuzz_input(Bytes bytes) {
  auto wire = bytes.take<proto::HapticInput>();
  wire.protocol = proto::kProtocol;
  hand::SentSample sample;
  if (transport::validate(wire, sample) != transport::Reject::none) return;
  must(sample.X_WH.p.norm() < hand::kFarthestHand_m && sample.session != 0);
  must(std::abs(sample.X_WH.R.norm() - 1) < 1e-9);
  must(wire.deadband >= 0 && wire.deadband <= hand::kMaxDeadband);
  must(hand::is_hand_side(static_cast<std::uint8_t>(sample.side)));
  for (const double scale : sample.finger_scale)
    must(scale > 0.69 && scale < 1.41);
}

void fuzz_output(Bytes bytes) {
  auto wire = bytes.take<proto::HapticOutput>();
  wire.protocol = proto::kProtocol;
  client::ForceSample force;
  if (!client::parse(wire, force)) return;
  must(force.contact_count <= hand::kMaxLocalContacts && force.force_W.f.allFinite() && force.force_W.t.allFinite());
  must(force.held.p_W.allFinite() && std::abs(force.held.axis_W.norm() - 1) < 1e-6 && force.held.limit_n >= 0);
}

void fuzz_kiosk(Bytes bytes) {
  auto wire = bytes.take<proto::KioskStatus>();
  wire.protocol = proto::kProtocol;
  client::DeviceReport device;
  if (client::parse(wire, device))
    must(device.user < hand::kMaxUsers && device.side <= client::HandSide::left &&
         device.state <= client::DeviceState::lost && device.calibration.held >= 0 && device.calibration.held <= 1 &&
         device.calibration.step <= client::CalibrationStep::done &&
         device.calibration.refusal <= client::PoseRefusal::unseen &&
         device.name.size() <= sizeof(wire.device_name));  // one without a closing zero is read to its end, not further
  transport::Session session;
  if (transport::validate(wire, session) != transport::Reject::none) return;
  must(proto::is_name(session.kiosk) && session.user < hand::kMaxUsers && session.id != 0);
}

void fuzz_frame(Bytes bytes) {
  client::FrameHistory history;
  for (int i = 0; i < 3; ++i) {
    std::vector<proto::WireBodyPose> bodies(bytes.take<std::uint8_t>() % 8);
    for (auto& b : bodies)
      b = bytes.take<proto::WireBodyPose>();
    std::vector<std::uint8_t> visible(bytes.take<std::uint8_t>() % 8);
    std::vector<double> quantities(bytes.take<std::uint8_t>() % 4);
    for (auto& q : quantities)
      q = bytes.take<double>();
    std::vector<proto::WirePose> segments(bytes.take<std::uint8_t>() % 20);
    for (auto& s : segments)
      s = bytes.take<proto::WirePose>();
    std::vector<proto::WireHandPose> hands(bytes.take<std::uint8_t>() % 3);
    for (auto& h : hands) {
      h.kind = bytes.take<std::uint8_t>();
      proto::look_into(h.X_WS, segments);
    }
    proto::SceneFrame wire{};
    wire.protocol = proto::kProtocol;
    wire.seq = bytes.take<std::uint8_t>();
    wire.sent_ns = bytes.take<std::uint64_t>();
    proto::look_into(wire.bodies, bodies);
    proto::look_into(wire.visible, visible);
    proto::look_into(wire.quantities, quantities);
    proto::look_into(wire.hands, hands);
    std::vector<float> line(bytes.take<std::uint8_t>() % 32);
    for (float& number : line)
      number = bytes.take<float>();
    std::vector<proto::WireRope> ropes(bytes.take<std::uint8_t>() % 3);
    for (auto& rope : ropes) {
      rope.diameter_m = bytes.take<float>();
      proto::look_into(rope.p_W, line);
    }
    proto::look_into(wire.ropes, ropes);
    client::Frame frame;
    if (!client::parse(wire, frame)) continue;
    frame.received = TimePoint(std::chrono::hours(1) + i * std::chrono::milliseconds(16));
    history.add(frame, wire.sent_ns);
  }
  client::Frame out;
  if (!history.at(TimePoint(std::chrono::hours(1)), out)) return;
  for (const auto& body : out.bodies)
    must(std::abs(body.X_WB.R.norm() - 1) < 1e-6);
  for (const auto& rope : out.ropes)
    must(rope.diameter_m > 0);
}

void fuzz_presentation(Bytes bytes) {
  std::vector<proto::WireView> views(bytes.take<std::uint8_t>() % 4);
  for (auto& view : views) {
    view.X_WV = bytes.take<proto::WirePose>();
    view.field_of_view_rad = bytes.take<float>();
  }
  std::vector<proto::WireEffect> effects(bytes.take<std::uint8_t>() % 4);
  for (auto& effect : effects) {
    effect = bytes.take<proto::WireEffect>();
    effect.name = effect.kind = effect.node = nullptr;
  }
  std::vector<proto::WireAffordance> affordances(bytes.take<std::uint8_t>() % 4);
  for (auto& way : affordances) {
    way = bytes.take<proto::WireAffordance>();
    way.agent = nullptr;
  }
  std::vector<proto::WireQuestion> questions(bytes.take<std::uint8_t>() % 4);
  for (auto& question : questions) {
    question = {};
    question.kind = bytes.take<std::uint8_t>();
    question.marks = bytes.take<std::uint32_t>();
  }
  std::vector<proto::WireActivity> activities(bytes.take<std::uint8_t>() % 4);
  for (auto& activity : activities)
    proto::look_into(activity.questions, questions);
  proto::WorldPresentation wire{};
  wire.protocol = proto::kProtocol;
  proto::look_into(wire.views, views);
  proto::look_into(wire.effects, effects);
  proto::look_into(wire.affordances, affordances);
  proto::look_into(wire.activities, activities);
  client::WorldPresentation presentation;
  if (!client::parse(wire, presentation)) return;
  for (const auto& view : presentation.views)
    must(view.field_of_view_rad > 0 && view.field_of_view_rad < kPi && std::abs(view.X_WV.R.norm() - 1) < 1e-9);
  for (const auto& effect : presentation.effects)
    must(effect.full > 0 && std::abs(effect.direction_B.norm() - 1) < 0.02 && effect.p_BE.allFinite());
  for (const auto& way : presentation.affordances)
    must(way.X_AJ.p.allFinite() && std::abs(way.X_BJ.R.norm() - 1) < 1e-6 &&
         way.kind <= client::Affordance::Kind::brought);
}

/// The goals of a step, for quantities that exist or not.
void fuzz_status(Bytes bytes) {
  std::vector<proto::WireQuantity> quantities(bytes.take<std::uint8_t>() % 4);
  std::vector<proto::WireQuantityGoal> goals(bytes.take<std::uint8_t>() % 6);
  for (auto& quantity : quantities) {
    quantity.ranged = bytes.take<std::uint8_t>() % 2 == 1;
    quantity.least = bytes.take<double>();
    quantity.greatest = bytes.take<double>();
  }
  for (auto& goal : goals) {
    goal.quantity = bytes.take<std::uint8_t>();
    goal.value = bytes.take<double>();
    goal.from_above = bytes.take<std::uint8_t>() % 2 == 1;
  }
  proto::WorldStatus wire{};
  wire.protocol = proto::kProtocol;
  proto::look_into(wire.quantities, quantities);
  proto::look_into(wire.goals, goals);
  client::WorldStatus status;
  if (!client::parse(wire, status)) return;
  must(status.quantities.size() == quantities.size() && goals.size() <= quantities.size());
  for (const auto& quantity : status.quantities)
    must((!quantity.goal || std::isfinite(quantity.goal->value)) &&
         (!quantity.range || quantity.range->least < quantity.range->greatest));
}

/// A scenario with one question of each kind, and the argument of a command.
void fuzz_answer(const std::uint8_t* data, std::size_t size) {
  state::WorldDescription world;
  state::QuestionDescription choice, scale;
  choice.name = scale.name = "q";
  choice.answers = {{"a", {}}, {"", {}}};
  scale.kind = state::QuestionDescription::Kind::scale;
  state::ActivityDescription one, other;
  one.name = "use";
  one.questionnaire = {choice, scale};
  world.activities = {one, other};
  const auto answer = state::parse_visit_answer({reinterpret_cast<const char*>(data), size}, world);
  if (!answer) return;
  must(answer->activity.index() == 0 && answer->question < 2);
  must(answer->question == 0 ? answer->answer < 2 : answer->answer >= 1 && answer->answer <= 5);
}

std::vector<proto::WireSetting> take_settings(Bytes& bytes) {
  std::vector<proto::WireSetting> settings(bytes.take<std::uint8_t>() % 80);
  for (auto& setting : settings)
    setting = bytes.take<proto::WireSetting>();
  return settings;
}

/// A request to a display: whatever it says, the settings stay within their ranges.
void fuzz_request(Bytes bytes) {
  proto::DisplayRequest wire{};
  wire.protocol = proto::kProtocol;
  wire.id = bytes.take<std::uint16_t>();
  const auto flags = bytes.take<std::uint8_t>();
  wire.picture = (flags & 1U) != 0;
  wire.restart = (flags & 2U) != 0;
  std::vector<proto::WireSetting> settings = take_settings(bytes);
  proto::look_into(wire.settings, settings);
  client::DisplayRequest request;
  if (!client::parse(wire, request)) return;
  const client::DisplaySettings before;
  client::DisplaySettings now;
  const bool taken = client::apply(request.settings, now).has_value();
  must(taken || now == before);
  must(now.volume >= 0 && now.volume <= 1 && now.home_after_s >= 0 && now.home_after_s <= 86'400);
  must(now.attract_after_s >= 5 && (now.language == "el" || now.language == "en"));
  client::DisplaySettings again;  // what a display reports can be requested
  must(client::apply(client::settings_of(now), again).has_value());
}

/// What the program of a device tells, and a request to it.
void fuzz_device(Bytes bytes) {
  auto status = bytes.take<proto::DeviceStatus>();
  status.testing = bytes.take<std::uint8_t>() % 2 == 1;
  status.protocol = proto::kProtocol;
  client::DeviceDetails details;
  if (client::parse(status, details)) {
    must(details.user < hand::kMaxUsers && client::check(details.place).has_value() && details.p_WH.allFinite());
    must(details.limits.wanted_hz >= 0 && details.limits.workspace_max_D_m.allFinite() && details.rate_hz >= 0);
    must(details.refusal.size() <= sizeof(status.refusal));
  }
  auto asked = bytes.take<proto::DeviceRequest>();
  asked.protocol = proto::kProtocol;
  client::DeviceRequest request;
  if (!client::parse(asked, request)) return;
  must(request.id != 0 && request.action <= client::DeviceAction::end_test && client::check(request).has_value());
}

/// The position of a head from a tracker, which a display uses for its picture.
void fuzz_head(Bytes bytes) {
  proto::ViewerHead wire{};
  wire.protocol = proto::kProtocol;
  std::memcpy(wire.kiosk, "kiosk-1", 8);
  wire.seen = bytes.take<std::uint8_t>() % 4 != 0;
  wire.X_SV = bytes.take<proto::WirePose>();
  client::ViewerHead head;
  if (!client::parse(wire, head)) return;
  must(head.X_SV.p.allFinite() && std::abs(head.X_SV.R.norm() - 1) < 1e-6);
}

void fuzz_display(Bytes bytes) {
  proto::DisplayStatus wire{};
  wire.protocol = proto::kProtocol;
  std::memcpy(wire.kiosk, "kiosk-1", 8);
  const auto name = bytes.take<std::array<char, sizeof(wire.display)>>();
  std::memcpy(wire.display, name.data(), name.size());
  wire.link = bytes.take<std::uint8_t>();
  for (float* number : {&wire.pictures_per_s, &wire.picture_ms_median, &wire.picture_ms_p99, &wire.wanted_per_s,
                        &wire.frames_per_s, &wire.frames_lost})
    *number = bytes.take<float>();
  const std::string text(bytes.take<std::uint8_t>() * std::size_t{4}, bytes.take<char>());
  wire.last_warning = wire.sound = wire.renderer = proto::look_into(text);
  std::vector<char*> missing(bytes.take<std::uint8_t>() % 80, proto::look_into(text));
  std::vector<proto::WireSetting> settings = take_settings(bytes);
  std::vector<proto::WireRequestAnswer> answers(bytes.take<std::uint8_t>() % 80);
  proto::look_into(wire.missing, missing);
  proto::look_into(wire.settings, settings);
  proto::look_into(wire.answers, answers);
  client::DisplayStatus status;
  if (!client::parse(wire, status)) return;
  must(proto::is_name(status.display) && status.link <= 3 && status.frames_lost >= 0 && status.frames_lost <= 1);
  must(status.pictures_per_s >= 0 && std::isfinite(status.pictures_per_s));
  must(status.last_warning.size() <= 500 && status.last_warning.find('\n') == std::string::npos);
}

/// What a server tells of its exhibits.
void fuzz_exhibits(Bytes bytes) {
  proto::ExhibitStatus wire{};
  wire.protocol = proto::kProtocol;
  const auto server = bytes.take<std::array<char, sizeof(wire.server)>>();
  std::memcpy(wire.server, server.data(), server.size());
  const std::string text(bytes.take<std::uint8_t>() * std::size_t{4}, bytes.take<char>());
  std::vector<proto::WireText> titles(bytes.take<std::uint8_t>() % 8);
  for (auto& title : titles) {
    const auto language = bytes.take<std::array<char, sizeof(title.language)>>();
    std::memcpy(title.language, language.data(), language.size());
    title.content = proto::look_into(text);
  }
  std::vector<proto::WireExhibit> exhibits(bytes.take<std::uint8_t>());
  for (auto& exhibit : exhibits) {
    exhibit.id = exhibit.content_hash = proto::look_into(text);
    proto::look_into(exhibit.title, titles);
  }
  std::vector<proto::WireExhibitAnswer> answers(bytes.take<std::uint8_t>() % 16);
  for (auto& answer : answers)
    answer.refusal = answer.place = answer.remedy = proto::look_into(text);
  std::vector<char*> loadable(bytes.take<std::uint8_t>(), proto::look_into(text));
  wire.preparing = proto::look_into(text);
  proto::look_into(wire.exhibits, exhibits);
  proto::look_into(wire.answers, answers);
  proto::look_into(wire.loadable, loadable);
  client::ExhibitStatus status;
  if (!client::parse(wire, status)) return;
  must(proto::is_name(status.server) && status.exhibits.size() == exhibits.size());
  must(std::ranges::all_of(status.answers, [](const auto& a) { return a.refusal.find('\n') == std::string::npos; }));
}

/// A request about exhibits: as it came, and with a seal of the server's key.
void fuzz_exhibit_request(Bytes bytes) {
  static const proto::ExhibitKey key = [] {
    const std::string folder = fmt::format("/tmp/mechane-wire-fuzz-{}", ::getpid());
    const proto::ExhibitKey made = proto::ExhibitKey::read_or_make(folder + "/exhibits.key").value();
    std::filesystem::remove_all(folder);
    return made;
  }();
  transport::ExhibitGate gate(key, "server-1", 5);
  auto wire = bytes.take<proto::ExhibitRequest>();
  wire.now = bytes.take<std::uint8_t>() % 2 == 1;
  wire.protocol = proto::kProtocol;
  proto::set_text(wire.server, "server-1");
  wire.incarnation = 5;
  transport::ExhibitOrder order;
  must(gate.take(wire, order) == transport::ExhibitFault::forged);
  key.seal(wire);
  if (gate.take(wire, order) != transport::ExhibitFault::none) return;
  must(proto::is_exhibit_name(order.exhibit) && order.verb <= transport::ExhibitVerb::retire);
  must(gate.take(wire, order) == transport::ExhibitFault::replayed);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const Bytes rest(data + 1, size - 1);
  if (data[0] >= 0xf0) {
    if (data[0] % 2 == 0) {
      fuzz_request(rest);
    } else {
      fuzz_display(rest);
    }
    return 0;
  }
  if (data[0] >= 0xe8) {
    if (data[0] % 2 == 0) {
      fuzz_exhibits(rest);
    } else {
      fuzz_exhibit_request(rest);
    }
    return 0;
  }
  if (data[0] >= 0xe0) {
    if (data[0] == 0xe7) {
      fuzz_device(rest);
    } else {
      fuzz_status(rest);
    }
    return 0;
  }
  if (data[0] >= 0x80) {
    if (data[0] % 2 == 0) {
      fuzz_presentation(rest);
    } else {
      fuzz_answer(data + 1, size - 1);
    }
    return 0;
  }
  switch (data[0] % 5) {
    case 0:
      fuzz_input(rest);
      break;
    case 1:
      fuzz_output(rest);
      break;
    case 2:
      fuzz_kiosk(rest);
      break;
    case 3:
      fuzz_frame(rest);
      break;
    default:
      fuzz_head(rest);
      break;
  }
  return 0;
}
