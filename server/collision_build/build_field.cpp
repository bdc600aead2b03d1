#include "server/collision_build/build_field.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
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
constexpr double kDeepShare = 0.2;    // of a depth that no finger reaches: by how much it may err
// Of a cell's edge: half the diagonal between places that are tried. Where none is closer to the surface, it does not cross the cell.
constexpr double kNoCloser = 0.8661 / kSteps;
constexpr double kWitnessShare = 0.75;  // of what counts as missed: by so much a witness's depth may err
constexpr double kRidge = 1e-6;
constexpr double kMoreSlack = 1.25;   // for places between those that were tried
constexpr double kLeastSlack = 1e-4;  // of a block

/// A cube of the grid: a block, or what is left of one after some halvings. In blocks from the grid's lowest corner on.
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
struct Made {
  enum class Kind { air, leaf, split } kind = Kind::air;
  DistanceField::Leaf leaf;
  std::vector<Made> children;
};

struct MadeBlock {
  DistanceField::Plane plane;
  Made made;
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
  [[nodiscard]] bool is_inside(const Vec3& blocks) const { return source_.solid.contains(place_O(blocks)); }

  /// (kSteps + 1)^3 places, x fastest.
  [[nodiscard]] Samples sample(const Cell& cell) const { return sample(cell, kSteps + 1, Vec3::Zero()); }
  /// kSteps^3 places, each in the middle of eight of those.
  [[nodiscard]] Samples sample_between(const Cell& cell) const {
    return sample(cell, kSteps, Vec3::Constant(0.5 / kSteps));
  }

 private:
  [[nodiscard]] Samples sample(const Cell& cell, int along, const Vec3& first_B) const {
    Samples samples;
    const double spacing_m = cell.edge * block_m() / kSteps;
    collision::for_each_node({along, along, along}, [&](const collision::Node& node) {
      const int back = node[0] > 0 ? 1 : node[1] > 0 ? along : along * along;
      const SheetSample* before = samples.empty() ? nullptr : &samples[samples.size() - static_cast<std::size_t>(back)];
      samples.push_back(measure(cell, first_B + Vec3(node[0], node[1], node[2]) / kSteps, before, spacing_m));
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
    const bool inside = same_side ? before->distance_m < 0 : source_.solid.contains(p_O);
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
    normal.selfadjointView<Eigen::Lower>().rankUpdate(t, weight);
    right += weight * s.distance_m * t;
    if (!s.on_face) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const Terms slope = slopes_at(s.p_B, axis);
      normal.selfadjointView<Eigen::Lower>().rankUpdate(slope, kSlopeWeight * weight);
      right += kSlopeWeight * weight * edge_m * s.n_B[axis] * slope;
    }
  }
  normal.diagonal().array() += kRidge;
  const Terms x = normal.selfadjointView<Eigen::Lower>().ldlt().solve(right) / block_m;
  std::array<double, 8> corners{};
  Eigen::Map<Eigen::Matrix<double, 8, 1>>(corners.data()) = x.head<8>();
  return DistanceField::Leaf::smooth(corners, x.tail<3>());
}

/// The largest error of a depth, as a share of what it may be. What is told to be inside may lie outside by twice as much: culling has to
/// allow for that.
double worst_of(const DistanceField::Leaf& leaf, const Samples& samples, double block_m) {
  double worst = 0;
  for (const SheetSample& s : samples) {
    const double told_m = block_m * leaf.at(s.p_B);
    const double error_m = std::abs(std::max(-told_m, 0.0) - std::max(-s.distance_m, 0.0));
    const double made_up_m = told_m < 0 ? 0.5 * s.distance_m : 0;
    worst = std::max(worst, std::max(error_m, made_up_m) / s.tolerance_m);
  }
  return worst;
}

std::optional<DistanceField::Leaf> fit_edges(const Samples& samples, double edge_m, double block_m) {
  std::optional<collision::Sheets> sheets = collision::fit_sheets(samples, edge_m);
  if (!sheets) return std::nullopt;
  // A sheet that lies far off decides nothing there; cut, it does not coarsen the others' steps.
  for (auto& sheet : sheets->values_m) {
    for (double& value : sheet)
      value = std::clamp(value, -2 * edge_m, 2 * edge_m) / block_m;
  }
  return DistanceField::Leaf::of_sheets(*sheets);
}

/// Makes one block; says when the whole has become too large.
class BlockMaker {
 public:
  BlockMaker(const Sampler& sampler, const BoundingPlanes& planes, const BrickNeeds& needs, std::size_t most_slots)
      : sampler_(sampler), planes_(planes), needs_(needs), most_slots_(most_slots) {}

