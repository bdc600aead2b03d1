// One cylinder of a force pump: a piston, a valve in its bottom towards the well, a valve in its pipe towards the vessel.
#pragma once

namespace mechane::machines {

/// A flap that should let water up, but not down.
enum class Valve { good, reversed, missing };

struct PumpCylinder {
  double area_m2 = 0;
  double efficiency =
      0.8;  ///< share of the displaced water that gets through; the rest leaks past the piston's leather
  Valve inlet = Valve::good;
  Valve outlet = Valve::good;
};

/// What one move of a piston does: volumes in m^3, all >= 0.
struct PumpFlow {
  double to_vessel = 0;
  double from_vessel = 0;
  double leaked = 0;   ///< past the piston
  double force_n = 0;  ///< of the water against the piston's motion, >= 0
};

/// What stands above the outlet valve.
struct PumpHead {
  double pressure_pa = 0;  ///< of the column over the outlet valve
  double water_m3 = 0;     ///< what could run back through a faulty outlet valve
};

/// Moves a piston from `from_m` to `to_m` over its bottom and keeps account of the water under it.
///
/// Rising, the piston draws: from the vessel if the outlet lets water down (the pressure is higher there), else from the well if the
/// inlet lets it up, else air past its leather. Falling, it presses out the water that no longer fits under it: back to the well if the
/// inlet lets it down, else into the vessel if the outlet lets it up, against rho g h A. If neither does, the piston is locked and the
/// water squeezes past it at 3 bar. `tight` (0..1) is how well the leather holds: a creeping piston lifts nothing and feels nothing.
PumpFlow move_piston(const PumpCylinder& cylinder, double from_m, double to_m, double tight, const PumpHead& head,
                     double& water_m3) noexcept;

}  // namespace mechane::machines
