#include "server/collision_build/build_field.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>

#include "server/base/parallel.hpp"
#include "server/collision/block_lattice.hpp"
#include "server/collision/sheet_fit.hpp"
#include "server/collision_build/bounding_plane.hpp"

namespace mechane::collision_build {
namespace {

using collision::DistanceField;
using collision::SheetSample;
using Samples = std::vector<SheetSample>;

constexpr int kSteps = 4;             // of places that are tried along an edge of a cell
constexpr double kFarWeight = 0.02;   // of a place in air that no finger's depth depends on
constexpr double kNearAir = 0.25;     // of a cell's edge: how far out places still count in full
constexpr double kSlopeWeight = 0.3;  // of a slope beside a distance
constexpr double kDeepShare = 0.3;    // of a depth that no finger reaches: by how much it may err
// Of a cell's edge: half the diagonal between places that are tried. Where none is closer to the surface, it does not cross the cell.
constexpr double kNoCloser = 0.8661 / kSteps;
// Of what counts as missed: by so much a witness's depth may err. So may those of a few places of a leaf, as the share kFew of them says.
constexpr double kWitnessShare = 0.75;
constexpr double kFew = 0.1;
constexpr int kCubes = 5;  // along the grid's longest edge there are at least so many of the coarsest cells
constexpr double kRidge = 1e-6;
constexpr double kMoreSlack = 1.25;   // for places between those that were tried
constexpr double kLeastSlack = 1e-4;  // of a block

/// A cube of the grid: some blocks together (then its level is negative), a block, or what is left of one after some halvings. In blocks
/// from the grid's lowest corner on.
struct Cell {
  Vec3 low = Vec3::Zero();
  double edge = 1;
  int level = 0;
  [[nodiscard]] Cell child(int which) const {
    const Vec3 step(which & 1, which >> 1 & 1, which >> 2);
    return {low + 0.5 * edge * step, 0.5 * edge, level + 1};
  }
};

/// What a cell became.
struct BuiltCell {
  enum class Kind { air, leaf, split } kind = Kind::air;
  DistanceField::Leaf leaf;
  std::vector<BuiltCell> children;
};

/// A cell of the coarsest kind.
struct BuiltCube {
  BuiltCell cell;
  double made_up_m = 0;  // how far outside places lie that it tells to be inside
};

/// Places all over a cell, with their exact distances.
class Sampler {
 public:
  Sampler(const FieldSource& source, const DistanceField::Grid& grid, const BrickNeeds& needs)
      : source_(source), R_QO_(source.X_OQ.R.inverse()), grid_(grid), needs_(needs) {}

  [[nodiscard]] Vec3 place_O(const Vec3& blocks) const {
    return source_.X_OQ * (grid_.origin_Q.cast<double>() + block_m() * blocks);
  }
  [[nodiscard]] double block_m() const { return static_cast<double>(grid_.block_m); }

  [[nodiscard]] double tolerance_m(double truth_m) const {
    const double share = truth_m < -needs_.probe_depth_m ? kDeepShare : needs_.share;
    return std::max(needs_.tolerance_m, -share * truth_m);
  }

  /// Unsigned.
  [[nodiscard]] double distance_m(const Vec3& blocks) const { return source_.skin.closest(place_O(blocks)).distance_m; }
  [[nodiscard]] bool is_inside(const Vec3& blocks) const {
    const Vec3 p_O = place_O(blocks);
    return source_.solid.contains(p_O) ||
           (source_.solid.seam_gap_m() > 0 && source_.solid.is_in_crack(p_O, distance_m(blocks)));
  }

  /// (steps + 1)^3 places, x fastest.
  [[nodiscard]] Samples sample(const Cell& cell, int steps = kSteps) const {
    return sample(cell, steps, steps + 1, Vec3::Zero());
  }
  /// kSteps^3 places, each in the middle of eight of those.
  [[nodiscard]] Samples sample_between(const Cell& cell) const {
    return sample(cell, kSteps, kSteps, Vec3::Constant(0.5 / kSteps));
  }

