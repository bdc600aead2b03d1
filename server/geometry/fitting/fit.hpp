// Fits one superquadric to one part by Levenberg-Marquardt (paper, equation 3, with the square that is missing in print).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "server/base/error.hpp"
#include "server/base/math.hpp"
#include "server/geometry/mesh.hpp"
#include "server/geometry/superquadric.hpp"

namespace mechane::geometry {

struct FitConfig {
  std::size_t samples = 400;      ///< surface samples that the fit sees
  bool deformations = true;       ///< try taper and bend where a mean error over 0.2 % is left
  double deformation_gain = 0.2;  ///< they stay only when they lower the mean error by this share
  bool robust = false;  ///< points far from where the others lie do not count: for scans with noise and outliers
  bool bound = true;    ///< let the axes grow or shrink until F <= 1 at every point; of no use with outliers
  std::uint64_t seed = 1;
};

/// Errors are distances from the samples to the fitted surface, before the axes grow to bound the part, in % of the diagonal of the
/// part's bounding box.
struct FitReport {
  double mean_pct = 0;
  double rms_pct = 0;
  double max_pct = 0;
  double hausdorff_pct =
      0;  ///< the larger of max_pct and of how far the fitted surface strays from the samples; sampled
  double bound_scale =
      1;               ///< by how much the axes grew or shrank afterwards, so that F <= 1 at every vertex and sample
  int iterations = 0;  ///< of Levenberg-Marquardt, over all starts
  std::string start;   ///< the start that won: frame, permutation, exponents
  bool deformed = false;
};

struct FitResult {
  Superquadric shape;
  Pose X_OQ;
  FitReport report;
};

/// Fits a mesh: samples it by area; the result bounds every vertex and sample (F <= 1). The frame is the mesh's. Errors: too few
/// points, points that are not finite, points on a plane or a line.
[[nodiscard]] Expected<FitResult> fit_superquadric(const Mesh& mesh, const FitConfig& config = {});

/// The same for points that already lie on a surface, spread about evenly.
[[nodiscard]] Expected<FitResult> fit_superquadric(std::span<const Vec3> points_O, const FitConfig& config = {});

}  // namespace mechane::geometry
