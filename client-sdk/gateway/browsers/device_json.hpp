// A haptic device, as the API tells of it.
#pragma once

#include <nlohmann/json.hpp>

#include <mechane/client/types.hpp>

namespace mechane::gateway {

/// {"user", "name", "state", "kind", "side"}: see STREAM.md.
[[nodiscard]] nlohmann::json device_json(const client::DeviceReport& device);

}  // namespace mechane::gateway
