// The inner loops of a contact query, 16 points at a time: one table of functions for each instruction set, chosen at run time. All
// tables give the same bits: additions, products, quotients and roots in one order, nothing approximated, and nothing fused but what is
// written as fused.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace mechane::collision {

inline constexpr std::size_t kLanes = 16;

/// A bit for each of the 16 lanes.
using LaneMask = std::uint32_t;

// None of these has a default: a query holds 64 of them on its stack, and clearing them would cost more than the query.

/// 16 points in storage of the caller's, metres; the caller defines their frame.
struct PointsView {
  const float* x;
  const float* y;
  const float* z;
};

struct alignas(64) PointBlock {
  std::array<float, kLanes> x, y, z;
  [[nodiscard]] PointsView view() const noexcept { return {x.data(), y.data(), z.data()}; }
};

/// 16 spheres; unused lanes may hold any value, but must be readable.
struct SpheresView {
  const float* x;
  const float* y;
  const float* z;
  const float* radius;
};

struct alignas(64) SphereBlock {
  std::array<float, kLanes> x, y, z, radius;
  [[nodiscard]] SpheresView view() const noexcept { return {x.data(), y.data(), z.data(), radius.data()}; }
};

/// p_B = R_BA p_A + p_BA; the rotation row after row.
struct BlockTransform {
  std::array<float, 9> R_BA;
  std::array<float, 3> p_BA;
};

/// A box along the axes of its frame.
struct BoxView {
  std::array<float, 3> center, half;
};

/// What a kernel reads of a RadialMap.
struct RadialView {
  const std::uint16_t* texels;
  int resolution;
  float sigma_step;
  float steepest;  ///< g changes by no more than this over a metre
  std::array<float, 3> center, half, inverse_half;
};

/// What a kernel reads of a DistanceBrick.
struct BrickView {
  const std::uint32_t* index;  ///< DistanceBrick::Entry of each block
  const std::int8_t* values;   ///< followed by three bytes that are not used
  std::array<int, 3> blocks;
  std::array<float, 3> origin;
  float inverse_block;
  float step_m;
  float slack_m;  ///< see DistanceBrick: for culling
};

inline constexpr int kFieldLevels = 4;               ///< how often a block of a DistanceField may be halved
inline constexpr int kFieldSpanAt = 24;              ///< the bit of a leaf's word from which on its span stands
inline constexpr float kFieldValueStep = 1.0F / 64;  ///< of a bounding plane, in blocks
inline constexpr float kFieldSlopeStep = 1.0F / 63;  ///< of its slopes
inline constexpr std::size_t kFieldBatch = 256;      ///< quads that field_hits takes at once
inline constexpr std::uint32_t kFieldLanes[kLanes] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

/// What a kernel reads of a DistanceField.
struct FieldView {
  const unsigned char* entries;   ///< of each block eight bytes: its plane, its word
  const std::uint32_t* children;  ///< eight words for each block that is halved
  const unsigned char* slots;     ///< of sixteen bytes
  std::array<int, 3> blocks;
  std::array<float, 3> origin;
  float inverse_block;
  float block_m;
  float slack;   ///< see DistanceField; in blocks
  float margin;  ///< spheres count as larger by so much; in blocks
};

/// Where up to 16 rigid groups of points are: the middles of their spheres, and their rotations, row after row.
struct alignas(64) GroupPlaces {
  std::array<float, kLanes> x, y, z;
  std::array<std::array<float, kLanes>, 9> R;
};
/// The same as views of the caller's arrays.
struct GroupsView {
  SpheresView spheres;
  std::array<const float*, 9> R;
};

/// Points in clusters of 16, those of a cluster side by side: four quads, with a sphere around each. Strides are from cluster to
/// cluster, in floats. Without spheres, `quads.x` is null.
struct PointRuns {
  const float* x;
  const float* y;
  const float* z;
  std::size_t stride;
  SpheresView quads;
  std::size_t quad_stride;
};

