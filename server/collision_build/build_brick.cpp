#include "server/collision_build/build_brick.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "server/base/parallel.hpp"
#include "server/collision/block_lattice.hpp"

namespace mechane::collision_build {
namespace {

constexpr int kFinest = collision::DistanceBrick::kFinest;
constexpr float kNotAsked = std::numeric_limits<float>::infinity();
// Of a block's edge: sheets get samples down to this far below the depth that a finger reaches.
constexpr double kBelow = 0.1;
// Of a block's edge: by how much a distance outside may be too large. Culling has to allow for it.
constexpr double kExcess = 0.1;
constexpr int kMendings = 4;        // rounds, at most
constexpr double kHopeless = 0.01;  // of the witnesses
// The box is wider than its contents by this share in all, so that no surface lies on its very edge.
constexpr double kRoom = 1.002;

/// Signed distances at those nodes of the finest lattice that were asked for, and the faces that lie nearest.
class LatticeDistances {
 public:
  LatticeDistances(const Solid& solid, const geometry::MeshQuery& skin, const Pose& X_OQ,
                   const collision::DistanceBrick::Grid& grid)
      : solid_(solid), skin_(skin), X_OQ_(X_OQ), grid_(grid) {
    std::size_t count = 1;
    for (std::size_t i = 0; i < 3; ++i) {
      nodes_[i] = kFinest * grid.blocks[i] + 1;
      count *= static_cast<std::size_t>(nodes_[i]);
    }
    distance_m_.assign(count, kNotAsked);
    nearest_.assign(count, {});
    side_.assign(count, Side::unknown);
    wanted_.assign(count, 0);
  }

  /// The nearest place of the surface to a node.
  struct Nearest {
    std::uint32_t triangle = 0;
    bool on_face = false;  // and not on its edge
  };

  void want(const collision::Node& node) { wanted_[index(node)] = 1; }
  [[nodiscard]] float at(const collision::Node& node) const { return distance_m_[index(node)]; }
  [[nodiscard]] const Nearest& nearest(const collision::Node& node) const { return nearest_[index(node)]; }

  /// Measures the nodes that are wanted and not known yet.
  void measure() {
    std::vector<std::size_t> fresh;
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      if (wanted_[i] != 0 && distance_m_[i] == kNotAsked) fresh.push_back(i);
    }
    for_each_index((fresh.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
      geometry::SurfacePoint found;
      for (std::size_t k = kChunk * chunk; k < std::min(fresh.size(), kChunk * (chunk + 1)); ++k)
        found = measure_one(fresh[k], found);
    });
    for (const std::size_t i : fresh) {
      if (side_[i] == Side::unknown) settle_sides(i);
    }
    for (const std::size_t i : fresh) {
      if (side_[i] == Side::inside) distance_m_[i] = -distance_m_[i];
    }
  }

 private:
  enum class Side : std::uint8_t { unknown, inside, outside };
  static constexpr std::size_t kChunk = 256;
  static constexpr std::size_t kVotes = 9;

  [[nodiscard]] std::size_t index(const collision::Node& node) const { return collision::index_of(nodes_, node); }
  [[nodiscard]] collision::Node node_of(std::size_t i) const {
    const auto n = static_cast<int>(i);
    return {n % nodes_[0], n / nodes_[0] % nodes_[1], n / nodes_[0] / nodes_[1]};
  }
  [[nodiscard]] double spacing_m() const { return static_cast<double>(grid_.block_m) / kFinest; }
  [[nodiscard]] Vec3 place(std::size_t i) const {
    const collision::Node node = node_of(i);
    return X_OQ_ * (grid_.origin_Q.cast<double>() + spacing_m() * Vec3(node[0], node[1], node[2]));
  }

  /// `near`: what was found for the node before, which mostly lies beside this one.
  geometry::SurfacePoint measure_one(std::size_t i, const geometry::SurfacePoint& near) {
    const Vec3 p_O = place(i);
    const geometry::SurfacePoint found = skin_.closest(p_O, near);
    const double above_m = std::abs(skin_.triangle_normal(found.triangle).dot(p_O - found.p));
    nearest_[i] = {found.triangle, above_m >= kOnFace * found.distance_m};
    distance_m_[i] = static_cast<float>(found.distance_m);
    return found;
  }

  /// If the surface lay between two nodes, it would be no farther from them, together, than they are from each other. So most nodes are on
  /// the side of a neighbour. A whole group takes the side that some of its nodes vote for: a ray that grazes an edge may be wrong.
  void settle_sides(std::size_t from) {
    std::vector<std::size_t> group = {from};
    side_[from] = Side::outside;
    for (std::size_t next = 0; next < group.size(); ++next)
      add_neighbours(group[next], group);
    const std::size_t step = std::max<std::size_t>(1, group.size() / kVotes);
    int votes = 0;
    for (std::size_t k = 0; k < group.size(); k += step)
      votes += solid_.contains(place(group[k])) ? 1 : -1;
    for (const std::size_t i : group)
      side_[i] = votes > 0 ? Side::inside : Side::outside;
  }