 private:
  [[nodiscard]] bool is_inside(const Vec3& p_O, double distance_m) const {
    return source_.solid.contains(p_O) || source_.solid.is_in_crack(p_O, distance_m);
  }
  [[nodiscard]] Samples sample(const Cell& cell, int steps, int along, const Vec3& first_B) const {
    Samples samples;
    const double spacing_m = cell.edge * block_m() / steps;
    collision::for_each_node({along, along, along}, [&](const collision::Node& node) {
      const int back = node[0] > 0 ? 1 : node[1] > 0 ? along : along * along;
      const SheetSample* before = samples.empty() ? nullptr : &samples[samples.size() - static_cast<std::size_t>(back)];
      samples.push_back(measure(cell, first_B + Vec3(node[0], node[1], node[2]) / steps, before, spacing_m));
    });
    return samples;
  }
  /// `before`: a place that lies spacing_m beside it.
  [[nodiscard]] SheetSample measure(const Cell& cell, const Vec3& p_B, const SheetSample* before,
                                    double spacing_m) const {
    SheetSample sample;
    sample.p_B = p_B;
    const Vec3 p_O = place_O(cell.low + cell.edge * p_B);
    const double at_most_m = before == nullptr ? std::numeric_limits<double>::infinity()
                                               : kSameSide * (std::abs(before->distance_m) + spacing_m) + 1e-9;
    const geometry::SurfacePoint found = source_.skin.closest(p_O, at_most_m);
    const Vec3 n_O = source_.skin.triangle_normal(found.triangle);
    sample.n_B = R_QO_ * n_O;
    sample.on_face = std::abs(n_O.dot(p_O - found.p)) >= kOnFace * found.distance_m;
    // If the surface lay between two places, it would be no farther from them, together, than they are from each other.
    const bool same_side = before != nullptr && std::abs(before->distance_m) + found.distance_m > kSameSide * spacing_m;
    const bool inside = same_side ? before->distance_m < 0 : is_inside(p_O, found.distance_m);
    sample.distance_m = inside ? -found.distance_m : found.distance_m;
    sample.tolerance_m = tolerance_m(sample.distance_m);
    sample.excess_m = std::numeric_limits<double>::infinity();  // planes cull, not leaves
    return sample;
  }

  const FieldSource& source_;
  Quat R_QO_;
  const DistanceField::Grid& grid_;
  const BrickNeeds& needs_;
};

using Terms = Eigen::Matrix<double, 11, 1>;

/// Of the eight corners and the three bubbles, at a place.
Terms terms_at(const Vec3& p_B) {
  Terms t;
  t.head<8>() = collision::corner_weights(p_B);
  for (int axis = 0; axis < 3; ++axis)
    t[8 + axis] = p_B[axis] * (1 - p_B[axis]);
  return t;
}

/// Their slopes along an axis.
Terms slopes_at(const Vec3& p_B, int along) {
  Terms t = Terms::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    t[corner] = (corner >> along & 1) != 0 ? 1 : -1;
    for (int axis = 0; axis < 3; ++axis) {
      if (axis != along) t[corner] *= (corner >> axis & 1) != 0 ? p_B[axis] : 1 - p_B[axis];
    }
  }
  t[8 + along] = 1 - 2 * p_B[along];
  return t;
}

/// Least squares over distances and, where the nearest point lies in a face, slopes.
DistanceField::Leaf fit_smooth(const Samples& samples, double edge_m, double block_m, double tolerance_m) {
  Eigen::Matrix<double, 11, 11> normal = Eigen::Matrix<double, 11, 11>::Zero();
  Terms right = Terms::Zero();
  for (const SheetSample& s : samples) {
    const double share = tolerance_m / s.tolerance_m;
    const double weight = s.distance_m > kNearAir * edge_m ? kFarWeight : share * share;
    const Terms t = terms_at(s.p_B);
    normal.noalias() += weight * t * t.transpose();
    right += weight * s.distance_m * t;
    if (!s.on_face) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const Terms slope = slopes_at(s.p_B, axis);
      normal.noalias() += kSlopeWeight * weight * slope * slope.transpose();
      right += kSlopeWeight * weight * edge_m * s.n_B[axis] * slope;
    }
  }
  normal.diagonal().array() += kRidge;
  const Terms x = normal.ldlt().solve(right) / block_m;
  std::array<double, 8> corners{};
  Eigen::Map<Eigen::Matrix<double, 8, 1>>(corners.data()) = x.head<8>();
  return DistanceField::Leaf::smooth(corners, x.tail<3>());
}

