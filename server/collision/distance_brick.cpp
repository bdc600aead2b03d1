#include "server/collision/distance_brick.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/base/assert.hpp"
#include "server/collision/block_lattice.hpp"
#include "server/collision/evaluate_one.hpp"

namespace mechane::collision {
namespace {

// Room at the end: a kernel reads four values where it needs two.
constexpr std::size_t kPadding = 3;
constexpr int kLargest = 127;
// Distances differ by at most a block's diagonal from corner to corner; so from the block's base by half of that, and by the base's
// rounding.
constexpr int kHalfBase = DistanceBrick::kBaseSteps / 2;
constexpr float kStepsOfHalfDiagonal = kLargest - kHalfBase;
// For places between the nodes at which the slack is measured.
constexpr float kBetweenNodes = 1.25F;

// An entry: level, place of the first value, how sheets meet, base.
constexpr std::uint32_t kLevelBits = 2;
constexpr std::uint32_t kFirstBits = 20;
constexpr std::uint32_t kBaseBits = 7;
constexpr std::uint32_t kOuterBit = 1U << (kLevelBits + kFirstBits);
constexpr std::uint32_t kInnerBit = kOuterBit << 1;
constexpr std::uint32_t kThreeBit = kOuterBit << 2;
constexpr std::size_t kSheetValues = 8;
/// Of a block whose values are distances at nodes.
int cells_of(int level) {
  return 1 << level;
}

/// The values at nodes, in steps, such that blocks of different levels agree on their common faces.
class SharedNodes {
 public:
  SharedNodes(const DistanceBrick::Grid& grid, std::span<const std::uint8_t> levels, float step_m,
              const DistanceBrick::NodeDistance& distance)
      : grid_(grid), levels_(levels), step_m_(step_m), distance_(distance) {}

  [[nodiscard]] int at(const Node& node) const {
    const Lowest low = lowest_around(node);
    const int stride = DistanceBrick::kFinest / cells_of(low.level);
    if (std::all_of(node.begin(), node.end(), [&](int n) { return n % stride == 0; })) return own(node);
    // The corners of its cell may be shared with still lower levels.
    return static_cast<int>(std::lround(interpolate(low.block, stride, node, [&](const Node& n) { return at(n); })));
  }

 private:
  struct Lowest {
    int level = DistanceBrick::kLevels;
    Node block{};
  };

  /// One of the lowest level among the blocks that meet in the node: it has the fewest nodes, so the others follow it.
  [[nodiscard]] Lowest lowest_around(const Node& node) const {
    Node from{};
    Node to{};
    for (std::size_t i = 0; i < 3; ++i) {
      const bool shared = node[i] % DistanceBrick::kFinest == 0;
      const int above = node[i] / DistanceBrick::kFinest;
      from[i] = std::max(0, shared ? above - 1 : above);
      to[i] = std::min(grid_.blocks[i] - 1, above);
    }
    Lowest low;
    for (int z = from[2]; z <= to[2]; ++z) {
      for (int y = from[1]; y <= to[1]; ++y) {
        for (int x = from[0]; x <= to[0]; ++x) {
          const int level = levels_[index_of(grid_.blocks, {x, y, z})];
          if (level != DistanceBrick::kSheets && level < low.level) low = {level, {x, y, z}};
        }
      }
    }
    return low;
  }

  [[nodiscard]] int own(const Node& node) const {
    constexpr float kMost = static_cast<float>(DistanceBrick::kMaxBase * DistanceBrick::kBaseSteps);
    return static_cast<int>(std::lround(std::clamp(distance_(node) / step_m_, -kMost, kMost)));
  }

  const DistanceBrick::Grid& grid_;
  std::span<const std::uint8_t> levels_;
  float step_m_;
  const DistanceBrick::NodeDistance& distance_;
};

float step_of(float block_m) {
  return kHalfDiagonal * block_m / kStepsOfHalfDiagonal;
}

/// Blocks as they are stored, one after the other.
struct BlockWriter {
  std::vector<std::uint32_t> index;
  std::vector<std::int8_t> values;

