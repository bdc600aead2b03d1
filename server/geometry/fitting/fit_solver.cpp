#include "server/geometry/fitting/fit_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mechane::geometry {
namespace {

constexpr double kLeastSlope = 1e-3;
constexpr double kLeastAxis = 2e-3;  // of the diagonal
constexpr double kMostAxis = 3;
constexpr double kMostTaper = 0.95;
constexpr double kSmallGain = 2e-4;   // of the cost: a last step
constexpr double kNegligible = 3e-5;  // of the diagonal, root mean square
constexpr double kHuber = 1.345;      // of the scale: 95 % of the least squares' precision when the noise is Gaussian
constexpr double kTukey = 4.685;

using Step = FitState::Step;

struct LossValue {
  double cost;
  double weight;  // d cost / d (d^2)
};

LossValue loss_of(double d, const ImproveConfig& config) {
  const double square = d * d;
  switch (config.loss) {
    case Loss::square:
    case Loss::equation3:
      break;
    case Loss::huber: {
      const double c = kHuber * config.scale;
      if (square > c * c) return {2 * c * std::abs(d) - c * c, c / std::abs(d)};
      break;
    }
    case Loss::tukey: {
      const double c2 = kTukey * kTukey * config.scale * config.scale;
      if (square >= c2) return {c2 / 3, 0};
      const double rest = 1 - square / c2;
      return {c2 / 3 * (1 - rest * rest * rest), rest * rest};
    }
  }
  return {square, 1};
}

/// Sums of row^T row, the lower half, four rows at a time, so that the sums do not go to memory and back for each row.
class Sums {
 public:
  /// Where the next row's numbers go: the derivatives, then the distance.
  double* next_row() {
    if (filled_ == kAtOnce) flush();
    return rows_[filled_++].data();
  }

  void finish(LossModel& model) {
    for (std::size_t k = filled_; k < kAtOnce; ++k)
      rows_[k].fill(0);
    flush();
    for (std::size_t i = 0; i + 1 < kWidth; ++i) {
      model.g[i] = sums_[kWidth - 1][i];
      for (std::size_t k = 0; k <= i; ++k)
        model.H(i, k) = model.H(k, i) = sums_[i][k];
    }
  }

 private:
  static constexpr std::size_t kWidth = FitState::kAll + 1;
  static constexpr std::size_t kAtOnce = 4;

  void flush() {
    const auto& [a, b, c, d] = rows_;
    for (std::size_t i = 0; i < kWidth; ++i)
      for (std::size_t k = 0; k < (i | 1) + 1; ++k)
        sums_[i][k] += (a[i] * a[k] + b[i] * b[k]) + (c[i] * c[k] + d[i] * d[k]);
    filled_ = 0;
  }

  std::array<std::array<double, kWidth>, kAtOnce> rows_{};
  std::array<std::array<double, kWidth>, kWidth> sums_{};
  std::size_t filled_ = 0;
};

/// How far each part of a step may go.
struct Bounds {
  Step low, high;
};

Bounds bounds_at(const FitState& s, bool deformed) {
  Bounds b;
  for (int i = 0; i < 3; ++i) {
    b.low[FitState::kAxes + i] = std::max(-1.0, std::log(kLeastAxis / s.a[i]));
    b.high[FitState::kAxes + i] = std::min(1.0, std::log(kMostAxis / s.a[i]));
    b.low[FitState::kTurn + i] = -0.7;
    b.high[FitState::kTurn + i] = 0.7;
    b.low[FitState::kShift + i] = -0.3;
    b.high[FitState::kShift + i] = 0.3;
  }
  for (int i = 0; i < 2; ++i) {
    b.low[FitState::kExponents + i] = std::max(-0.6, kMinExponent - s.e[i]);
    b.high[FitState::kExponents + i] = std::min(0.6, kMaxExponent - s.e[i]);
    b.low[FitState::kTaper + i] = deformed ? std::max(-0.5, -kMostTaper - s.taper[i]) : 0;
    b.high[FitState::kTaper + i] = deformed ? std::min(0.5, kMostTaper - s.taper[i]) : 0;
    b.low[FitState::kBend + i] = deformed ? -2 : 0;
    b.high[FitState::kBend + i] = deformed ? 2 : 0;
  }
  return b;
}

const LossModel kImpossible{std::numeric_limits<double>::infinity(), LossModel::Matrix::Zero(), Step::Zero()};

}  // namespace