/// How much too large the errors of depths are: at most 1 where a leaf is good enough. What is told to be inside may lie outside by twice
/// as much: culling has to allow for that. `most_m`: by how much all may err, and a few do.
double worst_of(const DistanceField::Leaf& leaf, const Samples& samples, double block_m, double most_m) {
  double worst = 0;
  std::vector<double> shares;
  for (const SheetSample& s : samples) {
    const double told_m = block_m * leaf.at(s.p_B);
    if (told_m >= 0 && s.distance_m >= 0) continue;
    const double error_m = std::abs(std::max(-told_m, 0.0) - std::max(-s.distance_m, 0.0));
    const double wrong_m = std::max(error_m, told_m < 0 ? 0.5 * s.distance_m : 0);
    worst = std::max(worst, wrong_m / std::max(s.tolerance_m, most_m));
    shares.push_back(wrong_m / s.tolerance_m);
  }
  if (shares.empty()) return worst;
  const auto few = static_cast<std::ptrdiff_t>(kFew * static_cast<double>(shares.size()));
  std::nth_element(shares.begin(), shares.end() - 1 - few, shares.end());
  return std::max(worst, *(shares.end() - 1 - few));
}

std::optional<DistanceField::Leaf> fit_edges(Samples samples, double edge_m, double block_m, double most_m) {
  for (SheetSample& s : samples)
    s.tolerance_m = std::max(s.tolerance_m, most_m);
  std::optional<collision::Sheets> sheets = collision::fit_sheets(samples, edge_m);
  if (!sheets) return std::nullopt;
  // A sheet that lies far off decides nothing there; cut, it does not coarsen the others' steps.
  for (auto& sheet : sheets->values_m) {
    for (double& value : sheet)
      value = std::clamp(value, -2 * edge_m, 2 * edge_m) / block_m;
  }
  return DistanceField::Leaf::of_sheets(*sheets);
}

/// The slope of a block's plane: that of the distances where they are small, for there the plane matters.
Vec3 slope_of(const Samples& samples, double block_m) {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (const SheetSample& s : samples) {
    const double d = s.distance_m / block_m;
    const double weight = d > -0.2 && d < 0.3 ? 1 : 0.2;
    const Eigen::Vector4d t(1, s.p_B.x() - 0.5, s.p_B.y() - 0.5, s.p_B.z() - 0.5);
    normal += weight * t * t.transpose();
    right += weight * d * t;
  }
  return normal.ldlt().solve(right).tail<3>();
}

/// The n-th of so many, x fastest.
Vec3 low_of(const collision::Node& count, std::size_t n) {
  const auto at = static_cast<int>(n);
  const int row = at / count[0];
  return Eigen::Vector3i(at % count[0], row % count[1], row / count[1]).cast<double>();
}

/// The plane of each block, x fastest.
std::vector<DistanceField::Plane> make_planes(const Sampler& sampler, const BoundingPlanes& planes,
                                              const DistanceField::Grid& grid) {
  std::vector<DistanceField::Plane> made(grid.block_count());
  for_each_index(made.size(), [&](std::size_t i) {
    const Cell cell{low_of(grid.blocks, i)};
    const Vec3 middle = cell.low + Vec3::Constant(0.5);
    const double distance_m = sampler.distance_m(middle);
    const bool near = distance_m < sampler.block_m();
    const Vec3 slope = slope_of(sampler.sample(cell, near ? kSteps : 1), sampler.block_m());
    made[i] = planes.make(middle, slope, distance_m / sampler.block_m());
    const Vec3 highest = BoundingPlanes::highest(made[i]);
    if (made[i].at(highest) > 0 && sampler.is_inside(cell.low + highest)) made[i] = BoundingPlanes::sunk(made[i]);
  });
  return made;
}