  /// `entry` says how; its place and base are found here. `nodes` in steps.
  void add(DistanceBrick::Entry entry, std::span<const int> nodes) {
    constexpr int kSteps = DistanceBrick::kBaseSteps;
    const auto [least, most] = std::minmax_element(nodes.begin(), nodes.end());
    const int base = static_cast<int>(std::lround(0.5 * (*least + *most) / kSteps));
    entry.base = std::clamp(base, -DistanceBrick::kMaxBase, DistanceBrick::kMaxBase);
    entry.first = values.size();
    index.push_back(entry.packed());
    for (const int node : nodes) {
      const int value = static_cast<int>(std::lround(static_cast<double>(node - kSteps * entry.base) / entry.unit()));
      values.push_back(static_cast<std::int8_t>(std::clamp(value, -kLargest - 1, kLargest)));
    }
    while (values.size() % DistanceBrick::kAlign != 0)
      values.push_back(0);
  }
};

}  // namespace

std::size_t DistanceBrick::Grid::block_count() const {
  std::size_t count = 1;
  for (const int n : blocks)
    count *= static_cast<std::size_t>(n);
  return count;
}

std::uint32_t DistanceBrick::Entry::packed() const {
  return static_cast<std::uint32_t>(base) << (32 - kBaseBits) | (outer_convex ? kOuterBit : 0) |
         (inner_convex ? kInnerBit : 0) | (three ? kThreeBit : 0) |
         static_cast<std::uint32_t>(first / kAlign) << kLevelBits | static_cast<std::uint32_t>(level);
}

DistanceBrick::Entry DistanceBrick::Entry::unpacked(std::uint32_t word) {
  Entry entry;
  entry.level = static_cast<int>(word & ((1U << kLevelBits) - 1));
  entry.outer_convex = (word & kOuterBit) != 0;
  entry.inner_convex = (word & kInnerBit) != 0;
  entry.three = (word & kThreeBit) != 0;
  entry.base = static_cast<std::int32_t>(word) >> (32 - kBaseBits);
  entry.first = kAlign * (word >> kLevelBits & ((1U << kFirstBits) - 1));
  return entry;
}

std::size_t DistanceBrick::Entry::count() const {
  const int along = cells() + 1;
  const auto nodes = static_cast<std::size_t>(along);
  return static_cast<std::size_t>(sheets()) * nodes * nodes * nodes;
}

bool DistanceBrick::is_valid(const Grid& grid) {
  const auto fits = [](int n) { return n >= 1 && n <= kMaxBlocks; };
  if (!std::all_of(grid.blocks.begin(), grid.blocks.end(), fits)) return false;
  if (!grid.origin_Q.allFinite() || grid.origin_Q.cwiseAbs().maxCoeff() > 1e4F) return false;
  return std::isfinite(grid.block_m) && grid.block_m >= 1e-6F && grid.block_m <= 1e4F;
}

bool DistanceBrick::is_valid(const Grid& grid, float step_m, float slack_m, std::span<const std::uint32_t> index,
                             std::size_t values) {
  if (!is_valid(grid) || index.size() != grid.block_count() || values > kMaxValues) return false;
  if (!(std::isfinite(step_m) && step_m > 0 && step_m <= grid.block_m)) return false;
  if (!(std::isfinite(slack_m) && slack_m >= 0)) return false;
  return std::all_of(index.begin(), index.end(), [&](std::uint32_t word) {
    const Entry entry = Entry::unpacked(word);
    return entry.first + entry.count() <= values;
  });
}

DistanceBrick::DistanceBrick(const Grid& grid, float step_m, float slack_m, std::vector<std::uint32_t> index,
                             std::span<const std::int8_t> values)
    : grid_(grid), step_m_(step_m), slack_m_(slack_m), index_(std::move(index)), values_(values.begin(), values.end()) {
  MECHANE_ASSERT(is_valid(grid_, step_m_, slack_m_, index_, values.size()));
  values_.insert(values_.end(), kPadding, 0);
}

bool DistanceBrick::fits(const Sheets& sheets, float block_m) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (int sheet = 0; sheet < sheets.count; ++sheet) {
    for (const double value : sheets.values_m[static_cast<std::size_t>(sheet)]) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  const auto step_m = static_cast<double>(step_of(block_m));
  return high - low <= 4 * static_cast<double>(kStepsOfHalfDiagonal) * step_m &&
         std::max(-low, high) < static_cast<double>(kMaxBase * kBaseSteps) * step_m;
}

DistanceBrick DistanceBrick::from_distances(const Grid& grid, std::span<const std::uint8_t> levels,
                                            const NodeDistance& distance, const BlockSheets& sheets) {
  MECHANE_ASSERT(is_valid(grid) && levels.size() == grid.block_count());
  const float step_m = step_of(grid.block_m);
  const SharedNodes shared(grid, levels, step_m, distance);
  BlockWriter writer;
  for_each_node(grid.blocks, [&](const Node& block) {
    const int level = levels[writer.index.size()];
    std::vector<int> nodes;
    if (level == kSheets) {
      const Sheets& some = sheets.at(writer.index.size());
      for (int sheet = 0; sheet < some.count; ++sheet)
        for (const double distance_m : some.values_m[static_cast<std::size_t>(sheet)])
          nodes.push_back(static_cast<int>(std::lround(distance_m / static_cast<double>(step_m))));
      writer.add({level, some.outer_convex, some.inner_convex, some.count == 3}, nodes);
      return;
    }
    for_each_node_of(block, kFinest / cells_of(level), [&](const Node& node) { nodes.push_back(shared.at(node)); });
    writer.add({level}, nodes);
  });
  MECHANE_ASSERT(writer.values.size() <= kMaxValues);
  DistanceBrick brick(grid, step_m, 0, std::move(writer.index), writer.values);
  brick.slack_m_ = brick.measured_slack(distance);
  return brick;
}

Vec3f DistanceBrick::lattice_place(const Vec3f& p_QP) const {
  Vec3f cells = (p_QP - grid_.origin_Q) * (kFinest / grid_.block_m);
  for (std::size_t i = 0; i < 3; ++i) {
    float& at = cells[static_cast<Eigen::Index>(i)];
    at = std::clamp(at, 0.0F, static_cast<float>(kFinest * grid_.blocks[i]));
  }
  return cells;
}

float DistanceBrick::distance_m(const Vec3f& p_QP) const {
  const Vec3f at = lattice_place(p_QP) / kFinest;
  Node block{};
  Vec3f p_B;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    block[i] = std::min(static_cast<int>(at[axis]), grid_.blocks[i] - 1);
    p_B[axis] = at[axis] - static_cast<float>(block[i]);
  }
  return told(index_of(grid_.blocks, block), p_B);
}

