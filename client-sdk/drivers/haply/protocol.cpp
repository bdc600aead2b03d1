#include "client-sdk/drivers/haply/protocol.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <nlohmann/json.hpp>

namespace mechane::drivers {
namespace {

using nlohmann::json;

// The arm reaches about 0.4 m from its base: what lies beyond this is in other units, or scaled by the service.
constexpr double kReachM = 1.0;
constexpr double kUnitTolerance = 0.1;

constexpr std::array kXyz{"x", "y", "z"};
constexpr std::array kWxyz{"w", "x", "y", "z"};

const json* member(const json* object, const char* name) {
  if (object == nullptr || !object->is_object()) return nullptr;
  const auto found = object->find(name);
  return found == object->end() ? nullptr : &*found;
}

const json* list(const json& message, const char* name) {
  const json* const found = member(&message, name);
  return found != nullptr && found->is_array() ? found : nullptr;
}

std::string text_of(const json* value) {
  return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
}

/// False, with `out` as it was, unless all are there and finite.
template <std::size_t N>
bool read_numbers(const json* object, const std::array<const char*, N>& names, std::array<double, N>& out) {
  std::array<double, N> numbers{};
  for (std::size_t i = 0; i < N; ++i) {
    const json* const number = member(object, names[i]);
    if (number == nullptr || !number->is_number()) return false;
    numbers[i] = number->get<double>();
    if (!std::isfinite(numbers[i])) return false;
  }
  out = numbers;
  return true;
}

bool is_true(const json* value) {
  return value != nullptr && value->is_boolean() && value->get<bool>();
}
bool is_false(const json* value) {
  return value != nullptr && value->is_boolean() && !value->get<bool>();
}

/// Grips name their buttons in three ways: one `button`, or `buttons` with a to c or with button_0 to button_3.
std::uint32_t buttons_of(const json* state) {
  constexpr std::array kLetters{"a", "b", "c"};
  constexpr std::array kNumbered{"button_0", "button_1", "button_2", "button_3"};
  const json* const buttons = member(state, "buttons");
  std::uint32_t bits = is_true(member(state, "button")) ? 1U : 0U;
  for (std::size_t i = 0; i < kLetters.size(); ++i)
    if (is_true(member(buttons, kLetters[i]))) bits |= 1U << i;
  for (std::size_t i = 0; i < kNumbered.size(); ++i)
    if (is_true(member(buttons, kNumbered[i]))) bits |= 1U << i;
  return bits;
}

/// A grip that sleeps, or whose data are not whole, counts as not there.
bool read_grip(const json& grip, HaplyFrame& frame) {
  const json* const state = member(&grip, "state");
  std::array<double, 4> q{};
  if (!read_numbers(member(state, "orientation"), kWxyz, q)) return false;
  const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  if (std::abs(length - 1) > kUnitTolerance) return false;
  for (double& part : q)
    part /= length;
  frame.grip_wxyz = q;
  frame.grip_buttons = buttons_of(state);
  return true;
}

void read_grips(const json& message, HaplyFrame& frame) {
  frame.has_grip = false;
  frame.grip_buttons = 0;
  for (const char* const kind : {"verse_grip", "wireless_verse_grip"}) {
    const json* const grips = list(message, kind);
    if (grips == nullptr) continue;
    for (const json& grip : *grips) {
      if (!read_grip(grip, frame)) continue;
      frame.has_grip = true;
      return;
    }
  }
}

/// Empty, or what is wrong with the arm's data.
const char* read_arm(const json& arm, HaplyFrame& frame) {
  const json* const state = member(&arm, "state");
  if (!read_numbers(member(state, "cursor_position"), kXyz, frame.cursor_position_m))
    return "cursor_position is missing, or is not three numbers";
  if (std::ranges::any_of(frame.cursor_position_m, [](double part) { return std::abs(part) > kReachM; }))
    return "cursor_position is beyond the arm's reach: its unit is not the metre, or the service scales the workspace";
  if (!read_numbers(member(state, "current_cursor_force"), kXyz, frame.cursor_force_n))
    return "current_cursor_force is missing, or is not three numbers";
  if (const json* const status = member(&arm, "status")) {
    frame.calibrated = !is_false(member(status, "calibrated"));
    frame.ready = frame.calibrated && !is_false(member(status, "power_supply")) && !is_false(member(status, "ready"));
  }
  if (std::string basis = text_of(member(member(member(&arm, "config"), "basis"), "permutation")); !basis.empty())
    frame.basis = std::move(basis);
  return "";
}

void append_number(std::string& out, double value) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, 4);
  out.append(digits.data(), end.ptr);  // not printf: it would follow the locale
}

