#include "server/collision/sheet_fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

#include "server/collision/block_lattice.hpp"

namespace mechane::collision {
namespace {

constexpr std::size_t kMostFaces = 3;
constexpr int kFitRounds = 6;
constexpr std::ptrdiff_t kLeastSamples = 2;  // of a sheet
constexpr double kSlope = 0.3;               // the weight of a slope beside a distance
// How much a sheet's twists cost. With it, a sheet goes on straight where it has no samples.
constexpr double kTwist = 1e-3;
constexpr double kRidge = 1e-9;
constexpr double kSameFace = 0.97;  // cosine: faces closer than this in direction count as one

using Weights = Eigen::Matrix<double, 8, 1>;

/// 1, x, y, xy, z, xz, yz, xyz about the block's middle.
Weights monomials(const Vec3& p_B) {
  const Vec3 q = p_B.array() - 0.5;
  return {1.0, q.x(), q.y(), q.x() * q.y(), q.z(), q.x() * q.z(), q.y() * q.z(), q.prod()};
}

std::array<double, 8> at_corners(const Weights& coefficients) {
  std::array<double, 8> values{};
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p_B(corner & 1, corner >> 1 & 1, corner >> 2);
    values[static_cast<std::size_t>(corner)] = coefficients.dot(monomials(p_B));
  }
  return values;
}

// The monomials that have a slope along each axis: it is 1, b, c and bc there, of the two other coordinates b and c.
constexpr std::array<std::array<Eigen::Index, 4>, 3> kSloped = {{{1, 3, 5, 7}, {2, 3, 6, 7}, {4, 5, 6, 7}}};

/// The sums of a least squares fit. Added up by hand: this is most of a build's time in sheets.
struct NormalEquations {
  Eigen::Matrix<double, 8, 8> matrix = Eigen::Matrix<double, 8, 8>::Zero();
  Weights right = Weights::Zero();

  void add_distance(double distance_m, const Weights& m) {
    for (Eigen::Index column = 0; column < 8; ++column)
      matrix.col(column) += m[column] * m;
    right += distance_m * m;
  }

  /// `weighted_m`: kSlope times the slope over the block.
  void add_slope(const Vec3& p_B, std::size_t axis, double weighted_m) {
    const Vec3 q = p_B.array() - 0.5;
    const double b = axis == 0 ? q.y() : q.x();
    const double c = axis == 2 ? q.y() : q.z();
    const std::array<double, 4> slopes = {1, b, c, b * c};
    const auto& at = kSloped[axis];
    for (std::size_t column = 0; column < 4; ++column) {
      for (std::size_t row = column; row < 4; ++row)
        matrix(at[row], at[column]) += kSlope * slopes[column] * slopes[row];
      right[at[column]] += weighted_m * slopes[column];
    }
  }
};

/// Least squares over the distances and slopes of one sheet's samples.
std::array<double, 8> follow(std::span<const SheetSample> samples, double block_m, const std::vector<int>& sheet_of,
                             int sheet) {
  NormalEquations sums;
  double count = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (sheet_of[i] != sheet) continue;
    const SheetSample& s = samples[i];
    sums.add_distance(s.distance_m, monomials(s.p_B));
    for (std::size_t axis = 0; axis < 3; ++axis)
      sums.add_slope(s.p_B, axis, kSlope * block_m * s.n_B[static_cast<Eigen::Index>(axis)]);
    count += 1;
  }
  for (const int twist : {3, 5, 6, 7})
    sums.matrix(twist, twist) += kTwist * count;
  sums.matrix.diagonal().array() += kRidge * (count + 1);
  return at_corners(sums.matrix.selfadjointView<Eigen::Lower>().ldlt().solve(sums.right));
}

double at(const std::array<double, 8>& sheet, const Weights& w) {
  return Eigen::Map<const Weights>(sheet.data()).dot(w);
}

/// Samples whose faces are unlike each other, the one next to the surface first: up to three.
std::vector<const SheetSample*> unlike_faces(std::span<const SheetSample> samples) {
  const SheetSample* first = nullptr;
  for (const SheetSample& s : samples) {
    if (s.on_face && (first == nullptr || std::abs(s.distance_m) < std::abs(first->distance_m))) first = &s;
  }
  std::vector<const SheetSample*> found;
  if (first != nullptr) found.push_back(first);
  while (!found.empty() && found.size() < kMostFaces) {
    const SheetSample* farthest = nullptr;
    double least = kSameFace;
    for (const SheetSample& s : samples) {
      if (!s.on_face) continue;
      double likest = -1;
      for (const SheetSample* other : found)
        likest = std::max(likest, s.n_B.dot(other->n_B));
      if (likest >= least) continue;
      least = likest;
      farthest = &s;
    }
    if (farthest == nullptr) break;
    found.push_back(farthest);
  }
  return found;
}

