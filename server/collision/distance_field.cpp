#include "server/collision/distance_field.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "server/base/assert.hpp"
#include "server/collision/block_lattice.hpp"
#include "server/collision/evaluate_one.hpp"

namespace mechane::collision {
namespace {

static_assert(std::endian::native == std::endian::little, "kernels read words and bytes of the same memory");

constexpr double kMostSteps = 127;  // of a corner from the base
constexpr std::size_t kFlagsAt = 11;
constexpr std::size_t kScaleAt = 12;
constexpr std::size_t kBaseAt = 14;
constexpr std::uint8_t kHasSheets = 1;
constexpr std::uint8_t kHasThree = 2;
constexpr std::uint8_t kOuterConvex = 4;
constexpr std::uint8_t kInnerConvex = 8;
constexpr float kLeastScale = 1e-6F;
constexpr std::uint32_t kSlotMask = (1U << kFieldSpanAt) - 1;  // of a leaf's word
static_assert(DistanceField::kMaxSlots << 1 <= kSlotMask);

/// A float32's upper half. Towards zero.
std::uint16_t upper_half(float x) {
  return static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(x) >> 16);
}

float whole(std::uint16_t half) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(half) << 16);
}

std::uint16_t half_at(const DistanceField::Slot& slot, std::size_t at) {
  std::uint16_t half = 0;
  std::memcpy(&half, &slot[at], sizeof half);
  return half;
}

std::uint8_t steps(double value, double scale) {
  const double rounded = std::clamp(std::round(value / scale), -kMostSteps, kMostSteps);
  return static_cast<std::uint8_t>(static_cast<std::int8_t>(rounded));
}

double signed_byte(std::uint8_t byte) {
  return static_cast<double>(static_cast<std::int8_t>(byte));
}

/// Chooses base and scale for all `corners` and writes them; `put(i, steps)` gets each corner.
template <class Put>
double quantise(std::span<const double> corners, DistanceField::Slot& slot, const Put& put) {
  const auto [least, most] = std::minmax_element(corners.begin(), corners.end());
  const std::uint16_t base_half = upper_half(static_cast<float>(0.5 * (*least + *most)));
  const auto base = static_cast<double>(whole(base_half));
  const double reach = std::max({*most - base, base - *least, kMostSteps * static_cast<double>(kLeastScale)});
  std::uint16_t scale_half = upper_half(static_cast<float>(reach / kMostSteps));
  if (kMostSteps * static_cast<double>(whole(scale_half)) < reach) ++scale_half;
  const auto scale = static_cast<double>(whole(scale_half));
  std::memcpy(&slot[kScaleAt], &scale_half, sizeof scale_half);
  std::memcpy(&slot[kBaseAt], &base_half, sizeof base_half);
  for (std::size_t i = 0; i < corners.size(); ++i)
    put(i, steps(corners[i] - base, scale));
  return scale;
}

double between_corners(const std::uint8_t* corners, const Vec3& p_L) {
  const auto weights = corner_weights(p_L);
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner)
    sum += weights[corner] * signed_byte(corners[corner]);
  return sum;
}

bool is_sound_leaf(const DistanceField::Data& data, std::size_t slot) {
  if (slot == 0 || slot >= data.slots.size()) return false;
  const DistanceField::Slot& first = data.slots[slot];
  const float scale = whole(half_at(first, kScaleAt));
  if (!std::isfinite(scale) || !std::isfinite(whole(half_at(first, kBaseAt)))) return false;
  return (first[kFlagsAt] & kHasSheets) == 0 || slot + 1 < data.slots.size();
}

/// Checks words, the last children first: children come after their parents, so that no word leads in a circle.
class WordCheck {
 public:
  explicit WordCheck(const DistanceField::Data& data)
      : data_(data), height_(data.children.size() / kCount, kFieldLevels) {
    for (std::size_t family = height_.size(); family-- > 0;) {
      int most = 0;
      for (std::size_t i = kCount * family; i < kCount * (family + 1); ++i)
        most = std::max(most, height(data.children[i], family + 1));
      height_[family] = most;
    }
  }
  /// How often a place under the word is halved; too often where a word is wrong.
  [[nodiscard]] int height(std::uint32_t word, std::size_t first_family = 0) const {
    if (word == 0) return 0;
    if ((word & 1) == 0) {
      const int span = static_cast<int>(word >> kFieldSpanAt);
      const bool fits = span <= (first_family == 0 ? DistanceField::kMaxSpan : 0);  // a child spans nothing but itself
      return fits && is_sound_leaf(data_, (word & kSlotMask) >> 1) ? 0 : kFieldLevels + 1;
    }
    const std::size_t at = word >> 1;
    if (at % kCount != 0 || at / kCount < first_family || at / kCount >= height_.size()) return kFieldLevels + 1;
    return height_[at / kCount] + 1;
  }

 private:
  static constexpr auto kCount = static_cast<std::size_t>(DistanceField::kChildren);
  const DistanceField::Data& data_;
  std::vector<int> height_;  // of eight children together
};

}  // namespace

