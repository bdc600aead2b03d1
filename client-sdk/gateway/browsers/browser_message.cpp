#include "client-sdk/gateway/browsers/browser_message.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

namespace mechane::gateway {
namespace {

using MessageJson = nlohmann::json;
using picture::OverlayAction;
using pointer::PointerEvent;

constexpr double kFarthest = 1e6;  // metres, pixels
constexpr std::size_t kLongestName = 200;
constexpr std::uint32_t kLargestPicture = 20000;

constexpr std::array<std::pair<PointerEvent::Kind, std::string_view>, 9> kEventKinds{{
    {PointerEvent::Kind::press, "press"},
    {PointerEvent::Kind::release, "release"},
    {PointerEvent::Kind::move, "move"},
    {PointerEvent::Kind::turn_press, "turn_press"},
    {PointerEvent::Kind::turn_release, "turn_release"},
    {PointerEvent::Kind::wheel, "wheel"},
    {PointerEvent::Kind::turn_wheel, "turn_wheel"},
    {PointerEvent::Kind::left, "left"},
    {PointerEvent::Kind::gone, "gone"},
}};
constexpr std::array<std::pair<OverlayAction::Kind, std::string_view>, 6> kActions{{
    {OverlayAction::Kind::home, "home"},
    {OverlayAction::Kind::language, "language"},
    {OverlayAction::Kind::answer, "answer"},
    {OverlayAction::Kind::skip, "skip"},
    {OverlayAction::Kind::close, "close"},
    {OverlayAction::Kind::activity, "activity"},
}};

/// Reads fields of one object. After the first wrong one, all give nothing, and wrong() says which it was.
class Fields {
 public:
  Fields(const MessageJson& object, std::string where) : object_(object), where_(std::move(where)) {
    if (!object_.is_object()) blame("");
  }
  [[nodiscard]] bool has(const char* name) const { return object_.is_object() && object_.contains(name); }
  [[nodiscard]] const MessageJson& at(const char* name) {
    static const MessageJson kNothing;
    if (has(name)) return object_[name];
    blame(name);
    return kNothing;
  }
  [[nodiscard]] double number(const char* name, double least = -kFarthest, double most = kFarthest) {
    const MessageJson& value = at(name);
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (number >= least && number <= most) return number;
    blame(name);
    return 0;
  }
  [[nodiscard]] double number_or(const char* name, double otherwise, double most = kFarthest) {
    return has(name) ? number(name, -most, most) : otherwise;
  }
  [[nodiscard]] std::uint32_t index(const char* name, std::uint32_t most) {
    return static_cast<std::uint32_t>(number(name, 0, most));
  }
  [[nodiscard]] std::string text(const char* name) {
    const MessageJson& value = at(name);
    if (value.is_string() && value.get_ref<const std::string&>().size() <= kLongestName) return value;
    blame(name);
    return {};
  }
  [[nodiscard]] std::optional<bool> flag(const char* name) {
    if (!has(name)) return std::nullopt;
    if (object_[name].is_boolean()) return object_[name].get<bool>();
    blame(name);
    return std::nullopt;
  }
  template <std::size_t Count>
  [[nodiscard]] std::array<double, Count> numbers(const char* name) {
    std::array<double, Count> out{};
    const MessageJson& list = at(name);
    bool right = list.is_array() && list.size() == Count;
    for (std::size_t i = 0; right && i < Count; ++i) {
      right = list[i].is_number() && std::abs(list[i].get<double>()) <= kFarthest;
      if (right) out[i] = list[i].get<double>();
    }
    if (!right) blame(name);
    return out;
  }
  void blame(const std::string& name) {
    if (!wrong_) wrong_ = where_ + (where_.empty() || name.empty() ? "" : ".") + name;
  }
  [[nodiscard]] const std::optional<std::string>& wrong() const { return wrong_; }