/// For each sample, the face that its nearest face is most like. -1: it lies on an edge between faces.
std::vector<int> split_by_normals(std::span<const SheetSample> samples, std::span<const SheetSample* const> faces) {
  std::vector<int> sheet_of;
  for (const SheetSample& s : samples) {
    const auto nearest = std::max_element(faces.begin(), faces.end(), [&](const auto* l, const auto* r) {
      return l->n_B.dot(s.n_B) < r->n_B.dot(s.n_B);
    });
    sheet_of.push_back(s.on_face ? static_cast<int>(nearest - faces.begin()) : -1);
  }
  return sheet_of;
}

bool have_enough(const std::vector<int>& sheet_of, int sheets) {
  for (int sheet = 0; sheet < sheets; ++sheet) {
    if (std::count(sheet_of.begin(), sheet_of.end(), sheet) < kLeastSamples) return false;
  }
  return true;
}

/// The sheet that decides at a place, and its distance.
struct Told {
  int sheet = 0;
  double distance_m = 0;
};

Told ask(const Sheets& sheets, const Vec3& p_B) {
  const Weights w = corner_weights(p_B);
  const auto of = [&](int sheet) { return Told{sheet, at(sheets.values_m[static_cast<std::size_t>(sheet)], w)}; };
  const auto either = [](const Told& a, const Told& b, bool larger) {
    return (b.distance_m > a.distance_m) == larger ? b : a;
  };
  const Told rest = sheets.count == 2 ? of(1) : either(of(1), of(2), sheets.inner_convex);
  return either(of(0), rest, sheets.outer_convex);
}

bool tell(const Sheets& sheets, std::span<const SheetSample> samples) {
  return std::all_of(samples.begin(), samples.end(), [&](const SheetSample& s) {
    const double told = distance_of(sheets, s.p_B);
    if (s.distance_m > 0 && told - s.distance_m > s.excess_m) return false;
    return std::abs(std::max(-told, 0.0) - std::max(-s.distance_m, 0.0)) <= s.tolerance_m;
  });
}

/// `sheets` says how many there are and how they meet.
std::optional<Sheets> fit(std::span<const SheetSample> samples, double block_m, std::vector<int> sheet_of,
                          Sheets sheets) {
  for (int round = 0; round < kFitRounds; ++round) {
    if (!have_enough(sheet_of, sheets.count)) return std::nullopt;
    for (int sheet = 0; sheet < sheets.count; ++sheet)
      sheets.values_m[static_cast<std::size_t>(sheet)] = follow(samples, block_m, sheet_of, sheet);
    if (tell(sheets, samples)) return sheets;
    std::vector<int> next = sheet_of;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (samples[i].on_face) next[i] = ask(sheets, samples[i].p_B).sheet;
    }
    if (next == sheet_of) return std::nullopt;
    sheet_of = std::move(next);
  }
  return std::nullopt;
}

std::optional<Sheets> fit_one(std::span<const SheetSample> samples, double block_m) {
  const std::vector<int> sheet_of(samples.size(), 0);
  Sheets sheets;
  sheets.values_m[0] = sheets.values_m[1] = follow(samples, block_m, sheet_of, 0);
  return tell(sheets, samples) ? std::optional(sheets) : std::nullopt;
}

std::optional<Sheets> fit_two(std::span<const SheetSample> samples, double block_m,
                              std::span<const SheetSample* const> faces) {
  const std::vector<int> sheet_of = split_by_normals(samples, faces.first(2));
  for (const bool convex : {true, false}) {
    if (auto sheets = fit(samples, block_m, sheet_of, {2, {}, convex, convex})) return sheets;
  }
  return std::nullopt;
}

/// All ways in which three faces can meet: in an outer corner, in an inner corner, or as an edge that runs into a third face.
std::optional<Sheets> fit_three(std::span<const SheetSample> samples, double block_m,
                                std::array<const SheetSample*, 3> faces) {
  for (int turn = 0; turn < 3; ++turn) {
    const std::vector<int> sheet_of = split_by_normals(samples, faces);
    for (const bool outer : {true, false}) {
      for (const bool inner : {outer, !outer}) {
        if (turn > 0 && inner == outer) continue;  // their order does not matter
        if (auto sheets = fit(samples, block_m, sheet_of, {3, {}, outer, inner})) return sheets;
      }
    }
    std::rotate(faces.begin(), faces.begin() + 1, faces.end());
  }
  return std::nullopt;
}

}  // namespace

double distance_of(const Sheets& sheets, const Vec3& p_B) {
  return ask(sheets, p_B).distance_m;
}

std::optional<Sheets> fit_sheets(std::span<const SheetSample> samples, double block_m) {
  const std::vector<const SheetSample*> faces = unlike_faces(samples);
  if (faces.empty()) return std::nullopt;
  if (faces.size() == 1) return fit_one(samples, block_m);
  if (auto sheets = fit_two(samples, block_m, faces)) return sheets;
  if (faces.size() == 2) return std::nullopt;
  return fit_three(samples, block_m, {faces[0], faces[1], faces[2]});
}

}  // namespace mechane::collision
