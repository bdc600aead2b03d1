// The numbers of a fitted object, as the table and the report show them. Only summary.cpp reads the builder's fields.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "client-sdk/fit/fitted_object.hpp"
#include "client-sdk/fit/surface.hpp"

namespace mechane::fit {

struct PartSummary {
  std::string name;
  std::size_t triangles = 0;
  Vec3 axes_mm = Vec3::Zero();  ///< semi-axes of the superquadric
  double e1 = 1;
  double e2 = 1;
  double taper_x = 0;
  double taper_y = 0;
  double bend_deg = 0;  ///< from one end of the part to the other
  double fit_mean_pct = 0;
  double fit_rms_pct = 0;
  double fit_max_pct = 0;
  std::string map_kind;
  std::size_t map_bytes = 0;
  double depth_error_p50_mm = 0;
  double depth_error_p99_mm = 0;
  std::size_t samples = 0;
  double spacing_mm = 0;
};

struct Summary {
  std::vector<PartSummary> parts;
  std::size_t triangles = 0;
  std::size_t samples = 0;
  std::size_t map_bytes = 0;
  std::size_t file_bytes = 0;
  double build_s = 0;
  double diagonal_mm = 0;
  std::size_t worst_part = 0;  ///< into parts: the greatest depth_error_p99_mm
  double felt_p50_mm = 0;  ///< distance from the surface at which a finger meets it (SurfaceError), over the whole area
  double felt_p99_mm = 0;  ///< places that are not felt count with the full reach
  double not_felt_share = 0;       ///< of those places
  double widest_gap_mm = 0;        ///< between samples of a part that has too few of them; 0: no part has too few
  bool misses_budget = false;      ///< some part exceeds the allowed error
  std::vector<std::string> notes;  ///< notes for the author: what, where, remedy
};

[[nodiscard]] Summary summarise(const FittedObject& fitted, const Surface& surface);

/// What the numbers mean for an author: one sentence, and a second with a remedy if the worst part will feel wrong.
[[nodiscard]] std::string verdict(const Summary& summary);

/// The settings of the build as (what, value with unit).
[[nodiscard]] std::vector<std::pair<std::string, std::string>> settings_of(const FittedObject& fitted);

/// "512 B", "12.1 KB", "3.4 MB": thousands, as disks count.
[[nodiscard]] std::string bytes_text(std::size_t bytes);

/// Millimetres with two significant digits: "0.034", "1.2", "120".
[[nodiscard]] std::string mm_text(double mm);

}  // namespace mechane::fit