LossModel loss_model(const FitState& state, std::span<const Vec3> points, const ImproveConfig& config,
                     std::span<const double> weights) {
  LossModel model;
  if (!is_valid(state.shape())) return kImpossible;
  model.cost = 0;
  Sums sums;
  const bool paper = config.loss == Loss::equation3;
  const double volume = std::sqrt(state.a.prod());
  const FitForm form(state);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const FitForm::Value v = form.at(points[i]);
    // Equation 3 is volume (f^2 - 1); the volume depends on the axes too.
    const double inverse = paper ? 2 * volume * v.f : 1 / std::max(kLeastSlope, v.slope_Q.norm());
    const double d = paper ? volume * (v.f * v.f - 1) : (v.f - 1) * inverse;
    const double by_volume = paper ? 0.5 * d : 0;
    LossValue loss = loss_of(d, config);
    if (!weights.empty()) loss = {loss.cost * weights[i], loss.weight * weights[i]};
    model.cost += loss.cost;
    if (loss.weight <= 0) continue;
    const double root = std::sqrt(loss.weight);
    double* row = sums.next_row();
    for (int k = 0; k < FitState::kAll; ++k)
      row[k] = root * (inverse * v.by_step[k] + (k < FitState::kAxes + 3 ? by_volume : 0));
    row[FitState::kAll] = d * root;
  }
  sums.finish(model);
  if (!std::isfinite(model.cost) || !model.H.allFinite() || !model.g.allFinite()) return kImpossible;
  return model;
}

/// The damped step. Parameters that would leave their bounds stay on them, and the step is solved again for the others.
FitState::Step damped_step(const FitState& state, const LossModel& model, bool deformed, double damping) {
  const Bounds bounds = bounds_at(state, deformed);
  LossModel::Matrix H = model.H;
  Step right = -model.g;
  for (int i = 0; i < FitState::kAll; ++i)
    H(i, i) += damping * model.H(i, i) + 1e-9;
  Step step = Step::Zero();
  std::array<bool, FitState::kAll> held{};
  const auto hold = [&](int i, double at) {
    right -= at * H.col(i);
    H.row(i).setZero();
    H.col(i).setZero();
    H(i, i) = 1;
    right[i] = at;
    held[i] = true;
  };
  for (int i = 0; i < FitState::kAll; ++i)
    if (bounds.low[i] >= bounds.high[i]) hold(i, 0);
  for (int round = 0; round < 3; ++round) {
    const Step trial = H.ldlt().solve(right);
    bool inside = true;
    for (int i = 0; i < FitState::kAll; ++i) {
      if (held[i] || (trial[i] >= bounds.low[i] && trial[i] <= bounds.high[i])) continue;
      hold(i, std::clamp(trial[i], bounds.low[i], bounds.high[i]));
      inside = false;
    }
    for (int i = 0; i < FitState::kAll; ++i)
      step[i] = std::clamp(trial[i], bounds.low[i], bounds.high[i]);
    if (inside) break;
  }
  return step;
}

int improve(FitState& state, std::span<const Vec3> points, const ImproveConfig& config) {
  LossModel model = loss_model(state, points, config);
  if (!std::isfinite(model.cost)) return 0;
  const double negligible = kNegligible * kNegligible * static_cast<double>(points.size());
  double damping = 1e-2;
  double growth = 2;
  int iterations = 0;
  while (iterations < config.max_iterations && model.cost > negligible) {
    ++iterations;
    const Step step = damped_step(state, model, config.deformed, damping);
    if (!step.allFinite() || step.norm() < 1e-7) break;
    const FitState next = state.moved(step);
    LossModel there = loss_model(next, points, config);
    const double gain = model.cost - there.cost;
    if (gain > 0) {
      const bool small = gain < kSmallGain * model.cost;
      const double expected = -step.dot(2 * model.g + model.H * step);
      const double share = expected > 0 ? gain / expected : 0;
      damping = std::max(1e-7, damping * std::max(0.15, 1 - std::pow(2 * share - 1, 3)));
      growth = 2;
      state = next;
      model = there;
      if (small) break;
    } else {
      damping *= growth;
      growth *= 2;
      if (damping > 1e6) break;
    }
  }
  return iterations;
}

std::vector<double> distances(const FitState& state, std::span<const Vec3> points) {
  std::vector<double> result;
  result.reserve(points.size());
  const FitForm form(state);
  for (const Vec3& p : points) {
    const FitForm::Value v = form.at(p);
    const double along_ray = (1 - 1 / std::max(1e-9, v.f)) * form.in_own_frame(p).norm();
    const double first_order = (v.f - 1) / std::max(kLeastSlope, v.slope_Q.norm());
    result.push_back(std::abs(along_ray) < std::abs(first_order) ? along_ray : first_order);
  }
  return result;
}

FitErrors fit_errors(std::span<const double> distances) {
  FitErrors errors;
  for (const double d : distances) {
    errors.mean += std::abs(d);
    errors.rms += d * d;
    errors.max = std::max(errors.max, std::abs(d));
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, distances.size()));
  errors.mean /= count;
  errors.rms = std::sqrt(errors.rms / count);
  return errors;
}

}  // namespace mechane::geometry
