#include "client-sdk/gateway/browsers/asked_devices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client-sdk/gateway/browsers/device_json.hpp"

namespace mechane::gateway {
namespace {

using OrderJson = nlohmann::json;

/// A device's program may have to let its force go first.
constexpr Duration kDeviceAnswersWithin = std::chrono::seconds(5);

std::optional<client::DevicePlace> place_in(const OrderJson& json) {
  const auto number = [&json](const char* name) {
    const auto found = json.find(name);
    return found != json.end() && found->is_number() ? found->get<double>() : std::nan("");
  };
  client::DevicePlace place{Vec3::Zero(), number("turn_rad"), number("scale")};
  const auto center = json.find("center_m");
  if (center == json.end() || !center->is_array() || center->size() != 3) return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(*center)[i].is_number()) return std::nullopt;
    place.p_WD[static_cast<Eigen::Index>(i)] = (*center)[i].get<double>();
  }
  return place;
}

}  // namespace

Expected<client::DeviceRequest> parse_device_order(const std::string& body) {
  constexpr std::array<std::string_view, 4> kDeviceActions{"place", "calibrate", "test", "end-test"};
  static_assert(kDeviceActions.size() == static_cast<std::size_t>(client::DeviceAction::end_test) + 1);
  const auto wrong = [] {
    return fail(
        ErrorCode::invalid_value, "unknown action, or a value out of range", {},
        R"(send {"user": 0 to 3, "action": "test", "end-test" or "calibrate"}, or "place" with {"center_m": [X, Y, Z], )"
        R"("turn_rad": A, "scale": S})");
  };
  const OrderJson json = OrderJson::parse(body, nullptr, false);
  if (!json.is_object()) return wrong();
  const auto user = json.find("user"), action = json.find("action"), place = json.find("place");
  if (user == json.end() || !user->is_number_unsigned() || action == json.end() || !action->is_string()) return wrong();
  const auto* const named = std::ranges::find(kDeviceActions, action->get<std::string>());
  if (named == kDeviceActions.end() || user->get<std::uint64_t>() >= hand::kMaxUsers) return wrong();
  client::DeviceRequest wanted;
  wanted.user = user->get<std::uint32_t>();
  wanted.action = static_cast<client::DeviceAction>(named - kDeviceActions.begin());
  const bool places = wanted.action == client::DeviceAction::place;
  if (places != (place != json.end())) return wrong();
  if (!places) return wanted;
  const auto read = place->is_object() ? place_in(*place) : std::nullopt;
  if (!read) return wrong();
  wanted.place = *read;
  if (const auto good = check(wanted); !good) return tl::unexpected(good.error());
  return wanted;
}

Expected<void> AskedDevices::ask(client::Client& client, const client::DeviceRequest& request, TimePoint now) {
  const std::vector<client::DeviceDetails> details = client.device_details();
  if (std::ranges::find(details, request.user, &client::DeviceDetails::user) == details.end())
    return fail(ErrorCode::conflict, fmt::format("this kiosk has no device {}", request.user + 1), "user",
                "start its program, and wait until it is listed");
  const auto asked = client.ask_device(request);
  if (!asked) return tl::unexpected(asked.error());
  if (*asked == 0) return fail(ErrorCode::io_failure, "the request could not be sent", {}, "try again in a moment");
  asked_[request.user] = {*asked, now};
  return {};
}

nlohmann::json AskedDevices::look(client::Client& client, std::span<const client::DeviceReport> reports,
                                  TimePoint now) const {
  OrderJson all = OrderJson::array();
  const std::vector<client::DeviceDetails> details = client.device_details();
  for (const client::DeviceReport& device : reports) {
    if (device.state == client::DeviceState::none) continue;
    OrderJson one = device_json(device);
    const auto told = std::ranges::find(details, device.user, &client::DeviceDetails::user);
    if (told != details.end()) one["details"] = details_json(*told);
    const auto asked = asked_.find(device.user);
    if (asked == asked_.end()) {
      one["request"] = "none";
    } else if (told != details.end() && told->answered == asked->second.id) {
      one["request"] = told->refusal.empty() ? "done" : "refused";
      if (!told->refusal.empty()) one["refusal"] = told->refusal;
    } else {
      one["request"] = now - asked->second.at > kDeviceAnswersWithin ? "silent" : "waiting";
    }
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace mechane::gateway
