// How good pictures are, and what they cost.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace mechane::draw {

/// The best first.
enum class Quality : std::uint8_t {
  high,
  medium,  ///< two samples a pixel, no ambient occlusion, and water mirrors the sky alone
  low,     ///< one sample a pixel with smoothed edges, cheaper light and shadows
  cached,  ///< as low, but what stands still is drawn once; half the size while the view moves
};

/// The names on the command line, in this order.
[[nodiscard]] const std::vector<std::pair<std::string_view, Quality>>& quality_names();
[[nodiscard]] std::string_view quality_name(Quality quality);
/// None: no such quality, or "auto".
[[nodiscard]] std::optional<Quality> quality_of(std::string_view name);

}  // namespace mechane::draw