  /// Adds those neighbours of node `here` to the group that have no side yet and are on the same side.
  void add_neighbours(std::size_t here, std::vector<std::size_t>& group) {
    const collision::Node node = node_of(here);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int way : {-1, 1}) {
        collision::Node next = node;
        next[axis] += way;
        if (next[axis] < 0 || next[axis] >= nodes_[axis]) continue;
        const std::size_t there = index(next);
        if (distance_m_[there] == kNotAsked || side_[there] != Side::unknown) continue;
        if (static_cast<double>(distance_m_[here] + distance_m_[there]) <= kSameSide * spacing_m()) continue;
        side_[there] = Side::outside;  // until the vote
        group.push_back(there);
      }
    }
  }

  const Solid& solid_;
  const geometry::MeshQuery& skin_;
  const Pose& X_OQ_;
  const collision::DistanceBrick::Grid& grid_;
  collision::Node nodes_{};
  std::vector<float> distance_m_;
  std::vector<Nearest> nearest_;
  std::vector<Side> side_;
  std::vector<std::uint8_t> wanted_;
};

/// The distance at `node` that a block whose nodes lie `stride` apart would give.
double interpolated(const LatticeDistances& distances, const collision::Node& block, int stride,
                    const collision::Node& node) {
  return collision::interpolate(block, stride, node, [&](const collision::Node& n) { return distances.at(n); });
}

/// By how much the depth may err where the distance is `truth_m`.
double tolerance_m(double truth_m, const BrickNeeds& needs) {
  if (truth_m < -needs.probe_depth_m) return std::numeric_limits<double>::infinity();
  return std::max(needs.tolerance_m, -needs.share * truth_m);
}

/// Whether a block whose nodes lie `stride` apart gives the depth well enough at the nodes of the finest lattice.
bool is_fine_enough(const LatticeDistances& distances, const collision::Node& block, int stride, double block_m,
                    const BrickNeeds& needs) {
  bool good = true;
  collision::for_each_node_of(block, 1, [&](const collision::Node& node) {
    const double truth = distances.at(node);
    if (!good) return;
    const double told = interpolated(distances, block, stride, node);
    good = std::abs(std::max(-told, 0.0) - std::max(-truth, 0.0)) <= tolerance_m(truth, needs) &&
           (truth < 0 || told - truth <= kExcess * block_m);
  });
  return good;
}

struct Block {
  collision::Node at{};
  int level = 0;
  bool open = false;  // not decided yet
};

std::vector<Block> list_blocks(const collision::Node& blocks) {
  std::vector<Block> list;
  collision::for_each_node(blocks, [&](const collision::Node& block) { list.push_back({block, 0, false}); });
  return list;
}

/// Opens the blocks in which a finger could feel something, and those whose distances in air would be too large; and measures them.
void open_blocks(std::vector<Block>& blocks, LatticeDistances& distances, double block_m, const BrickNeeds& needs) {
  constexpr int kHalf = kFinest / 2;
  const auto center = [](const Block& block) {
    return collision::Node{kFinest * block.at[0] + kHalf, kFinest * block.at[1] + kHalf, kFinest * block.at[2] + kHalf};
  };
  for (const Block& block : blocks) {
    distances.want(center(block));
    collision::for_each_node_of(block.at, kFinest, [&](const collision::Node& node) { distances.want(node); });
  }
  distances.measure();
  const double reach_m = static_cast<double>(collision::kHalfDiagonal) * block_m;
  for (Block& block : blocks) {
    const double distance_m = distances.at(center(block));
    const bool is_near = distance_m < reach_m && distance_m > -reach_m - needs.probe_depth_m;
    const double told_m = interpolated(distances, block.at, kFinest, center(block));
    block.open = is_near || (distance_m > 0 && told_m - distance_m > 0.5 * kExcess * block_m);
    if (block.open)
      collision::for_each_node_of(block.at, 1, [&](const collision::Node& node) { distances.want(node); });
  }
  distances.measure();
}

/// Closes the open blocks whose level is fine enough, and gives the others the next level.
void try_level(std::vector<Block>& blocks, const LatticeDistances& distances, double block_m, const BrickNeeds& needs,
               int level) {
  for (Block& block : blocks) {
    if (!block.open) continue;
    block.open = !is_fine_enough(distances, block.at, kFinest >> level, block_m, needs);
    if (block.open) block.level = level + 1;
  }
}