void append_force(std::string& out, HaplyKey key, const HaplyVector& force_n) {
  out += R"("commands":{"set_cursor_force":{")";
  out += key == HaplyKey::values ? "values" : "vector";
  out += R"(":{"x":)";
  append_number(out, force_n[0]);
  out += R"(,"y":)";
  append_number(out, force_n[1]);
  out += R"(,"z":)";
  append_number(out, force_n[2]);
  out += "}}}}]}";
}

}  // namespace

HaplyParse parse_haply(std::string_view text, std::string_view device, HaplyFrame& frame) {
  const json message = json::parse(text, nullptr, false);
  if (message.is_discarded()) return {HaplyMessage::malformed, "it is not JSON"};
  if (!message.is_object()) return {HaplyMessage::malformed, "it is not a JSON object"};
  const json* const arms = list(message, "inverse3");
  if (arms == nullptr) return {HaplyMessage::no_device, ""};
  for (const json& arm : *arms) {
    const std::string id = text_of(member(&arm, "device_id"));
    if (!is_haply_id(id) || (!device.empty() && id != device)) continue;
    HaplyFrame next = frame;
    next.device_id = id;
    const char* const why = read_arm(arm, next);
    if (*why != '\0') return {HaplyMessage::malformed, why};
    read_grips(message, next);
    frame = std::move(next);
    return {HaplyMessage::state, ""};
  }
  return {HaplyMessage::no_device, ""};
}

std::string haply_devices(std::string_view text) {
  const json message = json::parse(text, nullptr, false);
  std::string ids;
  if (const json* const arms = list(message, "inverse3"))
    for (const json& arm : *arms)
      if (const std::string id = text_of(member(&arm, "device_id")); is_haply_id(id))
        ids += (ids.empty() ? "" : ", ") + id;
  return ids.empty() ? "none" : ids;
}

std::optional<std::pair<int, int>> parse_haply_version(std::string_view text) {
  const json answer = json::parse(text, nullptr, false);
  // The service may wrap an answer as {"ok": true, "data": ...}.
  std::string version = text_of(member(&answer, "project_version"));
  if (version.empty()) version = text_of(member(member(&answer, "data"), "project_version"));
  const char* const end = version.data() + version.size();
  std::pair<int, int> parts;
  const auto major = std::from_chars(version.data(), end, parts.first);
  if (major.ec != std::errc{} || major.ptr == end || *major.ptr != '.') return {};
  const auto minor = std::from_chars(major.ptr + 1, end, parts.second);
  if (minor.ec != std::errc{} || parts.first < 0 || parts.second < 0) return {};
  return parts;
}

bool is_haply_id(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  return !text.empty() && text.size() <= kLongest && std::ranges::all_of(text, [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_';
  });
}

void write_haply_force(std::string& out, std::string_view device, HaplyKey key, const HaplyVector& force_n) {
  out = R"({"inverse3":[{"device_id":")";
  out += device;
  out += R"(",)";
  append_force(out, key, force_n);
}

void write_haply_greeting(std::string& out, std::string_view device) {
  out = R"({"session":{"configure":{"profile":{"name":"mechane"}}},"inverse3":[{"device_id":")";
  out += device;
  out += R"(","configure":{"preset":"arm_front_centered"},)";
  append_force(out, HaplyKey::vector, {});
}

}  // namespace mechane::drivers