  [[nodiscard]] bool is_too_large() const { return slots_ > most_slots_; }

  [[nodiscard]] MadeBlock make(const collision::Node& block, std::span<const Probe> witnesses_B) {
    MadeBlock out;
    const Cell cell{Vec3(block[0], block[1], block[2])};
    const Vec3 middle = cell.low + Vec3::Constant(0.5);
    const double distance_m = sampler_.distance_m(middle);
    const bool crossed = distance_m < static_cast<double>(collision::kHalfDiagonal) * sampler_.block_m();
    const bool wanted = crossed || sampler_.is_inside(middle);
    const Samples samples = wanted ? sampler_.sample(cell) : corners_of(cell);
    out.plane = plane_of(middle, samples, distance_m);
    const Vec3 highest = BoundingPlanes::highest(out.plane);
    if (out.plane.at(highest) > 0 && sampler_.is_inside(cell.low + highest))
      out.plane = BoundingPlanes::sunk(out.plane);
    if (wanted) out.made = make_cell(cell, samples, witnesses_B, out);
    return out;
  }

 private:
  [[nodiscard]] Samples corners_of(const Cell& cell) const {
    Samples corners;
    collision::for_each_node({2, 2, 2}, [&](const collision::Node& node) {
      SheetSample corner;
      corner.p_B = Vec3(node[0], node[1], node[2]);
      corner.distance_m = sampler_.distance_m(cell.low + corner.p_B);
      corners.push_back(corner);
    });
    return corners;
  }

  /// The slope is that of the distances where they are small: there the plane matters.
  [[nodiscard]] DistanceField::Plane plane_of(const Vec3& middle, const Samples& samples, double distance_m) const {
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (const SheetSample& s : samples) {
      const double d = s.distance_m / sampler_.block_m();
      const double weight = d > -0.2 && d < 0.3 ? 1 : 0.2;
      const Eigen::Vector4d t(1, s.p_B.x() - 0.5, s.p_B.y() - 0.5, s.p_B.z() - 0.5);
      normal += weight * t * t.transpose();
      right += weight * d * t;
    }
    const Eigen::Vector4d x = normal.ldlt().solve(right);
    return planes_.make(middle, x.tail<3>(), distance_m / sampler_.block_m());
  }

  /// Whether no place of the cell is inside: so say the plane of its block, or the distances of places that lie close together.
  [[nodiscard]] static bool is_air(const Cell& cell, const DistanceField::Plane& plane, const Samples& samples,
                                   double edge_m) {
    Vec3 lowest = cell.low - cell.low.array().floor().matrix();  // in the block
    for (std::size_t i = 0; i < 3; ++i)
      lowest[static_cast<Eigen::Index>(i)] += plane.slope[i] > 0 ? 0 : cell.edge;
    if (plane.at(lowest) > 0) return true;
    return std::all_of(samples.begin(), samples.end(),
                       [&](const SheetSample& s) { return s.distance_m > kNoCloser * edge_m; });
  }

  [[nodiscard]] Samples judges_of(const Cell& cell, const Samples& samples, std::span<const Probe> witnesses_B) const {
    Samples judges = samples;
    for (const Probe& witness : witnesses_B) {
      SheetSample s;
      s.p_B = (witness.p_O - cell.low) / cell.edge;
      if (!(s.p_B.minCoeff() >= 0 && s.p_B.maxCoeff() <= 1)) continue;
      s.distance_m = -witness.depth_m;
      s.tolerance_m = std::max(sampler_.tolerance_m(s.distance_m), kWitnessShare * needs_.stray_m);
      judges.push_back(s);
    }
    return judges;
  }

  [[nodiscard]] Made make_cell(const Cell& cell, const Samples& samples, std::span<const Probe> witnesses_B,
                               MadeBlock& block) {
    Made made;
    const double block_m = sampler_.block_m();
    const double edge_m = cell.edge * block_m;
    if (is_too_large() || is_air(cell, block.plane, samples, edge_m)) return made;
    const Samples judges = judges_of(cell, samples, witnesses_B);
    made.leaf = fit_smooth(samples, edge_m, block_m, needs_.tolerance_m);
    double worst = worst_of(made.leaf, judges, block_m);
    if (const auto edges = worst > 1 ? fit_edges(samples, edge_m, block_m) : std::nullopt) {
      double other = worst_of(*edges, judges, block_m);
      // Between the places that were fitted an edge may run elsewhere.
      if (other <= 1) other = std::max(other, worst_of(*edges, sampler_.sample_between(cell), block_m));
      if (other < worst) made.leaf = *edges;
      worst = std::min(worst, other);
    }
    if (worst > 1 && cell.level < collision::kFieldLevels) {
      made.kind = Made::Kind::split;
      slots_ += 2;  // eight words
      for (int i = 0; i < DistanceField::kChildren; ++i) {
        const Cell child = cell.child(i);
        made.children.push_back(make_cell(child, sampler_.sample(child), witnesses_B, block));
      }
      return made;
    }
    made.kind = Made::Kind::leaf;
    slots_ += made.leaf.has_sheets ? 2 : 1;
    for (const SheetSample& s : judges) {
      if (s.distance_m > 0 && made.leaf.at(s.p_B) < 0) block.made_up_m = std::max(block.made_up_m, s.distance_m);
    }
    return made;
  }