/// Puts sheets in place of finer cells, where they are exact enough.
class SheetMaker {
 public:
  SheetMaker(const LatticeDistances& distances, const geometry::MeshQuery& skin, const Pose& X_OQ, double block_m,
             const BrickNeeds& needs)
      : distances_(distances), skin_(skin), R_QO_(X_OQ.R.inverse()), block_m_(block_m), needs_(needs) {}

  [[nodiscard]] std::optional<collision::Sheets> make(const Block& block) const {
    std::vector<collision::SheetSample> samples;
    collision::for_each_node_of(block.at, 1, [&](const collision::Node& node) {
      collision::SheetSample sample;
      sample.distance_m = static_cast<double>(distances_.at(node));
      if (sample.distance_m < -needs_.probe_depth_m - kBelow * block_m_) return;
      for (std::size_t i = 0; i < 3; ++i)
        sample.p_B[static_cast<Eigen::Index>(i)] = static_cast<double>(node[i] - kFinest * block.at[i]) / kFinest;
      const LatticeDistances::Nearest& nearest = distances_.nearest(node);
      sample.n_B = R_QO_ * skin_.triangle_normal(nearest.triangle);
      sample.on_face = nearest.on_face;
      sample.tolerance_m = tolerance_m(sample.distance_m, needs_);
      sample.excess_m = kExcess * block_m_;
      samples.push_back(sample);
    });
    auto sheets = collision::fit_sheets(samples, block_m_);
    if (!sheets || !collision::DistanceBrick::fits(*sheets, static_cast<float>(block_m_))) return std::nullopt;
    return sheets;
  }

 private:
  const LatticeDistances& distances_;
  const geometry::MeshQuery& skin_;
  Quat R_QO_;
  double block_m_;
  const BrickNeeds& needs_;
};

collision::DistanceBrick::BlockSheets try_sheets(std::vector<Block>& blocks, const SheetMaker& maker) {
  std::vector<std::optional<collision::Sheets>> made(blocks.size());
  for_each_index(blocks.size(), [&](std::size_t i) {
    if (blocks[i].open) made[i] = maker.make(blocks[i]);
  });
  collision::DistanceBrick::BlockSheets sheets;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (!made[i]) continue;
    sheets.emplace(i, *made[i]);
    blocks[i].level = collision::DistanceBrick::kSheets;
    blocks[i].open = false;
  }
  return sheets;
}

std::size_t bytes_of(std::span<const std::uint8_t> levels, const collision::DistanceBrick::BlockSheets& sheets) {
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    collision::DistanceBrick::Entry entry{levels[i]};
    if (const auto found = sheets.find(i); found != sheets.end()) entry.three = found->second.count == 3;
    const std::size_t nodes = entry.count();
    bytes += (nodes + collision::DistanceBrick::kAlign - 1) / collision::DistanceBrick::kAlign *
             collision::DistanceBrick::kAlign;
  }
  return bytes;
}

/// A brick that is being made, and its sources.
class BrickMaker {
 public:
  BrickMaker(const collision::DistanceBrick::Grid& grid, const std::vector<Block>& blocks,
             collision::DistanceBrick::BlockSheets sheets, LatticeDistances& distances, std::size_t at_most)
      : grid_(grid), blocks_(blocks), sheets_(std::move(sheets)), distances_(distances), at_most_(at_most) {
    for (const Block& block : blocks)
      levels_.push_back(static_cast<std::uint8_t>(block.level));
  }

  /// Empty if it would be too large.
  [[nodiscard]] std::optional<collision::DistanceBrick> make() const {
    const std::size_t bytes = bytes_of(levels_, sheets_);
    if (bytes > collision::DistanceBrick::kMaxValues || bytes + sizeof(std::uint32_t) * levels_.size() > at_most_)
      return std::nullopt;
    return collision::DistanceBrick::from_distances(
        grid_, levels_,
        [&](const collision::Node& node) {
          const auto shift = shifts_m_.find(node);
          return distances_.at(node) + (shift == shifts_m_.end() ? 0 : shift->second);
        },
        sheets_);
  }

