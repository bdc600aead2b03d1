#include "server/machines/water_flow.hpp"

#include <algorithm>
#include <cmath>

#include "server/machines/nature.hpp"

namespace mechane::machines {
namespace {

constexpr double kNothing_m = 1e-9;  // water of less depth does not flow
constexpr int kHalvings = 24;

double surface_m(const Waters& waters, std::size_t id) noexcept {
  return waters.vessels[id].floor_m + waters.water_m3[id] / waters.vessels[id].area_m2;
}

/// The head at a pipe's end: of the water over it, or of the mouth itself where that is higher; and what the air presses with.
double head_m(const Waters& waters, std::size_t id, double mouth_m) noexcept {
  if (id == kOpenAir) return mouth_m;
  return std::max(surface_m(waters, id), mouth_m) + gauge_pa(waters, id) / kWaterWeight_n_m3;
}

double difference_m(const Pipe& pipe, const Waters& waters) noexcept {
  return head_m(waters, pipe.from, pipe.from_m) - head_m(waters, pipe.to, pipe.to_m);
}

/// The water that stands over a mouth, which can leave by it.
double above_m3(const Waters& waters, std::size_t id, double mouth_m) noexcept {
  if (id == kOpenAir) return 0;
  const Vessel& vessel = waters.vessels[id];
  return std::clamp(waters.water_m3[id] - vessel.area_m2 * (mouth_m - vessel.floor_m), 0.0, waters.water_m3[id]);
}

/// A siphon fills once water is driven over its crest, and empties when its mouth draws air.
bool is_primed(const Pipe& pipe, const Waters& waters, double& primed) noexcept {
  if (!pipe.siphon) return true;
  const double depth_m = above_m3(waters, pipe.from, pipe.from_m) / waters.vessels[pipe.from].area_m2;
  if (depth_m <= kNothing_m)
    primed = 0;
  else if (head_m(waters, pipe.from, pipe.from_m) >= pipe.crest_m)
    primed = 1;
  return primed != 0;
}

/// The two volumes that a pipe changes. Each move begins anew, so that nothing is lost by rounding on the way to the right one.
class Exchange {
 public:
  Exchange(const Pipe& pipe, const Waters& waters)
      : pipe_(pipe), waters_(waters), from_m3_(of(pipe.from)), to_m3_(of(pipe.to)) {}

  void move(double moved_m3) const noexcept {
    if (pipe_.from != kOpenAir) waters_.water_m3[pipe_.from] = from_m3_ - moved_m3;
    if (pipe_.to != kOpenAir) waters_.water_m3[pipe_.to] = to_m3_ + moved_m3;
  }
  [[nodiscard]] double difference_after(double moved_m3) const noexcept {
    move(moved_m3);
    return difference_m(pipe_, waters_);
  }

 private:
  [[nodiscard]] double of(std::size_t id) const { return id == kOpenAir ? 0 : waters_.water_m3[id]; }

  const Pipe& pipe_;
  const Waters& waters_;
  double from_m3_, to_m3_;
};

/// Most of `wanted_m3` that does not turn the difference of the heads round. Air gets stiffer as it is pressed: halving needs no slope.
double without_overshoot(const Exchange& exchange, double side, double wanted_m3) noexcept {
  if (side * exchange.difference_after(side * wanted_m3) >= 0) return wanted_m3;
  double low_m3 = 0, high_m3 = wanted_m3;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle_m3 = (low_m3 + high_m3) / 2;
    (side * exchange.difference_after(side * middle_m3) >= 0 ? low_m3 : high_m3) = middle_m3;
  }
  return low_m3;
}

}  // namespace

double air_volume_m3(const Waters& waters, std::size_t air) noexcept {
  double sum_m3 = 0;
  for (std::size_t i = 0; i < waters.vessels.size(); ++i) {
    const double capacity_m3 = waters.vessels[i].capacity_m3();
    if (waters.vessels[i].air == air) sum_m3 += std::max(capacity_m3 - waters.water_m3[i], kLeastAir * capacity_m3);
  }
  return sum_m3;
}

double gauge_pa(const Waters& waters, std::size_t vessel) noexcept {
  const std::size_t air = waters.vessels[vessel].air;
  return air == kOpenAir ? 0 : waters.air_pa_m3[air] / air_volume_m3(waters, air) - kAtmosphere_pa;
}

double room_m3(const Waters& waters, std::size_t vessel) noexcept {
  const Vessel& its = waters.vessels[vessel];
  if (its.air == kOpenAir) return std::numeric_limits<double>::infinity();
  return std::max(0.0, (1 - kLeastAir) * its.capacity_m3() - waters.water_m3[vessel]);
}

double flow(const Pipe& pipe, const Waters& waters, double open, double& primed, double dt_s) noexcept {
  if (!is_primed(pipe, waters, primed)) return 0;
  const double head_m = difference_m(pipe, waters);
  if (!(std::abs(head_m) > kNothing_m) || (head_m < 0 && pipe.one_way)) return 0;
  const bool forth = head_m > 0;
  const std::size_t giver = forth ? pipe.from : pipe.to, taker = forth ? pipe.to : pipe.from;
  const double wanted_m3 =
      pipe.effective_m2 * std::clamp(open, 0.0, 1.0) * std::sqrt(2 * kGravity_m_s2 * std::abs(head_m)) * dt_s;
  const double most_m3 = std::min({wanted_m3, above_m3(waters, giver, forth ? pipe.from_m : pipe.to_m),
                                   taker == kOpenAir ? wanted_m3 : room_m3(waters, taker)});
  if (!(most_m3 > 0)) return 0;
  const double side = forth ? 1 : -1;
  const Exchange exchange(pipe, waters);
  const double moved_m3 = side * without_overshoot(exchange, side, most_m3);
  exchange.move(moved_m3);
  return moved_m3;
}

}  // namespace mechane::machines