  const Sampler& sampler_;
  const BoundingPlanes& planes_;
  const BrickNeeds& needs_;
  std::size_t most_slots_;
  std::atomic<std::size_t> slots_{0};
};

/// Cells as they are stored.
class Writer {
 public:
  explicit Writer(DistanceField::Data& data) : data_(data) { data_.slots.emplace_back(); }

  [[nodiscard]] std::uint32_t put(const Made& made) {
    if (made.kind == Made::Kind::air) return 0;
    if (made.kind == Made::Kind::leaf) {
      const std::uint32_t word = DistanceField::leaf_word(data_.slots.size());
      data_.slots.push_back(made.leaf.first);
      if (made.leaf.has_sheets) data_.slots.push_back(made.leaf.second);
      return word;
    }
    const std::size_t first = data_.children.size();
    data_.children.resize(first + made.children.size());
    for (std::size_t i = 0; i < made.children.size(); ++i) {
      const std::uint32_t word = put(made.children[i]);
      data_.children[first + i] = word;
    }
    return DistanceField::split_word(first);
  }

 private:
  DistanceField::Data& data_;
};

geometry::Mesh in_blocks(const FieldSource& source, const DistanceField::Grid& grid) {
  geometry::Mesh mesh = source.skin_mesh;
  const Pose X_QO = source.X_OQ.inverse();
  for (Vec3& p : mesh.vertices)
    p = (X_QO * p - grid.origin_Q.cast<double>()) / static_cast<double>(grid.block_m);
  return mesh;
}

/// Each block's witnesses, their places in blocks.
std::vector<std::vector<Probe>> sort_witnesses(const FieldSource& source, const DistanceField::Grid& grid,
                                               std::span<const Probe> witnesses) {
  std::vector<std::vector<Probe>> sorted(grid.block_count());
  const Pose X_QO = source.X_OQ.inverse();
  for (const Probe& witness : witnesses) {
    const Vec3 at = (X_QO * witness.p_O - grid.origin_Q.cast<double>()) / static_cast<double>(grid.block_m);
    collision::Node block{};
    for (std::size_t i = 0; i < 3; ++i)
      block[i] = std::clamp(static_cast<int>(std::floor(at[static_cast<Eigen::Index>(i)])), 0, grid.blocks[i] - 1);
    sorted[collision::index_of(grid.blocks, block)].push_back({at, witness.depth_m});
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
  const BoundingPlanes planes(in_blocks(source, grid));
  const auto sorted = sort_witnesses(source, grid, witnesses);
  const std::size_t most_slots =
      std::min((at_most - fixed) / sizeof(DistanceField::Slot), DistanceField::kMaxSlots / 2);
  BlockMaker maker(sampler, planes, needs, most_slots);
  std::vector<MadeBlock> made(grid.block_count());
  for_each_index(made.size(), [&](std::size_t i) {
    if (maker.is_too_large()) return;
    const auto n = static_cast<int>(i);
    made[i] = maker.make({n % grid.blocks[0], n / grid.blocks[0] % grid.blocks[1], n / grid.blocks[0] / grid.blocks[1]},
                         sorted[i]);
  });
  if (maker.is_too_large()) return std::nullopt;
  DistanceField::Data data;
  data.grid = grid;
  Writer writer(data);
  double made_up_m = 0;
  for (const MadeBlock& block : made) {
    const std::uint64_t word = writer.put(block.made);
    data.entries.push_back(word << 32 | block.plane.packed());
    made_up_m = std::max(made_up_m, block.made_up_m);
  }
  data.slack_m =
      static_cast<float>(std::min(kMoreSlack * made_up_m + kLeastSlack * sampler.block_m(), sampler.block_m()));
  return DistanceField(std::move(data));
}

}  // namespace mechane::collision_build
