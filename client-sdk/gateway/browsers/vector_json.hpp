// Places and directions in the gateway's JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "server/base/math.hpp"

namespace mechane::gateway {

/// [x, y, z]
[[nodiscard]] inline nlohmann::json vector_json(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace mechane::gateway