/// Where hits go: a point's number is 16 cluster + lane. There are kLanes places more than `room`.
struct HitRuns {
  std::uint32_t* point;
  float* depth_m;
  float* n_x;
  float* n_y;
  float* n_z;
  std::size_t room;
};

/// Points in a part's frame Q, and how central each lies in the part: what decides between parts that overlap.
struct InsideBlock {
  PointBlock p_Q;
  alignas(64) std::array<float, kLanes> m;
};

/// Depth under the surface (0: the map knows no surface there) and outward unit normal, in Q.
struct DepthBlock {
  alignas(64) std::array<float, kLanes> depth_m;
  PointBlock n_Q;
};

enum class InstructionSet { portable, avx2, avx512 };

/// Any thread; nothing here allocates or throws.
struct Kernels {
  const char* name;
  /// Which of the first `count` spheres may hold a point inside the surface, after the transform: those that reach the map's box and
  /// whose centre is not too far outside for their radius.
  LaneMask (*radial_near)(const RadialView& map, const BlockTransform& X, const SpheresView& spheres,
                          std::size_t count) noexcept;
  LaneMask (*brick_near)(const BrickView& map, const BlockTransform& X, const SpheresView& spheres,
                         std::size_t count) noexcept;
  /// Which points lie inside the surface, after the transform; NaN is outside. `out` gets every lane.
  LaneMask (*radial_inside)(const RadialView& map, const BlockTransform& X, const PointsView& points,
                            InsideBlock& out) noexcept;
  LaneMask (*brick_inside)(const BrickView& map, const BlockTransform& X, const PointsView& points,
                           InsideBlock& out) noexcept;
  /// Depth and normal of points that lie inside; lanes without their bit in `wanted` may be left as they are.
  void (*radial_depth)(const RadialView& map, const PointBlock& p_Q, LaneMask wanted, DepthBlock& out) noexcept;
  void (*brick_depth)(const BrickView& map, const PointBlock& p_Q, LaneMask wanted, DepthBlock& out) noexcept;

  // Of a field. X_B: into units of blocks, from its lowest corner on; see PlacedPart.
  LaneMask (*field_near)(const FieldView& map, const BlockTransform& X_B, const SpheresView& spheres,
                         std::size_t count) noexcept;
  LaneMask (*field_inside)(const FieldView& map, const BlockTransform& X, const PointsView& points,
                           InsideBlock& out) noexcept;
  void (*field_depth)(const FieldView& map, const PointBlock& p_Q, LaneMask wanted, DepthBlock& out) noexcept;
  /// Which spheres may hold a point inside, of those that come in fours: four i begins at stride * i. Writes the spheres' numbers,
  /// 4 i to 4 i + 3, and returns how many. Writes up to three more fours behind the last; `out` needs kLanes places more.
  std::size_t (*field_sift)(const FieldView& map, const BlockTransform& X_B, const SpheresView& spheres,
                            std::size_t stride, std::uint32_t* fours, std::size_t count, std::uint32_t* out) noexcept;
  /// All points inside of at most kFieldBatch quads, with three places behind them: depths, and normals turned by R_AQ.
  /// Returns how many were written.
  std::size_t (*field_hits)(const FieldView& map, const BlockTransform& X_B, const std::array<float, 9>& R_AQ,
                            const PointRuns& points, std::uint32_t* quads, std::size_t count,
                            const HitRuns& out) noexcept;
  /// Whether no point of the first `count` groups is farther than margin_m from where it was.
  bool (*have_stayed)(const GroupsView& now, const GroupPlaces& then, std::size_t count, float margin_m) noexcept;
};

/// Whether this machine can run them.
[[nodiscard]] bool is_supported(InstructionSet set) noexcept;

/// The table of a set that is supported (our bug otherwise).
[[nodiscard]] const Kernels& kernels_of(InstructionSet set) noexcept;

/// The widest set that this machine supports. MECHANE_KERNELS=portable|avx2|avx512 in the environment asks for another one.
[[nodiscard]] InstructionSet best_set() noexcept;

[[nodiscard]] const Kernels& best_kernels() noexcept;

}  // namespace mechane::collision