 private:
  const MessageJson& object_;
  std::string where_;
  std::optional<std::string> wrong_;
};

tl::unexpected<Error> wrong_field(const std::string& name) {
  return fail(ErrorCode::invalid_value, "a message has a field that is missing or wrong", name,
              "send what STREAM.md says");
}

Expected<picture::Sight> sight_of(Fields& message) {
  Fields camera(message.at("camera"), "camera");
  const auto size = message.numbers<2>("picture");
  const auto pose = camera.numbers<7>("pose");
  const double fov = camera.number("fov", 0.01, 3.1);
  const double aspect = camera.number("aspect", 0.01, 100);
  const auto offset = camera.has("offset") ? camera.numbers<2>("offset") : std::array<double, 2>{};
  if (camera.wrong()) return wrong_field(*camera.wrong());
  if (message.wrong()) return wrong_field(*message.wrong());
  const Quat R_WC(pose[6], pose[3], pose[4], pose[5]);
  if (std::abs(R_WC.norm() - 1) > 0.01) return wrong_field("camera.pose");
  if (!(size[0] >= 2 && size[1] >= 2 && size[0] <= kLargestPicture && size[1] <= kLargestPicture))
    return wrong_field("picture");
  const Pose X_CW = Pose{Vec3(pose[0], pose[1], pose[2]), R_WC.normalized()}.inverse();
  constexpr double kNear_m = 0.05, kFar_m = 400;
  picture::Sight sight;
  sight.picture = {static_cast<std::uint32_t>(size[0]), static_cast<std::uint32_t>(size[1])};
  sight.view.p_WE = Vec3(pose[0], pose[1], pose[2]).cast<float>();
  sight.view.V_CW.topLeftCorner<3, 3>() = X_CW.R.toRotationMatrix().cast<float>();
  sight.view.V_CW.topRightCorner<3, 1>() = X_CW.p.cast<float>();
  Eigen::Matrix4d P = Eigen::Matrix4d::Zero();
  P(1, 1) = 1 / std::tan(fov / 2);
  P(0, 0) = P(1, 1) / aspect;
  P(0, 2) = offset[0];
  P(1, 2) = offset[1];
  P(2, 2) = -(kFar_m + kNear_m) / (kFar_m - kNear_m);
  P(2, 3) = -2 * kFar_m * kNear_m / (kFar_m - kNear_m);
  P(3, 2) = -1;
  sight.view.P = P.cast<float>();
  return sight;
}

Expected<PointerMessage::One> event_of(const MessageJson& json) {
  Fields event(json, "events");
  const std::string kind = event.text("kind");
  const auto known = std::ranges::find(kEventKinds, kind, &std::pair<PointerEvent::Kind, std::string_view>::second);
  if (known == kEventKinds.end()) event.blame("kind");
  PointerMessage::One one;
  one.event.x = event.number_or("x", 0);
  one.event.y = event.number_or("y", 0);
  one.event.amount = event.number_or("amount", 0, 1000);
  one.event.finger = event.has("finger") ? static_cast<pointer::FingerId>(event.number("finger", 0, 1e15)) : 0;
  if (event.has("pick") && !event.at("pick").is_null()) {
    Fields pick(event.at("pick"), "events.pick");
    const std::uint32_t object = pick.index("object", 1'000'000);
    const auto p = pick.numbers<3>("p");
    if (pick.wrong()) return wrong_field(*pick.wrong());
    one.pick = picture::Touched{object, Vec3(p[0], p[1], p[2])};
  }
  if (event.wrong()) return wrong_field(*event.wrong());
  one.event.kind = known->first;
  return one;
}

Expected<BrowserMessage> pointer_of(Fields& message) {
  const MessageJson& list = message.at("events");
  if (!list.is_array()) return wrong_field("events");
  if (list.size() > kMostEvents)
    return fail(ErrorCode::too_large, "a message has more than 64 events", "events", "send several messages");
  auto sight = sight_of(message);
  if (!sight) return tl::unexpected(sight.error());
  PointerMessage out{{}, *sight};
  for (const MessageJson& json : list) {
    auto one = event_of(json);
    if (!one) return tl::unexpected(one.error());
    out.events.push_back(*one);
  }
  return out;
}

BrowserMessage status_of(Fields& message) {
  StatusMessage out;
  out.pictures_per_s = message.number("picturesPerS", 0, 1000);
  out.picture_ms_median = message.number("pictureMsMedian", 0, 1e5);
  out.picture_ms_p99 = message.number("pictureMsP99", 0, 1e5);
  out.width = message.index("width", kLargestPicture);
  out.height = message.index("height", kLargestPicture);
  if (message.has("renderer")) out.renderer = message.text("renderer");
  if (!message.has("missing")) return out;
  const MessageJson& list = message.at("missing");
  if (!list.is_array() || list.size() > kMostEvents) message.blame("missing");
  for (const MessageJson& name : list) {
    if (!name.is_string() || name.get_ref<const std::string&>().size() > kLongestName)
      message.blame("missing");
    else
      out.missing.push_back(name.get<std::string>());
  }
  return out;
}

}  // namespace

Expected<BrowserMessage> parse_browser_message(std::string_view text) {
  const MessageJson json = MessageJson::parse(text, nullptr, false);
  if (!json.is_object())
    return fail(ErrorCode::damaged, "a message is not a JSON object", {}, "send what STREAM.md says");
  Fields message(json, "");
  const std::string type = message.text("type");
  if (message.wrong()) return wrong_field("type");
  Expected<BrowserMessage> out = TouchMessage{};
  if (type == "pointer") {
    return pointer_of(message);
  } else if (type == "press") {
    const auto action = action_of(message.text("action"));
    if (!action) message.blame("action");
    out = PressMessage{action.value_or(OverlayAction{})};
  } else if (type == "language") {
    out = LanguageMessage{message.text("code")};
  } else if (type == "click") {
    out = ClickMessage{message.index("object", 1'000'000)};
  } else if (type == "settings") {
    const auto large = message.flag("largeText"), contrast = message.flag("highContrast");
    out = SettingsMessage{large, contrast};
  } else if (type == "status") {
    out = status_of(message);
  } else if (type != "touch") {
    return fail(ErrorCode::unknown_name, "no message has this type", "type", "send what STREAM.md says");
  }
  if (message.wrong()) return wrong_field(*message.wrong());
  return out;
}

std::string action_text(const OverlayAction& action) {
  const auto known = std::ranges::find(kActions, action.kind, &std::pair<OverlayAction::Kind, std::string_view>::first);
  return std::string(known->second) + (action.value.empty() ? "" : ":" + action.value);
}

std::optional<OverlayAction> action_of(std::string_view text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const auto known =
      std::ranges::find(kActions, text.substr(0, colon), &std::pair<OverlayAction::Kind, std::string_view>::second);
  if (known == kActions.end()) return std::nullopt;
  return OverlayAction{known->first, std::string(text.substr(std::min(colon + 1, text.size())))};
}

}  // namespace mechane::gateway
