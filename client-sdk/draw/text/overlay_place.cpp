#include "client-sdk/draw/text/overlay_place.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mechane::draw {
namespace {

/// The middle of the bounds, as shares of them: most machines stand there.
constexpr float kMiddleFrom = 0.2F, kMiddleHigh = 0.5F;
constexpr float kMiddleCosts = 2;  ///< to lie in it

Box enlarged(const Box& box, float by) {
  return {box.x - by, box.y - by, box.width + 2 * by, box.height + 2 * by};
}

float shared_area(const Box& a, const Box& b) {
  if (!overlap(a, b)) return 0;
  return (std::min(a.right(), b.right()) - std::max(a.x, b.x)) * (std::min(a.below(), b.below()) - std::max(a.y, b.y));
}

/// The places of a panel of one size that touch the bounds, or what it must not lie over: where there is a free place, one of these is free,
/// because a panel in it can be pushed to the left and up until it touches.
class Places {
 public:
  Places(const Surroundings& around, const Box& usual) : bounds_(around.bounds), usual_(usual) {
    add_edge(usual.x, usual.y);
    add_edge(bounds_.x, bounds_.y);
    add_edge(bounds_.right() - usual.width, bounds_.below() - usual.height);
    for (const Box& box : around.fixed)
      if (!box.empty()) add(enlarged(box, around.gap));
  }

  /// Everything that is added from now on may be covered, if the caller wants it.
  void add(const Box& obstacle) {
    obstacles_.push_back(obstacle);
    add_edge(std::ceil(obstacle.right()), std::ceil(obstacle.below()));
    add_edge(std::floor(obstacle.x - usual_.width), std::floor(obstacle.y - usual_.height));
  }

  /// The cheapest place over none of the first `count` obstacles; `cost` of a box.
  template <class Cost>
  [[nodiscard]] std::optional<Box> best(std::size_t count, const Cost& cost) const {
    std::optional<Box> found;
    float least = std::numeric_limits<float>::max();
    for (const float y : ys_) {
      for (const float x : xs_) {
        const Box box{x, y, usual_.width, usual_.height};
        if (!is_within(box)) continue;
        const float costs = cost(box);
        if (costs >= least) continue;
        const auto first = obstacles_.begin();
        if (std::any_of(first, first + static_cast<std::ptrdiff_t>(count),
                        [&](const Box& other) { return overlap(box, other); }))
          continue;
        least = costs;
        found = box;
      }
    }
    return found;
  }
  [[nodiscard]] float cost(const Box& box) const {
    const Box middle{bounds_.x + kMiddleFrom * bounds_.width, bounds_.y + kMiddleFrom * bounds_.height,
                     (1 - 2 * kMiddleFrom) * bounds_.width, kMiddleHigh * bounds_.height};
    const float way = std::hypot(box.x - usual_.x, box.y - usual_.y) / bounds_.height;
    return way + kMiddleCosts * shared_area(box, middle) / (box.width * box.height);
  }
  [[nodiscard]] std::size_t size() const { return obstacles_.size(); }
  /// How much a box covers of the obstacles from the one of that index on.
  [[nodiscard]] float covered(const Box& box, std::size_t from) const {
    float area = 0;
    for (std::size_t i = from; i < obstacles_.size(); ++i)
      area += shared_area(box, obstacles_[i]);
    return area;
  }

 private:
  void add_edge(float x, float y) {
    xs_.push_back(x);
    ys_.push_back(y);
  }
  [[nodiscard]] bool is_within(const Box& box) const {
    constexpr float kRounding = 0.01F;
    return box.x >= bounds_.x - kRounding && box.y >= bounds_.y - kRounding &&
           box.right() <= bounds_.right() + kRounding && box.below() <= bounds_.below() + kRounding;
  }

  Box bounds_;
  Box usual_;
  std::vector<Box> obstacles_;
  std::vector<float> xs_, ys_;
};

}  // namespace

bool overlap(const Box& a, const Box& b) {
  return !a.empty() && !b.empty() && a.shares_columns(b) && a.y < b.below() && b.y < a.below();
}

bool Surroundings::is_seen_beside(const Box& panel) const {
  return std::ranges::none_of(seen, [&](const Box& box) { return overlap(panel, box); });
}

std::optional<FreePlace> free_place(const Surroundings& around, const Box& usual) {
  const Places still(around, usual);
  // First the places that do not depend on what moves: a panel in one of these rests.
  Places all = still;
  for (const Box& box : around.seen)
    all.add(enlarged(box, around.away));
  auto found = still.best(still.size(), [&](const Box& box) {
    return all.covered(box, still.size()) > 0 ? std::numeric_limits<float>::max() : all.cost(box);
  });
  if (!found) found = all.best(all.size(), [&](const Box& box) { return all.cost(box); });
  return found ? std::optional(FreePlace{*found, all.cost(*found)}) : std::nullopt;
}

std::optional<Box> least_covering_place(const Surroundings& around, const Box& usual) {
  Places places(around, usual);
  const std::size_t fixed = places.size();
  for (const Box& box : around.seen)
    places.add(box);
  for (std::size_t kept = places.size();; --kept) {
    // Area counts most.
    const auto cost = [&](const Box& box) { return places.covered(box, kept) + 0.001F * places.cost(box); };
    const auto found = places.best(kept, cost);
    if (found || kept == fixed) return found;
  }
}

}  // namespace mechane::draw
