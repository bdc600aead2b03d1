#include "server/geometry/pieces/fan_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

namespace mechane::geometry {
namespace {

constexpr int kSlots = 72;  // places for cuts along an axis, or about it: each 5 degrees
constexpr int kHalvings = 8;

/// The deepest chord among points in a run of slots. Runs may go round the end (sectors), over at most half the slots then.
class RunDepths {
 public:
  RunDepths(const ChordTable& chords, const std::vector<int>& slot_of, bool round)
      : round_(round), longest_(round ? kSlots / 2 : kSlots), depth_(kSlots * static_cast<std::size_t>(kSlots), 0) {
    for (std::size_t i = 0; i < chords.size(); ++i) {
      const auto row = chords.row(i);
      for (std::size_t j = 0; j < i; ++j)
        note(slot_of[i], slot_of[j], row[j]);
    }
    for (int length = 2; length <= longest_; ++length) {
      for (int from = 0; from < kSlots; ++from) {
        if (!round_ && from + length > kSlots) break;
        at(from, length) = std::max({at(from, length), at(from, length - 1), at((from + 1) % kSlots, length - 1)});
      }
    }
  }

  [[nodiscard]] int longest() const { return longest_; }
  [[nodiscard]] std::uint16_t depth(int from, int length) const {
    return depth_[static_cast<std::size_t>(from * kSlots + length - 1)];
  }

  /// Slot borders of the fewest runs within `bound` from slot `start` on, taken greedily; empty when a single slot is too deep or
  /// there would be more than `most`.
  [[nodiscard]] std::vector<int> runs(int start, std::uint16_t bound, std::size_t most) const {
    std::vector<int> borders{start};
    for (int from = start; from < start + kSlots;) {
      const int room = std::min(longest_, start + kSlots - from);
      int length = 0;
      while (length < room && depth(from % kSlots, length + 1) <= bound)
        ++length;
      if (length == 0 || borders.size() > most) return {};
      from += length;
      borders.push_back(from);
    }
    return borders;
  }

 private:
  std::uint16_t& at(int from, int length) { return depth_[static_cast<std::size_t>(from * kSlots + length - 1)]; }
  void note(int a, int b, std::uint16_t units) {
    const int low = std::min(a, b);
    const int high = std::max(a, b);
    const auto put = [&](int from, int length) {
      if (length <= longest_) at(from, length) = std::max(at(from, length), units);
    };
    put(low, high - low + 1);
    if (round_) put(high, low + kSlots - high + 1);
  }

  bool round_;
  int longest_;
  std::vector<std::uint16_t> depth_;
};

struct Runs {
  std::vector<int> borders;  ///< one more than there are runs
  std::uint16_t bound = 0;
  [[nodiscard]] std::size_t count() const { return borders.size() - 1; }
};

std::optional<Runs> fewest_from(const RunDepths& depths, int start, std::uint16_t bound, std::size_t most) {
  Runs best{depths.runs(start, bound, most), bound};
  if (best.borders.size() < 3) return std::nullopt;
  // With the same number, as even as possible.
  int low = 0;
  int high = bound;
  for (int i = 0; i < kHalvings; ++i) {
    const auto middle = static_cast<std::uint16_t>((low + high) / 2);
    auto borders = depths.runs(start, middle, best.count());
    if (borders.size() == best.borders.size()) {
      best = {std::move(borders), middle};
      high = middle;
    } else {
      low = middle;
    }
  }
  return best;
}

bool better(const Runs& a, const std::optional<Runs>& b) {
  if (!b) return true;
  return a.count() < b->count() || (a.count() == b->count() && a.bound < b->bound);
}

FanPlan slices(const Runs& runs, const Vec3& axis, double from, double width) {
  FanPlan plan;
  for (std::size_t k = 0; k < runs.count(); ++k) {
    std::vector<HalfSpace> cell;
    if (k > 0) cell.push_back({-axis, -(from + width * runs.borders[k])});
    if (k + 1 < runs.count()) cell.push_back({axis, from + width * runs.borders[k + 1]});
    plan.push_back(std::move(cell));
  }
  return plan;
}

FanPlan sectors(const Runs& runs, const Vec3& axis, const Vec3& center) {
  const Vec3 u = axis.unitOrthogonal();
  const Vec3 v = axis.cross(u);
  const auto side = [&](int border) {  // points at greater angles lie on the plane's positive side
    const double angle = 2 * kPi * border / kSlots - kPi;
    return HalfSpace::through(center, -std::sin(angle) * u + std::cos(angle) * v);
  };
  FanPlan plan;
  for (std::size_t k = 0; k < runs.count(); ++k) {
    std::vector<HalfSpace> cell{side(runs.borders[k]).flipped()};
    const bool half = runs.borders[k + 1] - runs.borders[k] == kSlots / 2;
    if (!half) cell.push_back(side(runs.borders[k + 1]));
    plan.push_back(std::move(cell));
  }
  return plan;
}

}  // namespace

Vec3 middle_of(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points)
    sum += p;
  return points.empty() ? sum : Vec3(sum / static_cast<double>(points.size()));
}

std::vector<Vec3> likely_axes(const std::vector<Vec3>& points) {
  const Vec3 middle = middle_of(points);
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : points)
    spread += (p - middle) * (p - middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(spread);
  std::vector<Vec3> axes;
  for (int i = 2; i >= 0; --i)
    axes.push_back(eigen.eigenvectors().col(i));
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = Vec3::Unit(i);
    const bool known =
        std::any_of(axes.begin(), axes.end(), [&](const Vec3& a) { return std::abs(a.dot(axis)) > 0.999; });
    if (!known) axes.push_back(axis);
  }
  return axes;
}

std::optional<FanPlan> find_fan(const PieceRegion& region, double bound_m, std::size_t most) {
  if (region.points.size() < 3) return std::nullopt;
  const auto bound = static_cast<std::uint16_t>(std::min(bound_m / region.chords.unit_m(), 65535.0));
  const Vec3 center = middle_of(region.points);
  std::optional<Runs> best;
  FanPlan plan;
  for (const Vec3& axis : likely_axes(region.points)) {
    double from = std::numeric_limits<double>::infinity();
    double to = -from;
    for (const Vec3& p : region.points) {
      from = std::min(from, axis.dot(p));
      to = std::max(to, axis.dot(p));
    }
    const double width = (to - from) / kSlots;
    if (!(width > 0)) continue;
    const Vec3 u = axis.unitOrthogonal();
    const Vec3 v = axis.cross(u);
    std::vector<int> slice_of;
    std::vector<int> sector_of;
    for (const Vec3& p : region.points) {
      slice_of.push_back(std::clamp(static_cast<int>((axis.dot(p) - from) / width), 0, kSlots - 1));
      const double angle = std::atan2(v.dot(p - center), u.dot(p - center)) + kPi;
      sector_of.push_back(std::clamp(static_cast<int>(angle / (2 * kPi) * kSlots), 0, kSlots - 1));
    }
    const auto cut = fewest_from(RunDepths(region.chords, slice_of, false), 0, bound, most);
    if (cut && better(*cut, best)) {
      best = cut;
      plan = slices(*cut, axis, from, width);
    }
    const RunDepths round(region.chords, sector_of, true);
    for (int start = 0; start < kSlots; ++start) {
      const auto turn = fewest_from(round, start, bound, best ? best->count() : most);
      if (!turn || !better(*turn, best)) continue;
      best = turn;
      plan = sectors(*turn, axis, center);
    }
  }
  if (!best) return std::nullopt;
  return plan;
}

}  // namespace mechane::geometry
