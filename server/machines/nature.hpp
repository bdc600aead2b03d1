// Numbers of nature, and ancient units, that several machines use.
#pragma once

namespace mechane::machines {

inline constexpr double kGravity_m_s2 = 9.81;
inline constexpr double kWaterDensity_kg_m3 = 1000;
inline constexpr double kWaterWeight_n_m3 = kWaterDensity_kg_m3 * kGravity_m_s2;
inline constexpr double kAirDensity_kg_m3 = 1.2;         ///< at 20 degrees C, near sea level
inline constexpr double kWaterHeat_j_per_kg_k = 4186;    ///< to warm water
inline constexpr double kEvaporation_j_per_kg = 2.26e6;  ///< to boil water away at 100 degrees C
inline constexpr double kSteamDensity_kg_m3 = 0.598;     ///< at 100 degrees C and one atmosphere
inline constexpr double kDactyl_m = 0.0185;              ///< a sixteenth of a foot of 0.296 m
inline constexpr double kMina_kg = 0.437;                ///< Attic

}  // namespace mechane::machines
