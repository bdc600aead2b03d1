#include "server/geometry/fitting/fit_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "server/geometry/fitting/fit_noise.hpp"
#include "server/geometry/fitting/fit_solver.hpp"
#include "server/geometry/fitting/fit_starts.hpp"

namespace mechane::geometry {
namespace {

constexpr double kTrimmed = 0.05;         // of the points, when robust, for the moments that give the starts
constexpr double kFarthest = 0.1;         // of the diagonal: a point farther off counts as no farther
constexpr double kGoodEnough = 0.002;     // of the diagonal: then taper and bend are not tried
constexpr double kFound = 5e-4;           // of the diagonal: then no further start is tried
constexpr double kNoisy = 0.003;          // of the diagonal: spread that makes a fit too thick and too round
constexpr double kStrayReach = 0.06;      // of the diagonal: gaps between few points are this wide
constexpr double kMostBoundedFold = 0.5;  // of the bend at which the section reaches its axis
constexpr double kMostSpreadGrowth =
    1.15;  // when noise is corrected: a larger growth means that the correction went wrong

/// Short runs from every start on few points, then longer ones of the best on more. A round takes the spread of the distances anew.
constexpr std::size_t kFewPoints = 80;
constexpr std::size_t kMiddlePoints = 256;
constexpr std::size_t kManyPoints = 800;  // to choose the winner by
constexpr int kFewIterations = 4;
constexpr int kMiddleIterations = 6;
constexpr int kFinalIterations = 12;
constexpr int kNoisyIterations = 3;  // before the correction for noise
constexpr std::size_t kRunnersUp = 4;
constexpr std::size_t kFinalists = 2;

struct Attempt {
  FitStart start;
  std::vector<double> off;  // unsigned distances
  double spread = 0;
  double stray = 0;
  double score = std::numeric_limits<double>::infinity();
};

std::vector<Vec3> every_nth(std::span<const Vec3> points, std::size_t wanted) {
  std::vector<Vec3> chosen;
  for (std::size_t i = 0; i < wanted && i < points.size(); ++i)
    chosen.push_back(points[i * points.size() / std::min(wanted, points.size())]);
  return chosen;
}

class Search {
 public:
  Search(std::span<const Vec3> points, const FitConfig& config) : points_(points), config_(config) {
    middle_ = config.robust ? among_others(points, kMiddlePoints) : every_nth(points, kMiddlePoints);
    many_ = every_nth(points, kManyPoints);
    few_ = every_nth(middle_, kFewPoints);
  }

  SearchResult run() {
    // A clean part is often a plain box or cylinder: then the search ends here. With noise no fit is that good, and trying would only
    // take time.
    std::vector<Attempt> finalists;
    if (!config_.robust || !config_.deformations) finalists = sift(false);
    if (config_.deformations && (finalists.empty() || finalists.front().spread > kGoodEnough)) {
      std::vector<Attempt> deformed = sift(true);
      finalists.push_back(straightened(deformed.front()));
      std::move(deformed.begin(), deformed.end(), std::back_inserter(finalists));
    }
    for (Attempt& attempt : finalists)
      measure(attempt, many_);
    see_stray(finalists);
    rank(finalists);
    Attempt rigid =
        *std::find_if(finalists.begin(), finalists.end(), [](const Attempt& a) { return !a.start.deformed; });
    Attempt best = finalists.front();
    bool gains = best.score < (1 - config_.deformation_gain) * rigid.score;
    SearchResult result;
    // If the deformed one cannot be bounded, the rigid one is used.
    if (!gains || config_.bound) finish(rigid);
    result.rigid = found(rigid);
    if (gains) finish(best);
    if (config_.bound && nearly_folds(best)) gains = false;
    result.best = gains ? found(best) : result.rigid;
    result.iterations = iterations_;
    return result;
  }

 private:
  /// A bend whose axis is near: there growing the axes and casting rays along the normals, as bounded parts need it, goes wrong.
  static bool nearly_folds(const Attempt& attempt) {
    const FitState& s = attempt.start.state;
    const double widest = std::hypot(s.a.x() * (1 + std::abs(s.taper[0])), s.a.y() * (1 + std::abs(s.taper[1])));
    return std::hypot(s.bend[0], s.bend[1]) * widest > kMostBoundedFold;
  }

  static FoundFit found(const Attempt& attempt) {
    return {attempt.start.state, attempt.start.deformed, attempt.score, attempt.start.name};
  }

