// The fit's inner part: Levenberg-Marquardt on the first-order distance of points to the surface, with a loss that outliers cannot pull.
#pragma once

#include <span>
#include <vector>

#include "server/base/math.hpp"
#include "server/geometry/fitting/fit_state.hpp"

namespace mechane::geometry {

/// What a distance d costs. `square`: d^2. `huber`: d^2 up to the scale, beyond it a straight line. `tukey`: bounded at about 3
/// scales; points farther away do not count.
/// `equation3`: the paper's own, [sqrt(a1 a2 a3) (F^e1 - 1)]^2, which holds a thin part's broad faces faster than its ends.
enum class Loss { square, huber, tukey, equation3 };

struct ImproveConfig {
  int max_iterations = 10;
  bool deformed = true;  ///< all 15 parameters, else the first 11
  Loss loss = Loss::square;
  double scale = 1;  ///< of the loss, as a distance
};

struct FitErrors {
  double mean = 0;
  double rms = 0;
  double max = 0;
};

/// The loss at one state, and its quadratic model there.
struct LossModel {
  using Matrix = Eigen::Matrix<double, FitState::kAll, FitState::kAll>;
  double cost = 0;  ///< infinite where the state makes no valid shape
  Matrix H = Matrix::Zero();
  FitState::Step g = FitState::Step::Zero();
};

/// Each point counts as often as `weights` says; once if there are no weights.
[[nodiscard]] LossModel loss_model(const FitState& state, std::span<const Vec3> points, const ImproveConfig& config,
                                   std::span<const double> weights = {});

/// The step to the model's minimum, shortened by `damping` (Marquardt) and within what keeps the state's ranges.
[[nodiscard]] FitState::Step damped_step(const FitState& state, const LossModel& model, bool deformed, double damping);

/// Lowers the loss; returns the iterations it took. A state that cannot be improved stays as it is.
int improve(FitState& state, std::span<const Vec3> points, const ImproveConfig& config);

/// Signed distances of points to the surface, positive outside: the lesser of the way along the ray from the centre and the first-order
/// distance (f - 1) / |grad f|.
[[nodiscard]] std::vector<double> distances(const FitState& state, std::span<const Vec3> points);

[[nodiscard]] FitErrors fit_errors(std::span<const double> distances);

}  // namespace mechane::geometry
