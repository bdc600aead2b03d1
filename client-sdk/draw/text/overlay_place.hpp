// Where a panel stands so that it lies over nothing. Used by the files overlay_*.cpp only.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "client-sdk/draw/text/overlay_page.hpp"

namespace mechane::draw {

[[nodiscard]] bool overlap(const Box& a, const Box& b);

/// What is on the page around a panel.
struct Surroundings {
  Box bounds;              ///< where panels may stand
  std::vector<Box> fixed;  ///< other panels
  float gap = 0;           ///< to other panels
  std::vector<Box> seen;   ///< must stay visible; the most important first
  float away = 0;          ///< to these, so that a panel does not give way to each small motion

  [[nodiscard]] bool is_seen_beside(const Box& panel) const;
};

/// A place, and what it costs: the way from the usual one, and what it covers of the middle, where machines stand. In heights of the page.
struct FreePlace {
  Box box;
  float cost = 0;
};

/// The cheapest place of a panel as large as `usual`, that covers nothing. Empty: no place is free.
[[nodiscard]] std::optional<FreePlace> free_place(const Surroundings& around, const Box& usual);

/// The same for a panel for which there is no free place: it covers the least important, and of that as little as possible. None: the
/// fixed panels leave no place.
[[nodiscard]] std::optional<Box> least_covering_place(const Surroundings& around, const Box& usual);

}  // namespace mechane::draw