  /// Goes on from where the attempt was measured last.
  void improve_on(Attempt& attempt, std::span<const Vec3> points, Loss loss, int iterations) {
    if (attempt.spread >= kFound)
      iterations_ += improve(attempt.start.state, points, {iterations, attempt.start.deformed, loss, attempt.spread});
    measure(attempt, points);
  }

  static void measure(Attempt& attempt, std::span<const Vec3> points) {
    attempt.off = distances(attempt.start.state, points);
    for (double& d : attempt.off)
      d = std::abs(d);
    attempt.spread = spread_of(attempt.off);
  }

  /// Sorts by the mean distance, the best first. With outliers most of the points decide: each distance counts at most a few times the
  /// best attempt's.
  void rank(std::vector<Attempt>& attempts) const {
    double least = kFarthest;
    for (const Attempt& attempt : attempts)
      least = std::min(least, attempt.spread);
    const double cap = config_.robust ? std::clamp(6 * least, 0.02, kFarthest) : kFarthest;
    for (Attempt& attempt : attempts) {
      attempt.score = attempt.stray;
      for (const double d : attempt.off)
        attempt.score += std::min(cap, d) / static_cast<double>(attempt.off.size());
      if (!is_valid(attempt.start.state.shape())) attempt.score = std::numeric_limits<double>::infinity();
    }
    std::stable_sort(attempts.begin(), attempts.end(),
                     [](const Attempt& l, const Attempt& r) { return l.score < r.score; });
  }

  /// The best of each z axis, because the first runs are too short to tell, and then the best of the others.
  void keep_runners_up(std::vector<Attempt>& attempts) const {
    rank(attempts);
    std::array<bool, 3> has{};
    std::stable_partition(attempts.begin(), attempts.end(),
                          [&](const Attempt& a) { return !std::exchange(has[a.start.z_axis], true); });
    attempts.resize(std::min(attempts.size(), kRunnersUp));
  }

  void see_stray(std::vector<Attempt>& attempts) const {
    if (attempts.size() < 2) return;
    for (Attempt& attempt : attempts)
      attempt.stray = stray_of(attempt.start.state, middle_, kStrayReach).mean_beyond;
  }

  std::vector<Attempt> sift(bool deformed) {
    const double trimmed = config_.robust ? kTrimmed : 0;
    std::vector<Attempt> attempts;
    for (FitStart& start : fit_starts(middle_, deformed, trimmed, !config_.robust)) {
      Attempt& attempt = attempts.emplace_back(Attempt{std::move(start), {}});
      measure(attempt, few_);
      improve_on(attempt, few_, Loss::huber, kFewIterations);
      improve_on(attempt, few_, Loss::huber, kFewIterations);
      if (attempt.spread < kFound) break;
    }
    keep_runners_up(attempts);
    for (Attempt& attempt : attempts)
      improve_on(attempt, middle_, Loss::huber, kMiddleIterations);
    see_stray(attempts);
    rank(attempts);
    attempts.resize(std::min(attempts.size(), attempts.front().spread < kFound ? 1 : kFinalists));
    for (Attempt& attempt : attempts)
      improve_on(attempt, middle_, last_loss(), kMiddleIterations);
    rank(attempts);
    return attempts;
  }

  /// The same without taper and bend.
  Attempt straightened(const Attempt& deformed) {
    Attempt attempt = deformed;
    attempt.start.deformed = false;
    attempt.start.state.taper = attempt.start.state.bend = {0, 0};
    measure(attempt, middle_);
    improve_on(attempt, middle_, Loss::huber, kMiddleIterations);
    improve_on(attempt, middle_, last_loss(), kMiddleIterations);
    return attempt;
  }

  void finish(Attempt& attempt) {
    const bool noisy = config_.robust && attempt.spread > kNoisy;
    improve_on(attempt, points_, last_loss(), noisy ? kNoisyIterations : kFinalIterations);
    if (!noisy) return;
    Attempt freed = attempt;
    const ImproveConfig config{0, freed.start.deformed, last_loss(), freed.spread};
    iterations_ += remove_noise_bias(freed.start.state, points_, config, config_.seed);
    measure(freed, points_);
    if (freed.spread < kMostSpreadGrowth * attempt.spread) attempt = std::move(freed);
  }

  [[nodiscard]] Loss last_loss() const { return config_.robust ? Loss::tukey : Loss::equation3; }

  std::span<const Vec3> points_;
  const FitConfig& config_;
  std::vector<Vec3> many_, middle_, few_;
  int iterations_ = 0;
};

}  // namespace

SearchResult search_fit(std::span<const Vec3> points, const FitConfig& config) {
  return Search(points, config).run();
}

}  // namespace mechane::geometry
