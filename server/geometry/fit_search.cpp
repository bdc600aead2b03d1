#include "server/geometry/fit_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "server/geometry/fit_noise.hpp"
#include "server/geometry/fit_solver.hpp"
#include "server/geometry/fit_starts.hpp"

namespace mechane::geometry {
namespace {

constexpr double kTrimmed = 0.2;       // of the points, when robust, for the moments that give the starts
constexpr double kFarthest = 0.1;      // of the diagonal: a point farther off says no more than that it is far
constexpr double kGoodEnough = 0.002;  // of the diagonal: then taper and bend are not tried
constexpr double kFound = 5e-4;        // of the diagonal: then no further start is tried
constexpr double kNoisy = 0.003;        // of the diagonal: spread that makes a fit too thick and too round
constexpr double kClose = 1.3;         // how much worse the rigid fit may be in the middle of the search, and still go on

/// How one kind of start is sifted: short runs on few points, then the best of them on more.
struct Plan {
  std::size_t few, middle;          // points
  int few_rounds, few_iterations;   // a round takes the spread of the distances anew
  int middle_rounds, middle_iterations;
  std::size_t runners_up, finalists;
};
constexpr Plan kRigidPlan = {64, 256, 2, 3, 2, 4, 3, 1};
constexpr Plan kDeformedPlan = {100, 300, 2, 5, 2, 6, 4, 2};
constexpr int kFinalRounds = 2;
constexpr int kFinalIterations = 4;

struct Attempt {
  FitStart start;
  std::vector<double> off;  // unsigned distances
  double spread = 0;
  double score = std::numeric_limits<double>::infinity();
};

std::vector<Vec3> every_nth(std::span<const Vec3> points, std::size_t wanted) {
  std::vector<Vec3> chosen;
  const std::size_t step = std::max<std::size_t>(1, points.size() / wanted);
  for (std::size_t i = 0; i < points.size(); i += step)
    chosen.push_back(points[i]);
  return chosen;
}

class Search {
 public:
  Search(std::span<const Vec3> points, const FitConfig& config) : points_(points), config_(config) {}

  SearchResult run() {
    SearchResult result;
    std::vector<Attempt> finalists = sift(false, kRigidPlan);
    Attempt rigid = finalists.front();
    const bool tries_deformed = config_.deformations && rigid.spread > kGoodEnough;
    finalists.clear();
    if (tries_deformed) finalists = sift(true, kDeformedPlan);
    // The rigid fit that the best deformed one leads to: its z may be an axis that the moments do not show.
    for (Attempt& attempt : finalists)
      finish(attempt);
    finish(rigid);
    finalists.push_back(rigid);
    rank(finalists);
    const auto found_rigid =
        std::find_if(finalists.begin(), finalists.end(), [](const Attempt& a) { return !a.start.deformed; });
    result.rigid = found(*found_rigid);
    const Attempt& best = finalists.front();
    const bool gains = best.score < (1 - config_.deformation_gain) * found_rigid->score;
    result.best = gains ? found(best) : result.rigid;
    const double spread = (gains ? best : *found_rigid).spread;
    if (config_.robust && spread > kNoisy)
      iterations_ += remove_noise_bias(result.best.state, points_, {0, result.best.deformed, Loss::tukey, spread}, config_.seed);
    result.iterations = iterations_;
    return result;
  }

 private:
  static FoundFit found(const Attempt& attempt) {
    return {attempt.start.state, attempt.start.deformed, attempt.score, attempt.start.name};
  }

  void improve_in_rounds(Attempt& attempt, std::span<const Vec3> points, Loss loss, int rounds, int iterations) {
    for (int round = 0; round < rounds; ++round) {
      ImproveConfig config{iterations, attempt.start.deformed, loss, 1};
      if (loss != Loss::square) config.scale = spread_of(distances(attempt.start.state, points));
      iterations_ += improve(attempt.start.state, points, config);
    }
    measure(attempt, points);
  }

  static void measure(Attempt& attempt, std::span<const Vec3> points) {
    attempt.off = distances(attempt.start.state, points);
    for (double& d : attempt.off)
      d = std::abs(d);
    attempt.spread = spread_of(attempt.off);
  }

  /// Sorts by the mean distance, the best first. With outliers what most points say is what counts: a distance counts at most a few
  /// times what the best attempt leaves.
  void rank(std::vector<Attempt>& attempts) const {
    double least = kFarthest;
    for (const Attempt& attempt : attempts)
      least = std::min(least, attempt.spread);
    const double cap = config_.robust ? std::clamp(6 * least, 0.02, kFarthest) : kFarthest;
    for (Attempt& attempt : attempts) {
      attempt.score = 0;
      for (const double d : attempt.off)
        attempt.score += std::min(cap, d) / static_cast<double>(attempt.off.size());
      if (!is_valid(attempt.start.state.shape())) attempt.score = std::numeric_limits<double>::infinity();
    }
    std::stable_sort(attempts.begin(), attempts.end(),
                     [](const Attempt& l, const Attempt& r) { return l.score < r.score; });
  }

  /// The best of each z axis, for the first runs are too short to tell, and then the best of the others.
  void keep_runners_up(std::vector<Attempt>& attempts, std::size_t count) const {
    rank(attempts);
    std::array<bool, 3> has{};
    std::stable_partition(attempts.begin(), attempts.end(),
                          [&](const Attempt& a) { return !std::exchange(has[a.start.z_axis], true); });
    attempts.resize(std::min(attempts.size(), count));
  }

  std::vector<Attempt> sift(bool deformed, const Plan& plan) {
    const std::vector<Vec3> few = every_nth(points_, plan.few);
    const std::vector<Vec3> middle = every_nth(points_, plan.middle);
    std::vector<Attempt> attempts;
    for (FitStart& start : fit_starts(middle, deformed, config_.robust ? kTrimmed : 0)) {
      attempts.push_back({std::move(start), {}});
      improve_in_rounds(attempts.back(), few, Loss::huber, plan.few_rounds, plan.few_iterations);
      if (attempts.back().spread < kFound) break;
    }
    keep_runners_up(attempts, plan.runners_up);
    for (std::size_t i = 0; i < attempts.size(); ++i) {
      improve_in_rounds(attempts[i], middle, Loss::huber, 1, plan.middle_iterations);
      if (attempts[i].spread >= kFound)
        improve_in_rounds(attempts[i], middle, config_.robust ? Loss::tukey : Loss::huber, plan.middle_rounds - 1, plan.middle_iterations);
      if (attempts[i].spread < kFound) {
        attempts = {attempts[i]};
        break;
      }
    }
    rank(attempts);
    attempts.resize(std::min(attempts.size(), plan.finalists));
    return attempts;
  }

  void finish(Attempt& attempt) {
    improve_in_rounds(attempt, points_, config_.robust ? Loss::tukey : Loss::square, kFinalRounds, kFinalIterations);
  }

  std::span<const Vec3> points_;
  const FitConfig& config_;
  int iterations_ = 0;
};

}  // namespace

SearchResult search_fit(std::span<const Vec3> points, const FitConfig& config) {
  return Search(points, config).run();
}

}  // namespace mechane::geometry