  /// A block that answers a witness wrongly gets the finest level. If it has that already, the corners of the cell are shifted, as little
  /// as possible. False when every witness is answered rightly, or too many are not.
  [[nodiscard]] bool mend(const collision::DistanceBrick& brick, const Pose& X_OQ, double stray_m,
                          std::span<const Probe> witnesses) {
    std::vector<Fault> faults;
    const Pose X_QO = X_OQ.inverse();
    for (const Probe& witness : witnesses) {
      const Vec3f p_Q = (X_QO * witness.p_O).cast<float>();
      const float told_m = brick.distance_m(p_Q);
      if (told_m < 0 ? witness.depth_m < -stray_m : witness.depth_m > stray_m) faults.push_back({p_Q, told_m});
    }
    if (faults.empty() || static_cast<double>(faults.size()) > kHopeless * static_cast<double>(witnesses.size()))
      return false;
    std::map<collision::Node, float> shifts_m;
    for (const auto& [p_Q, told_m] : faults) {
      const Vec3f place = brick.lattice_place(p_Q);
      collision::Node cell{};
      for (std::size_t i = 0; i < 3; ++i)
        cell[i] = std::min(static_cast<int>(place[static_cast<Eigen::Index>(i)]), kFinest * grid_.blocks[i] - 1);
      if (!make_finest(block_of(cell)))
        give_way(cell, (told_m < 0 ? brick.step_m() : -brick.step_m()) - told_m, shifts_m);
    }
    distances_.measure();
    for (const auto& [node, by_m] : shifts_m)
      shifts_m_[node] += by_m;
    return true;
  }

 private:
  struct Fault {
    Vec3f p_Q;
    float told_m;
  };

  [[nodiscard]] std::size_t block_of(const collision::Node& cell) const {
    return collision::index_of(grid_.blocks, {cell[0] / kFinest, cell[1] / kFinest, cell[2] / kFinest});
  }

  /// False when it has the finest level already.
  bool make_finest(std::size_t block) {
    constexpr std::uint8_t kHighest = collision::DistanceBrick::kLevels - 1;
    if (levels_[block] == kHighest) return false;
    levels_[block] = kHighest;
    sheets_.erase(block);
    collision::for_each_node_of(blocks_[block].at, 1, [&](const collision::Node& node) { distances_.want(node); });
    return true;
  }

  /// Of several witnesses in a cell, the one that needs the largest shift.
  static void give_way(const collision::Node& cell, float by_m, std::map<collision::Node, float>& shifts_m) {
    for (int corner = 0; corner < 8; ++corner) {
      float& shift_m = shifts_m[{cell[0] + corner % 2, cell[1] + corner / 2 % 2, cell[2] + corner / 4}];
      if (std::abs(by_m) > std::abs(shift_m)) shift_m = by_m;
    }
  }

  const collision::DistanceBrick::Grid& grid_;
  const std::vector<Block>& blocks_;
  collision::DistanceBrick::BlockSheets sheets_;
  LatticeDistances& distances_;
  std::size_t at_most_;
  std::vector<std::uint8_t> levels_;
  std::map<collision::Node, float> shifts_m_;  // of nodes that were shifted
};

}  // namespace

collision::DistanceBrick::Grid brick_grid(const MapFrame& frame, int blocks) {
  collision::DistanceBrick::Grid grid;
  const double block_m = 2 * kRoom * frame.half_Q.maxCoeff() / blocks;
  Vec3 size;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double count = std::max(1.0, std::ceil(2 * kRoom * frame.half_Q[i] / block_m - 1e-6));
    grid.blocks[static_cast<std::size_t>(i)] = static_cast<int>(count);
    size[i] = count * block_m;
  }
  grid.block_m = static_cast<float>(block_m);
  grid.origin_Q = (frame.center_Q - 0.5 * size).cast<float>();
  return grid;
}

std::optional<collision::DistanceBrick> build_brick(const Solid& solid, const geometry::MeshQuery& skin,
                                                    const Pose& X_OQ, const collision::DistanceBrick::Grid& grid,
                                                    const BrickNeeds& needs, std::span<const Probe> witnesses,
                                                    std::size_t at_most) {
  // With all blocks coarse it is smallest. If even that is too large, it need not be measured.
  const std::size_t least = sizeof(std::uint32_t) + collision::DistanceBrick::Entry{}.count();
  if (least * grid.block_count() > at_most) return std::nullopt;
  const auto block_m = static_cast<double>(grid.block_m);
  LatticeDistances distances(solid, skin, X_OQ, grid);
  std::vector<Block> blocks = list_blocks(grid.blocks);
  open_blocks(blocks, distances, block_m, needs);
  try_level(blocks, distances, block_m, needs, 0);
  auto sheets = try_sheets(blocks, SheetMaker(distances, skin, X_OQ, block_m, needs));
  try_level(blocks, distances, block_m, needs, 1);
  BrickMaker maker(grid, blocks, std::move(sheets), distances, at_most);
  std::optional<collision::DistanceBrick> brick = maker.make();
  for (int round = 0; brick && round < kMendings && maker.mend(*brick, X_OQ, needs.stray_m, witnesses); ++round)
    brick = maker.make();
  return brick;
}

}  // namespace mechane::collision_build
