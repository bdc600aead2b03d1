// Water in vessels and in the pipes between them, apart from how it is written. SI units; heights are the world's. Nothing here allocates.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace mechane::machines {

inline constexpr double kAtmosphere_pa = 101325;
inline constexpr double kLeastAir =
    1e-3;  ///< share of a closed vessel that water never fills, so that pressures stay finite
inline constexpr std::size_t kOpenAir =
    std::numeric_limits<std::size_t>::max();  ///< in place of a vessel, or of shut-in air

/// An upright vessel of one cross section.
struct Vessel {
  double area_m2 = 1;
  double floor_m = 0;
  double height_m = 1;         ///< of the walls
  std::size_t air = kOpenAir;  ///< which of the network's shut-in airs is over its water

  [[nodiscard]] double capacity_m3() const { return area_m2 * height_m; }
};

/// A pipe, a hole, a spout or a siphon.
struct Pipe {
  std::size_t from = kOpenAir;
  std::size_t to = kOpenAir;
  double from_m = 0;  ///< height of its mouth in `from`
  double to_m = 0;
  double effective_m2 = 0;  ///< discharge coefficient times cross section
  double crest_m = 0;       ///< of a siphon: it flows once water has been driven over it, until its mouth is dry
  bool siphon = false;
  bool one_way = false;  ///< a flap keeps water from running back
};

/// A network's contents.
struct Waters {
  std::span<const Vessel> vessels;
  std::span<double> water_m3;   ///< of each vessel
  std::span<double> air_pa_m3;  ///< pressure times volume of each shut-in air: it keeps its temperature (Boyle)
};

/// Volume of one shut-in air, which several vessels may share.
[[nodiscard]] double air_volume_m3(const Waters& waters, std::size_t air) noexcept;
/// What a vessel's air has over the atmosphere; 0 of an open one.
[[nodiscard]] double gauge_pa(const Waters& waters, std::size_t vessel) noexcept;
/// How much more water a vessel holds: without limit where it is open, for it runs over.
[[nodiscard]] double room_m3(const Waters& waters, std::size_t vessel) noexcept;

/// Lets water through one pipe for `dt_s` by Torricelli, Q = c A sqrt(2 g dh), and returns what went from `from` to `to`, m^3 (negative:
/// back). `open` is the share of its cross section. `primed` is a siphon's memory, 0 or 1. What leaves one vessel enters the other: never
/// more than stands over the mouth, than finds room, or than makes the heads equal, so that no step is too long.
double flow(const Pipe& pipe, const Waters& waters, double open, double& primed, double dt_s) noexcept;

}  // namespace mechane::machines
