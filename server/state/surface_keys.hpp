// What an author may write of a surface, on a body and for some steps alone, and what of it cannot be.
#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/assert.hpp"
#include "server/hand/surface.hpp"
#include "server/state/component_type.hpp"

namespace mechane::state {

/// The keys of `mechane:haptic` that make a surface, with their units, limits and defaults.
inline constexpr ParameterType kSurfaceKeys[] = {
    {.name = "stiffness", .unit = "N/m", .summary = "how hard it feels", .default_value = 600, .min = 0, .max = 20000},
    {.name = "damping", .unit = "N s/m", .summary = "how dull", .default_value = 1.5, .min = 0, .max = 100},
    {.name = "staticFriction", .summary = "before it slips", .default_value = 0.5, .min = 0, .max = 4},
    {.name = "dynamicFriction",
     .summary = "while it slips; at most staticFriction",
     .default_value = 0.3,
     .min = 0,
     .max = 4},
    {.name = "viscosity",
     .unit = "N s/m",
     .summary = "how syrupy it is to slide over: grease, wet clay",
     .min = 0,
     .max = hand::kMaxViscosity_ns_per_m},
    {.name = "knock",
     .unit = "N s/m",
     .summary = "the shake at the first touch, per speed of approach: stone and metal knock, cloth does not",
     .min = 0,
     .max = 50},
    {.name = "grooveDepth",
     .unit = "m",
     .summary = "from ridge to bottom of even grooves in the surface: a grain, staves; 0: smooth; at most 0.00008 at a "
                "distance of 0.004, 0.0005 at 0.01",
     .min = 0,
     .max = 0.01},
    {.name = "grooveDistance",
     .unit = "m",
     .summary = "from one groove to the next",
     .default_value = 0.004,
     .min = 0.0005,
     .max = 1},
    direction("grooveDirection", "across the grooves, in the body's frame; any length"),
};

/// The key of that name, which must be one of them.
[[nodiscard]] constexpr const ParameterType& surface_key(std::string_view name) {
  const ParameterType* const key = std::ranges::find(kSurfaceKeys, name, &ParameterType::name);
  MECHANE_ASSERT(key != std::end(kSurfaceKeys));
  return *key;
}

/// What is wrong between the keys of a surface.
struct SurfaceFault {
  ErrorCode code;
  std::string_view key;  ///< where to look for it; another key may be the one that was written
  std::string what;
  std::string remedy;
};

/// The numbers of a key as the author wrote them; none where it is not written.
using WrittenKeys = std::function<std::vector<double>(std::string_view key)>;

/// `own` with the keys that are written. Adds a fault where friction is less at rest than in motion, where grooves have no direction or are
/// too steep for a device. Each number must be within its own limits already. Not in the tick.
[[nodiscard]] HapticMaterial changed_surface(const HapticMaterial& own, const WrittenKeys& written,
                                             std::vector<SurfaceFault>& faults);

}  // namespace mechane::state