/// Makes one cell of the coarsest kind; says when the whole has become too large.
class CellMaker {
 public:
  CellMaker(const Sampler& sampler, const DistanceField::Grid& grid, std::span<const DistanceField::Plane> planes,
            const BrickNeeds& needs, std::size_t most_slots)
      : sampler_(sampler),
        blocks_(grid.blocks),
        planes_(planes),
        most_m_(kWitnessShare * needs.stray_m),
        tolerance_m_(needs.tolerance_m),
        most_slots_(most_slots) {}

  [[nodiscard]] bool is_too_large() const { return slots_ > most_slots_; }

  [[nodiscard]] BuiltCube make(const Cell& cell, std::span<const Probe> witnesses_B) {
    BuiltCube cube;
    cube.cell = make_cell(cell, {witnesses_B.begin(), witnesses_B.end()}, cube.made_up_m);
    return cube;
  }

 private:
  /// Whether no place of the cell is inside as far as can be told without samples.
  [[nodiscard]] bool is_far_off(const Cell& cell) const {
    for (std::size_t i = 0; i < 3; ++i) {
      if (cell.low[static_cast<Eigen::Index>(i)] >= blocks_[i]) return true;
    }
    if (cell.level >= 0 && is_above(cell)) return true;
    const Vec3 middle = cell.low + Vec3::Constant(0.5 * cell.edge);
    const double reach_m = static_cast<double>(collision::kHalfDiagonal) * cell.edge * sampler_.block_m();
    return sampler_.distance_m(middle) > reach_m && !sampler_.is_inside(middle);
  }
  /// Whether the plane of its block is above 0 all over the cell.
  [[nodiscard]] bool is_above(const Cell& cell) const {
    const Vec3 block = cell.low.array().floor();
    const DistanceField::Plane& plane = planes_[collision::index_of(
        blocks_, {static_cast<int>(block.x()), static_cast<int>(block.y()), static_cast<int>(block.z())})];
    Vec3 lowest = cell.low - block;
    for (std::size_t i = 0; i < 3; ++i)
      lowest[static_cast<Eigen::Index>(i)] += plane.slope[i] > 0 ? 0 : cell.edge;
    return plane.at(lowest) > 0;
  }

  [[nodiscard]] Samples judges_of(const Cell& cell, const Samples& samples, std::vector<Probe>& witnesses_B) const {
    std::erase_if(witnesses_B, [&](const Probe& witness) {
      const Vec3 p_C = (witness.p_O - cell.low) / cell.edge;
      return !(p_C.minCoeff() >= 0 && p_C.maxCoeff() <= 1);
    });
    Samples judges = samples;
    for (const Probe& witness : witnesses_B) {
      SheetSample s;
      s.p_B = (witness.p_O - cell.low) / cell.edge;
      s.distance_m = -witness.depth_m;
      s.tolerance_m = std::max(sampler_.tolerance_m(s.distance_m), most_m_);
      judges.push_back(s);
    }
    return judges;
  }

  /// A leaf, and how much too large its errors are.
  [[nodiscard]] std::pair<DistanceField::Leaf, double> fit(const Cell& cell, const Samples& samples,
                                                           const Samples& judges) const {
    const double block_m = sampler_.block_m();
    const double edge_m = cell.edge * block_m;
    DistanceField::Leaf leaf = fit_smooth(samples, edge_m, block_m, tolerance_m_);
    double worst = worst_of(leaf, judges, block_m, most_m_);
    // Between the places that were fitted, an edge or, in a cell of many blocks, anything may run elsewhere.
    const auto also_between = [&](const DistanceField::Leaf& tried, double so_far) {
      return so_far > 1 ? so_far : std::max(so_far, worst_of(tried, sampler_.sample_between(cell), block_m, most_m_));
    };
    if (cell.level < 0) worst = also_between(leaf, worst);
    if (worst <= 1) return {leaf, worst};
    const auto edges = fit_edges(samples, edge_m, block_m, most_m_);
    if (!edges) return {leaf, worst};
    const double other = also_between(*edges, worst_of(*edges, judges, block_m, most_m_));
    return other < worst ? std::pair(*edges, other) : std::pair(leaf, worst);
  }