/// The distance that a block gives at a place, 0 to 1 along each of its edges.
float DistanceBrick::told(std::size_t block, const Vec3f& p_B) const {
  const Entry entry = Entry::unpacked(index_[block]);
  const int cells = entry.cells();
  Node low{};
  Vec3 f;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const float at = p_B[axis] * static_cast<float>(cells);
    low[i] = std::clamp(static_cast<int>(at), 0, cells - 1);
    f[axis] = static_cast<double>(at - static_cast<float>(low[i]));
  }
  const auto sheet = [&](std::size_t first) {
    const double steps = trilinear(f, [&](const Node& corner) {
      const int x = low[0] + corner[0];
      const int y = low[1] + corner[1];
      const int z = low[2] + corner[2];
      const int at = (z * (cells + 1) + y) * (cells + 1) + x;
      return entry.unit() * values_[first + static_cast<std::size_t>(at)];
    });
    return static_cast<float>(steps + kBaseSteps * entry.base) * step_m_;
  };
  const auto either = [](float a, float b, bool larger) { return larger ? std::max(a, b) : std::min(a, b); };
  const float one = sheet(entry.first);
  if (entry.sheets() == 1) return one;
  float rest = sheet(entry.first + kSheetValues);
  if (entry.three) rest = either(rest, sheet(entry.first + 2 * kSheetValues), entry.inner_convex);
  return either(one, rest, entry.outer_convex);
}

/// For culling. A point that the map puts inside lies at most `made_up` outside. A centre that the map puts outside is at least the map's
/// distance less `too_far` away from the surface. And true distances change by no more than the way between two places.
float DistanceBrick::measured_slack(const NodeDistance& distance) const {
  float made_up = 0;
  float too_far = 0;
  for_each_node({kFinest * grid_.blocks[0] + 1, kFinest * grid_.blocks[1] + 1, kFinest * grid_.blocks[2] + 1},
                [&](const Node& node) {
                  const float truth = distance(node);
                  if (truth <= 0 || std::isinf(truth)) return;
                  const Vec3f p_Q =
                      grid_.origin_Q + grid_.block_m / kFinest * Vec3f(Eigen::Vector3i(node.data()).cast<float>());
                  const float told = distance_m(p_Q);
                  if (told < 0) made_up = std::max(made_up, truth);
                  too_far = std::max(too_far, told - truth);
                });
  return kBetweenNodes * (made_up + too_far) + step_m_;
}

std::span<const std::int8_t> DistanceBrick::values() const {
  return std::span(values_).first(values_.size() - kPadding);
}

BrickView DistanceBrick::view() const noexcept {
  return {index_.data(),     values_.data(), grid_.blocks, {grid_.origin_Q.x(), grid_.origin_Q.y(), grid_.origin_Q.z()},
          1 / grid_.block_m, step_m_,        slack_m_};
}

BoxView DistanceBrick::Grid::box() const noexcept {
  BoxView box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.half[i] = 0.5F * block_m * static_cast<float>(blocks[i]);
    box.center[i] = origin_Q[static_cast<Eigen::Index>(i)] + box.half[i];
  }
  return box;
}

BoxView DistanceBrick::box() const noexcept {
  return grid_.box();
}

MapHit DistanceBrick::evaluate(const Vec3f& p_QP) const noexcept {
  return evaluate_one(p_QP, view(), portable().brick_inside, portable().brick_depth);
}

}  // namespace mechane::collision