std::uint32_t DistanceField::Plane::packed() const {
  constexpr std::uint32_t kSlopeMask = 127;
  const auto bits = [](int steps) { return static_cast<std::uint32_t>(steps) & kSlopeMask; };
  return static_cast<std::uint32_t>(value) << 21 | bits(slope[0]) << 14 | bits(slope[1]) << 7 | bits(slope[2]);
}

DistanceField::Plane DistanceField::Plane::unpacked(std::uint32_t word) {
  const auto from = [&](int left) { return static_cast<std::int32_t>(word << left) >> 25; };
  return {static_cast<std::int32_t>(word) >> 21, {from(11), from(18), from(25)}};
}

double DistanceField::Plane::at(const Vec3& p_B) const {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    sum += slope[i] * (p_B[static_cast<Eigen::Index>(i)] - 0.5);
  return static_cast<double>(kFieldValueStep) * value + static_cast<double>(kFieldSlopeStep) * sum;
}

DistanceField::Leaf DistanceField::Leaf::smooth(const std::array<double, 8>& corners, const Vec3& bubbles) {
  Leaf leaf;
  const double scale = quantise(corners, leaf.first, [&](std::size_t i, std::uint8_t value) { leaf.first[i] = value; });
  for (std::size_t i = 0; i < 3; ++i)
    leaf.first[8 + i] = steps(bubbles[static_cast<Eigen::Index>(i)], scale);
  return leaf;
}

DistanceField::Leaf DistanceField::Leaf::of_sheets(const Sheets& sheets) {
  Leaf leaf;
  leaf.has_sheets = true;
  std::vector<double> corners;
  for (std::size_t sheet = 0; sheet < static_cast<std::size_t>(sheets.count); ++sheet)
    corners.insert(corners.end(), sheets.values_m[sheet].begin(), sheets.values_m[sheet].end());
  quantise(corners, leaf.first, [&](std::size_t i, std::uint8_t value) {
    if (i < 8) {
      leaf.first[i] = value;
    } else {
      leaf.second[i - 8] = value;
    }
  });
  leaf.first[kFlagsAt] =
      static_cast<std::uint8_t>(kHasSheets | (sheets.count == 3 ? kHasThree : 0) |
                                (sheets.outer_convex ? kOuterConvex : 0) | (sheets.inner_convex ? kInnerConvex : 0));
  return leaf;
}

double DistanceField::Leaf::at(const Vec3& p_L) const {
  double value = between_corners(first.data(), p_L);
  const std::uint8_t flags = first[kFlagsAt];
  const auto either = [&](double a, double b, std::uint8_t convex) {
    return (flags & convex) != 0 ? std::max(a, b) : std::min(a, b);
  };
  if (has_sheets) {
    double rest = between_corners(second.data(), p_L);
    if ((flags & kHasThree) != 0) rest = either(rest, between_corners(&second[8], p_L), kInnerConvex);
    value = either(value, rest, kOuterConvex);
  } else {
    for (std::size_t i = 0; i < 3; ++i) {
      const double f = p_L[static_cast<Eigen::Index>(i)];
      value += signed_byte(first[8 + i]) * f * (1 - f);
    }
  }
  return static_cast<double>(whole(half_at(first, kBaseAt))) +
         static_cast<double>(whole(half_at(first, kScaleAt))) * value;
}

bool DistanceField::is_valid(const Data& data) {
  if (!DistanceBrick::is_valid(data.grid) || data.entries.size() != data.grid.block_count()) return false;
  if (data.slots.size() > kMaxSlots || data.slots.empty() || data.children.size() > kMaxSlots) return false;
  if (!(data.slack_m >= 0 && data.slack_m <= data.grid.block_m)) return false;
  const WordCheck check(data);
  return std::all_of(data.entries.begin(), data.entries.end(), [&](std::uint64_t entry) {
    return check.height(static_cast<std::uint32_t>(entry >> 32)) <= kFieldLevels;
  });
}

DistanceField::DistanceField(Data data) : data_(std::move(data)) {
  MECHANE_ASSERT(is_valid(data_));
}

std::size_t DistanceField::bytes() const {
  return std::span(data_.entries).size_bytes() + std::span(data_.children).size_bytes() +
         std::span(data_.slots).size_bytes();
}

FieldView DistanceField::view() const noexcept {
  const Grid& grid = data_.grid;
  const float inverse_block = 1 / grid.block_m;
  return {reinterpret_cast<const unsigned char*>(data_.entries.data()),
          data_.children.data(),
          data_.slots.data()->data(),
          grid.blocks,
          {grid.origin_Q.x(), grid.origin_Q.y(), grid.origin_Q.z()},
          inverse_block,
          grid.block_m,
          data_.slack_m * inverse_block,
          0};
}

BoxView DistanceField::box() const noexcept {
  return data_.grid.box();
}

MapHit DistanceField::evaluate(const Vec3f& p_QP) const noexcept {
  return evaluate_one(p_QP, view(), portable().field_inside, portable().field_depth);
}

}  // namespace mechane::collision