  [[nodiscard]] BuiltCell make_cell(const Cell& cell, std::vector<Probe> witnesses_B, double& made_up_m) {
    BuiltCell built;
    if (is_too_large() || is_far_off(cell)) return built;
    const Samples samples = sampler_.sample(cell);
    const double block_m = sampler_.block_m();
    // If two places are close together and both far from the surface, there is no surface between them.
    const auto is_off = [&](const SheetSample& s) { return s.distance_m > kNoCloser * cell.edge * block_m; };
    if (std::all_of(samples.begin(), samples.end(), is_off)) return built;
    const Samples judges = judges_of(cell, samples, witnesses_B);
    double worst = 0;
    std::tie(built.leaf, worst) = fit(cell, samples, judges);
    if (worst > 1 && cell.level < collision::kFieldLevels) {
      built.kind = BuiltCell::Kind::split;
      if (cell.level >= 0) slots_ += 2;  // eight words
      for (int i = 0; i < DistanceField::kChildren; ++i)
        built.children.push_back(make_cell(cell.child(i), witnesses_B, made_up_m));
      return built;
    }
    built.kind = BuiltCell::Kind::leaf;
    slots_ += built.leaf.has_sheets ? 2 : 1;
    for (const SheetSample& s : judges) {
      if (s.distance_m > 0 && built.leaf.at(s.p_B) < 0) made_up_m = std::max(made_up_m, s.distance_m);
    }
    return built;
  }

  const Sampler& sampler_;
  collision::Node blocks_;
  std::span<const DistanceField::Plane> planes_;
  double most_m_;
  double tolerance_m_;
  std::size_t most_slots_;
  std::atomic<std::size_t> slots_{0};
};

/// Cells as they are stored.
class Writer {
 public:
  explicit Writer(DistanceField::Data& data) : data_(data) { data_.slots.emplace_back(); }

  /// Of a cell that is a block or more.
  void put(const Cell& cell, const BuiltCell& built) {
    if (cell.level < 0 && built.kind == BuiltCell::Kind::split) {
      for (int i = 0; i < DistanceField::kChildren; ++i)
        put(cell.child(i), built.children[static_cast<std::size_t>(i)]);
      return;
    }
    const std::uint64_t word = word_of(built, -cell.level);
    if (word == 0) return;
    const collision::Node low{static_cast<int>(cell.low.x()), static_cast<int>(cell.low.y()),
                              static_cast<int>(cell.low.z())};
    const int span = static_cast<int>(cell.edge);
    collision::for_each_node({span, span, span}, [&](const collision::Node& step) {
      const collision::Node block{low[0] + step[0], low[1] + step[1], low[2] + step[2]};
      for (std::size_t i = 0; i < 3; ++i) {
        if (block[i] >= data_.grid.blocks[i]) return;
      }
      data_.entries[collision::index_of(data_.grid.blocks, block)] |= word << 32;
    });
  }

 private:
  [[nodiscard]] std::uint32_t word_of(const BuiltCell& built, int span = 0) {
    if (built.kind == BuiltCell::Kind::air) return 0;
    if (built.kind == BuiltCell::Kind::leaf) return DistanceField::leaf_word(slot_of(built.leaf), span);
    const std::size_t first = data_.children.size();
    data_.children.resize(first + built.children.size());
    for (std::size_t i = 0; i < built.children.size(); ++i) {
      const std::uint32_t word = word_of(built.children[i]);
      data_.children[first + i] = word;
    }
    return DistanceField::split_word(first);
  }
  /// Leaves that are the same, as they are where flat faces lie along the grid, are stored once.
  [[nodiscard]] std::size_t slot_of(const DistanceField::Leaf& leaf) {
    const auto [found, is_new] = known_.try_emplace({leaf.first, leaf.second}, data_.slots.size());
    if (is_new) data_.slots.push_back(leaf.first);
    if (is_new && leaf.has_sheets) data_.slots.push_back(leaf.second);
    return found->second;
  }

