// What a query of a DistanceField may remember between ticks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/collision/kernels.hpp"

namespace mechane::collision {

/// Which groups of four of a set's points are near enough to a placed object to be tested. It holds until a point may have moved by more
/// than the margin, or the object stands elsewhere; PlacedObject::query sees to both. No answer depends on it. The caller's: one for
/// each pair of a set and an object, for one thread at a time. The set must stay the same but for the poses of its groups.
class NearList {
 public:
  /// Some ticks of a hand's motion: a larger margin costs more tests than it saves.
  static constexpr float kMargin_m = 0.001F;

  /// Room for a set of so many points, so that a query allocates nothing.
  NearList(std::size_t points, std::size_t groups, float margin_m = kMargin_m)
      : margin_m_(margin_m), places_((groups + kLanes - 1) / kLanes), quads_(points / 4 + kLanes) {}

  /// How often it was made anew.
  [[nodiscard]] std::size_t times_made() const noexcept { return times_made_; }

 private:
  friend class PlacedObject;

  float margin_m_;
  std::size_t times_made_ = 0;
  BlockTransform X_BS_{};            // of the object, when the list was made
  std::vector<GroupPlaces> places_;  // of the groups, then
  std::vector<std::uint32_t> quads_;
  std::size_t count_ = 0;
};

}  // namespace mechane::collision
