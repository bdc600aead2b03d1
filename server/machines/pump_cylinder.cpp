#include "server/machines/pump_cylinder.hpp"

#include <algorithm>

namespace mechane::machines {
namespace {

constexpr double kLocked_pa = 3e5;  // under a piston whose water has no way out

bool lets_up(Valve valve) {
  return valve != Valve::reversed;
}
bool lets_down(Valve valve) {
  return valve != Valve::good;
}

PumpFlow draw(const PumpCylinder& cylinder, double drawn_m3, const PumpHead& head, double& water_m3) noexcept {
  PumpFlow flow;
  if (lets_down(cylinder.outlet)) flow.from_vessel = std::min(drawn_m3, head.water_m3);
  const double wanted_m3 = drawn_m3 - flow.from_vessel;
  water_m3 += flow.from_vessel + (lets_up(cylinder.inlet) ? wanted_m3 : 0);
  return flow;
}

PumpFlow press(const PumpCylinder& cylinder, double excess_m3, double tight, double pressure_pa,
               double& water_m3) noexcept {
  PumpFlow flow;
  if (excess_m3 <= 0) return flow;
  water_m3 -= excess_m3;
  if (lets_down(cylinder.inlet)) return flow;
  if (lets_up(cylinder.outlet)) {
    flow.to_vessel = cylinder.efficiency * tight * excess_m3;
    flow.force_n = tight * pressure_pa * cylinder.area_m2;
  } else {
    flow.force_n = tight * kLocked_pa * cylinder.area_m2;
  }
  flow.leaked = excess_m3 - flow.to_vessel;
  return flow;
}

}  // namespace

PumpFlow move_piston(const PumpCylinder& cylinder, double from_m, double to_m, double tight, const PumpHead& head,
                     double& water_m3) noexcept {
  if (to_m > from_m) return draw(cylinder, cylinder.area_m2 * (to_m - from_m), head, water_m3);
  if (to_m == from_m) return {};
  return press(cylinder, water_m3 - cylinder.area_m2 * to_m, tight, head.pressure_pa, water_m3);
}

}  // namespace mechane::machines
