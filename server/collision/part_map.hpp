// The distance representation of one part: the builder takes the smallest that is exact enough.
#pragma once

#include <cstddef>
#include <string>
#include <variant>

#include "server/collision/distance_brick.hpp"
#include "server/collision/distance_field.hpp"
#include "server/collision/radial_map.hpp"

namespace mechane::collision {

/// Nothing (which no point ever hits), a RadialMap, a DistanceBrick or a DistanceField. Immutable; any thread.
class PartMap {
 public:
  PartMap() = default;
  // Not explicit: a part's map is one of these.
  PartMap(RadialMap map) : map_(std::move(map)) {}      // NOLINT(google-explicit-constructor)
  PartMap(DistanceBrick map) : map_(std::move(map)) {}  // NOLINT(google-explicit-constructor)
  PartMap(DistanceField map) : map_(std::move(map)) {}  // NOLINT(google-explicit-constructor)

  /// Null where it is another.
  [[nodiscard]] const RadialMap* radial() const noexcept { return std::get_if<RadialMap>(&map_); }
  [[nodiscard]] const DistanceBrick* brick() const noexcept { return std::get_if<DistanceBrick>(&map_); }
  [[nodiscard]] const DistanceField* field() const noexcept { return std::get_if<DistanceField>(&map_); }
  [[nodiscard]] bool empty() const noexcept { return map_.index() == 0; }

  /// One point; see RadialMap::evaluate.
  [[nodiscard]] MapHit evaluate(const Vec3f& p_QP) const noexcept;
  /// The box that it covers, in Q; of an empty map, an empty one at the origin.
  [[nodiscard]] BoxView box() const noexcept;
  /// "radial 32", "brick 12x9x30", "field 9x9x12", "none".
  [[nodiscard]] std::string name() const;
  /// Of the stored values.
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  std::variant<std::monostate, RadialMap, DistanceBrick, DistanceField> map_;
};

}  // namespace mechane::collision