  DistanceField::Data& data_;
  std::map<std::pair<DistanceField::Slot, DistanceField::Slot>, std::size_t> known_;
};

geometry::Mesh in_blocks(const FieldSource& source, const DistanceField::Grid& grid) {
  geometry::Mesh mesh = source.skin_mesh;
  const Pose X_QO = source.X_OQ.inverse();
  for (Vec3& p : mesh.vertices)
    p = (X_QO * p - grid.origin_Q.cast<double>()) / static_cast<double>(grid.block_m);
  return mesh;
}

/// The grid in its coarsest cells.
struct Cubes {
  int span = 0;  // each has 2^span blocks along its edge
  collision::Node count{};

  explicit Cubes(const DistanceField::Grid& grid) {
    const int most = *std::max_element(grid.blocks.begin(), grid.blocks.end());
    while (span < DistanceField::kMaxSpan && most >= kCubes << (span + 1))
      ++span;
    for (std::size_t i = 0; i < 3; ++i)
      count[i] = (grid.blocks[i] + edge() - 1) / edge();
  }
  [[nodiscard]] int edge() const { return 1 << span; }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(count[2]);
  }
  [[nodiscard]] Cell cell(std::size_t n) const {
    return {edge() * low_of(count, n), static_cast<double>(edge()), -span};
  }
};

/// Each cube's witnesses, their places in blocks.
std::vector<std::vector<Probe>> sort_witnesses(const FieldSource& source, const DistanceField::Grid& grid,
                                               const Cubes& cubes, std::span<const Probe> witnesses) {
  std::vector<std::vector<Probe>> sorted(cubes.size());
  const Pose X_QO = source.X_OQ.inverse();
  for (const Probe& witness : witnesses) {
    const Vec3 at = (X_QO * witness.p_O - grid.origin_Q.cast<double>()) / static_cast<double>(grid.block_m);
    collision::Node cube{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double along = at[static_cast<Eigen::Index>(i)] / cubes.edge();
      cube[i] = std::clamp(static_cast<int>(std::floor(along)), 0, cubes.count[i] - 1);
    }
    sorted[collision::index_of(cubes.count, cube)].push_back({at, witness.depth_m});
  }
  return sorted;
}

}  // namespace

std::optional<DistanceField> build_field(const FieldSource& source, const DistanceField::Grid& grid,
                                         const BrickNeeds& needs, std::span<const Probe> witnesses,
                                         std::size_t at_most) {
  const std::size_t fixed = sizeof(std::uint64_t) * grid.block_count() + sizeof(DistanceField::Slot);
  if (fixed > at_most) return std::nullopt;
  const Sampler sampler(source, grid, needs);
  const Cubes cubes(grid);
  const auto sorted = sort_witnesses(source, grid, cubes, witnesses);
  const std::size_t most_slots =
      std::min((at_most - fixed) / sizeof(DistanceField::Slot), DistanceField::kMaxSlots / 2);
  const auto planes = make_planes(sampler, BoundingPlanes(in_blocks(source, grid)), grid);
  CellMaker maker(sampler, grid, planes, needs, most_slots);
  std::vector<BuiltCube> built(cubes.size());
  for_each_index(built.size(), [&](std::size_t i) {
    if (!maker.is_too_large()) built[i] = maker.make(cubes.cell(i), sorted[i]);
  });
  if (maker.is_too_large()) return std::nullopt;
  DistanceField::Data data;
  data.grid = grid;
  for (const DistanceField::Plane& plane : planes)
    data.entries.push_back(plane.packed());
  Writer writer(data);
  double made_up_m = 0;
  for (std::size_t i = 0; i < built.size(); ++i) {
    writer.put(cubes.cell(i), built[i].cell);
    made_up_m = std::max(made_up_m, built[i].made_up_m);
  }
  data.slack_m =
      static_cast<float>(std::min(kMoreSlack * made_up_m + kLeastSlack * sampler.block_m(), sampler.block_m()));
  return DistanceField(std::move(data));
}

}  // namespace mechane::collision_build
