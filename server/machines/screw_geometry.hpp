// How much water an Archimedes' screw holds between its blades.
#pragma once

namespace mechane::machines {

/// Shape and slope of a screw. Blades are helicoids of equal pitch around a round core, inside a tight casing.
struct ScrewShape {
  double outer_radius_m = 0;
  double core_radius_m = 0;
  double pitch_m = 0;  ///< of one blade: advance a turn
  int blades = 1;
  double slope_rad = 0;  ///< of the axis against the horizontal
};

/// Whether a bucket can hold water at all: on its way down, the chute must rise again where it passes over the core. Rorres 2000:
/// lambda <= rho, that is, pitch * tan(slope) < 2 pi * core radius.
[[nodiscard]] bool holds_water(const ScrewShape& shape);

/// Rorres' volume ratio nu: water that a turn lifts, over the screw's volume per pitch, pi Ro^2 pitch.
///
/// Rorres, 'The turn of the screw: optimal design of an Archimedes screw', J. Hydraulic Eng. 126 (2000) 72. A bucket is the water that
/// lies between two neighbouring blades when its level touches the lowest way out: over the core, down the chute, at the angle phi1
/// with sin(phi1) = pitch tan(slope) / (2 pi core radius). One integral over the cross-section, with the height along the axis in
/// closed form; midpoint rule, good to 1e-4 of the value. Rorres treats the corners of the water's level case by case; here the
/// integral is clipped. Needs holds_water(). Not for the tick: it takes some milliseconds.
[[nodiscard]] double volume_ratio(const ScrewShape& shape);

/// What one turn lifts, m^3.
[[nodiscard]] double volume_per_turn_m3(const ScrewShape& shape);

/// Muysken's limit, rad/s: a faster screw throws water over its core. 50 / D^(2/3) turns a minute, D in metres.
[[nodiscard]] double muysken_limit_rad_s(double outer_diameter_m);

}  // namespace mechane::machines
