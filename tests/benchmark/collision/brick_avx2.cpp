// The brick's kernel, eight points or spheres at a time.
#include <cstring>

#include "tests/benchmark/collision/brick_grid.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace mechane::benchmark {

#if defined(__x86_64__)

#define MECHANE_AVX2 __attribute__((target("avx2,fma,bmi2")))
#define MECHANE_AVX2_INLINE __attribute__((target("avx2,fma,bmi2"), always_inline)) inline

namespace {

struct Vec8 {
  __m256 x, y, z;
};

/// What a query needs of the grid, in registers or close by. Plain arrays: std::array would drop the vectors' alignment.
struct Constants {
  __m256 to_G[3][4];            // rows of A_GW and b_GW
  __m256 top[3], last_cell[3];  // of each axis: the last node, the last cell
  __m256 nx, nxy;
  const int* values;
  int row, layer;
};

MECHANE_AVX2_INLINE Constants constants_of(const BrickGrid& grid) {
  Constants c;
  for (int i = 0; i < 3; ++i) {
    const auto a = static_cast<std::size_t>(i);
    for (int j = 0; j < 3; ++j)
      c.to_G[a][static_cast<std::size_t>(j)] = _mm256_set1_ps(grid.A_GW(i, j));
    c.to_G[a][3] = _mm256_set1_ps(grid.b_GW[i]);
    c.top[a] = _mm256_set1_ps(static_cast<float>(grid.nodes[a] - 1));
    c.last_cell[a] = _mm256_set1_ps(static_cast<float>(grid.nodes[a] - 2));
  }
  c.row = grid.nodes[0];
  c.layer = grid.nodes[0] * grid.nodes[1];
  c.nx = _mm256_set1_ps(static_cast<float>(c.row));
  c.nxy = _mm256_set1_ps(static_cast<float>(c.layer));
  c.values = reinterpret_cast<const int*>(grid.values.data());
  return c;
}

MECHANE_AVX2_INLINE Vec8 to_grid(const Constants& c, __m256 x, __m256 y, __m256 z) {
  const auto row = [&](std::size_t i) MECHANE_AVX2 {
    const __m256* m = c.to_G[i];
    return _mm256_fmadd_ps(m[0], x, _mm256_fmadd_ps(m[1], y, _mm256_fmadd_ps(m[2], z, m[3])));
  };
  return {row(0), row(1), row(2)};
}

MECHANE_AVX2_INLINE Vec8 clamp_to_box(const Constants& c, const Vec8& p) {
  const __m256 zero = _mm256_setzero_ps();
  return {_mm256_min_ps(_mm256_max_ps(p.x, zero), c.top[0]), _mm256_min_ps(_mm256_max_ps(p.y, zero), c.top[1]),
          _mm256_min_ps(_mm256_max_ps(p.z, zero), c.top[2])};
}

/// The eight corners around each point, as they were interpolated.
struct Corners {
  __m256 fx, fy, fz;
  __m256 slope[4];        // along x, of the four rows
  __m256 along0, along1;  // along y, of the two layers
  __m256 rise;            // along z
  __m256 value;           // in units of the 16-bit values
};

/// `q` must lie in the box. Two neighbours along x come with one read of 32 bits.
MECHANE_AVX2_INLINE Corners look_up(const Constants& c, const Vec8& q) {
  constexpr int kTruncate = _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC;
  const __m256 ix = _mm256_min_ps(_mm256_round_ps(q.x, kTruncate), c.last_cell[0]);
  const __m256 iy = _mm256_min_ps(_mm256_round_ps(q.y, kTruncate), c.last_cell[1]);
  const __m256 iz = _mm256_min_ps(_mm256_round_ps(q.z, kTruncate), c.last_cell[2]);
  // Exact in float: a brick has fewer than 2^24 nodes.
  const __m256i at = _mm256_cvtps_epi32(_mm256_fmadd_ps(iz, c.nxy, _mm256_fmadd_ps(iy, c.nx, ix)));
  Corners k;
  k.fx = _mm256_sub_ps(q.x, ix);
  k.fy = _mm256_sub_ps(q.y, iy);
  k.fz = _mm256_sub_ps(q.z, iz);
  const std::array<int, 4> shift = {0, c.row, c.layer, c.layer + c.row};
  __m256 row[4];
  for (std::size_t r = 0; r < 4; ++r) {
    const __m256i index = _mm256_add_epi32(at, _mm256_set1_epi32(shift[r]));
    const __m256i pair = _mm256_i32gather_epi32(c.values, index, 2);
    const __m256 low = _mm256_cvtepi32_ps(_mm256_srai_epi32(_mm256_slli_epi32(pair, 16), 16));
    const __m256 high = _mm256_cvtepi32_ps(_mm256_srai_epi32(pair, 16));
    k.slope[r] = _mm256_sub_ps(high, low);
    row[r] = _mm256_fmadd_ps(k.fx, k.slope[r], low);
  }
  k.along0 = _mm256_sub_ps(row[1], row[0]);
  k.along1 = _mm256_sub_ps(row[3], row[2]);
  const __m256 near = _mm256_fmadd_ps(k.fy, k.along0, row[0]);
  const __m256 far = _mm256_fmadd_ps(k.fy, k.along1, row[2]);
  k.rise = _mm256_sub_ps(far, near);
  k.value = _mm256_fmadd_ps(k.fz, k.rise, near);
  return k;
}

MECHANE_AVX2_INLINE Vec8 gradient(const Corners& k) {
  const __m256 slope0 = _mm256_fmadd_ps(k.fy, _mm256_sub_ps(k.slope[1], k.slope[0]), k.slope[0]);
  const __m256 slope1 = _mm256_fmadd_ps(k.fy, _mm256_sub_ps(k.slope[3], k.slope[2]), k.slope[2]);
  return {_mm256_fmadd_ps(k.fz, _mm256_sub_ps(slope1, slope0), slope0),
          _mm256_fmadd_ps(k.fz, _mm256_sub_ps(k.along1, k.along0), k.along0), k.rise};
}

/// One bit for each sphere that may touch what is inside; brick_reaches, eight times. `units`: 16-bit units in cells.
MECHANE_AVX2_INLINE unsigned reached(const Constants& c, __m256 per_cell, __m256 units, const float* x, const float* y,
                                     const float* z, const float* r, float slack = kBrickSlack) {
  const Vec8 p = to_grid(c, _mm256_load_ps(x), _mm256_load_ps(y), _mm256_load_ps(z));
  const Vec8 q = clamp_to_box(c, p);
  const __m256 dx = _mm256_sub_ps(p.x, q.x);
  const __m256 dy = _mm256_sub_ps(p.y, q.y);
  const __m256 dz = _mm256_sub_ps(p.z, q.z);
  const __m256 aside = _mm256_fmadd_ps(dx, dx, _mm256_fmadd_ps(dy, dy, _mm256_mul_ps(dz, dz)));
  const __m256 reach = _mm256_fmadd_ps(_mm256_load_ps(r), per_cell, _mm256_set1_ps(slack));
  const __m256 square = _mm256_mul_ps(reach, reach);
  const auto close = static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(aside, square, _CMP_LE_OQ)));
  if (close == 0) return 0;
  const __m256 ahead = _mm256_max_ps(_mm256_mul_ps(look_up(c, q).value, units), _mm256_setzero_ps());
  const __m256 whole = _mm256_fmadd_ps(ahead, ahead, aside);
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(whole, square, _CMP_LE_OQ)));
}

/// The lanes of `mask`, moved together to the front.
MECHANE_AVX2_INLINE __m256i front_lanes(unsigned mask) {
  const std::uint64_t bytes = _pdep_u64(mask, 0x0101010101010101ULL) * 0xFF;
  const std::uint64_t lanes = _pext_u64(0x0706050403020100ULL, bytes);
  return _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(lanes)));
}

/// number_of(lanes): the points' numbers.
template <class Number>
MECHANE_AVX2_INLINE void store(const BrickGrid& grid, const Corners& k, unsigned inside, const Number& number_of,
                               Hits& out) {
  const Vec8 g = gradient(k);
  const __m256 length = _mm256_sqrt_ps(_mm256_fmadd_ps(g.x, g.x, _mm256_fmadd_ps(g.y, g.y, _mm256_mul_ps(g.z, g.z))));
  const __m256 scale = _mm256_div_ps(_mm256_set1_ps(1), _mm256_max_ps(length, _mm256_set1_ps(1e-30F)));
  const auto row = [&](int i) MECHANE_AVX2 {
    const __m256 sum = _mm256_fmadd_ps(
        _mm256_set1_ps(grid.R_WO(i, 0)), g.x,
        _mm256_fmadd_ps(_mm256_set1_ps(grid.R_WO(i, 1)), g.y, _mm256_mul_ps(_mm256_set1_ps(grid.R_WO(i, 2)), g.z)));
    return _mm256_mul_ps(sum, scale);
  };
  const __m256i lanes = front_lanes(inside);
  const auto put = [&](float* to, __m256 v) MECHANE_AVX2 { _mm256_storeu_ps(to, _mm256_permutevar8x32_ps(v, lanes)); };
  const std::size_t at = out.count;
  put(&out.depth_m[at], _mm256_mul_ps(k.value, _mm256_set1_ps(-grid.step_m)));
  put(&out.n_x[at], row(0));
  put(&out.n_y[at], row(1));
  put(&out.n_z[at], row(2));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(&out.point[at]), number_of(lanes));
  out.count = at + static_cast<std::size_t>(__builtin_popcount(inside));
}

template <class Number>
MECHANE_AVX2_INLINE void query_points(const BrickGrid& grid, const Constants& c, const Vec8& p, const Number& number_of,
                                      Hits& out) {
  const Vec8 q = clamp_to_box(c, p);
  const __m256 in_box =
      _mm256_and_ps(_mm256_and_ps(_mm256_cmp_ps(p.x, q.x, _CMP_EQ_OQ), _mm256_cmp_ps(p.y, q.y, _CMP_EQ_OQ)),
                    _mm256_cmp_ps(p.z, q.z, _CMP_EQ_OQ));
  if (_mm256_testz_ps(in_box, in_box) != 0) return;
  const Corners k = look_up(c, q);
  const auto inside = static_cast<unsigned>(
      _mm256_movemask_ps(_mm256_and_ps(in_box, _mm256_cmp_ps(k.value, _mm256_setzero_ps(), _CMP_LT_OQ))));
  if (inside != 0 && out.count + 8 <= Hits::kRoom) store(grid, k, inside, number_of, out);
}

MECHANE_AVX2_INLINE void query_eight(const BrickGrid& grid, const Constants& c, const HandStep& hand, std::size_t first,
                                     Hits& out) {
  const Vec8 p =
      to_grid(c, _mm256_load_ps(&hand.x[first]), _mm256_load_ps(&hand.y[first]), _mm256_load_ps(&hand.z[first]));
  const auto number_of = [first](__m256i lanes) MECHANE_AVX2 {
    return _mm256_add_epi32(lanes, _mm256_set1_epi32(static_cast<int>(first)));
  };
  query_points(grid, c, p, number_of, out);
}

/// Two quads.
MECHANE_AVX2_INLINE void query_quads(const BrickGrid& grid, const Constants& c, const HandStep& hand, std::size_t a,
                                     std::size_t b, Hits& out) {
  const auto both = [&](const auto& of) MECHANE_AVX2 {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(&of[4 * a])), _mm_load_ps(&of[4 * b]), 1);
  };
  const auto first_a = static_cast<int>(4 * a);
  const auto first_b = static_cast<int>(4 * b);
  const __m256i numbers =
      _mm256_setr_epi32(first_a, first_a + 1, first_a + 2, first_a + 3, first_b, first_b + 1, first_b + 2, first_b + 3);
  query_points(
      grid, c, to_grid(c, both(hand.x), both(hand.y), both(hand.z)),
      [&](__m256i lanes) MECHANE_AVX2 { return _mm256_permutevar8x32_epi32(numbers, lanes); }, out);
}

/// The quads within reach and the margin, segment by segment and cluster by cluster.
MECHANE_AVX2_INLINE void find_quads(const BrickGrid& grid, const Constants& c, const HandStep& hand, BrickList& list) {
  const __m256 per_cell = _mm256_set1_ps(1 / grid.cell_m);
  const __m256 units = _mm256_set1_ps(grid.step_m / grid.cell_m);
  const float slack = kBrickSlack + collision::NearList::kMargin_m / grid.cell_m;
  list.count = 0;
  unsigned segments = 0;
  for (std::size_t s = 0; s < kSegments; s += 8)
    segments |= reached(c, per_cell, units, &hand.segment_x[s], &hand.segment_y[s], &hand.segment_z[s],
                        &hand.segment_r[s], slack)
                << s;
  for (; segments != 0; segments &= segments - 1) {
    const std::size_t first = kSegmentClusters * static_cast<std::size_t>(__builtin_ctz(segments));
    const unsigned clusters = reached(c, per_cell, units, &hand.cluster_x[first], &hand.cluster_y[first],
                                      &hand.cluster_z[first], &hand.cluster_r[first], slack);
    for (std::size_t pair = 0; pair < kSegmentClusters; pair += 2) {
      const unsigned two = clusters >> pair & 3U;
      if (two == 0) continue;
      const std::size_t quad = 4 * (first + pair);
      const unsigned wanted = (two & 1U) * 0xfU | (two >> 1U) * 0xf0U;
      unsigned quads = wanted & reached(c, per_cell, units, &hand.quad_x[quad], &hand.quad_y[quad], &hand.quad_z[quad],
                                        &hand.quad_r[quad], slack);
      for (; quads != 0; quads &= quads - 1)
        list.quads[list.count++] = static_cast<std::uint32_t>(quad) + static_cast<unsigned>(__builtin_ctz(quads));
    }
  }
}

}  // namespace

bool brick_has_avx2() noexcept {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
}

MECHANE_AVX2 void query_brick_avx2(const BrickGrid& grid, std::size_t object, const HandStep& hand,
                                   Hits& out) noexcept {
  if (!brick_reaches(grid, grid.A_GW * hand.center + grid.b_GW, hand.radius)) return;
  const Constants c = constants_of(grid);
  const __m256 per_cell = _mm256_set1_ps(1 / grid.cell_m);
  const __m256 units = _mm256_set1_ps(grid.step_m / grid.cell_m);
  const std::size_t before = out.count;
  unsigned segments = 0;
  for (std::size_t s = 0; s < kSegments; s += 8)
    segments |=
        reached(c, per_cell, units, &hand.segment_x[s], &hand.segment_y[s], &hand.segment_z[s], &hand.segment_r[s])
        << s;
  for (; segments != 0; segments &= segments - 1) {
    static_assert(kSegmentClusters == 8 && kClusterPoints == 16);
    const std::size_t first = kSegmentClusters * static_cast<std::size_t>(__builtin_ctz(segments));
    unsigned clusters = reached(c, per_cell, units, &hand.cluster_x[first], &hand.cluster_y[first],
                                &hand.cluster_z[first], &hand.cluster_r[first]);
    for (; clusters != 0; clusters &= clusters - 1) {
      const std::size_t point = kClusterPoints * (first + static_cast<std::size_t>(__builtin_ctz(clusters)));
      query_eight(grid, c, hand, point, out);
      query_eight(grid, c, hand, point + 8, out);
    }
  }
  std::memset(&out.object[before], static_cast<int>(object), out.count - before);
}

MECHANE_AVX2 void query_brick_lists_avx2(const BrickGrid& grid, std::size_t object, const HandStep& hand,
                                         BrickList& list, Hits& out) noexcept {
  if (!brick_reaches(grid, grid.A_GW * hand.center + grid.b_GW, hand.radius)) return;
  const Constants c = constants_of(grid);
  if (!list.still_holds(hand)) {
    list.remember(hand);
    find_quads(grid, c, hand, list);
  }
  const std::size_t before = out.count;
  std::size_t i = 0;
  for (; i + 1 < list.count; i += 2)
    query_quads(grid, c, hand, list.quads[i], list.quads[i + 1], out);
  if (i < list.count) {  // an odd one, with lanes that lie nowhere
    const __m256 far = _mm256_set1_ps(1e9F);
    const std::size_t first = 4 * std::size_t{list.quads[i]};
    const auto one = [&](const auto& of) MECHANE_AVX2 { return _mm256_insertf128_ps(far, _mm_load_ps(&of[first]), 0); };
    query_points(
        grid, c, to_grid(c, one(hand.x), one(hand.y), one(hand.z)),
        [&](__m256i lanes) MECHANE_AVX2 { return _mm256_add_epi32(lanes, _mm256_set1_epi32(static_cast<int>(first))); },
        out);
  }
  std::memset(&out.object[before], static_cast<int>(object), out.count - before);
}

#else

void query_brick_lists_avx2(const BrickGrid& grid, std::size_t object, const HandStep& hand, BrickList&,
                            Hits& out) noexcept {
  query_brick_scalar(grid, object, hand, out);
}

bool brick_has_avx2() noexcept {
  return false;
}

void query_brick_avx2(const BrickGrid& grid, std::size_t object, const HandStep& hand, Hits& out) noexcept {
  query_brick_scalar(grid, object, hand, out);
}

#endif

}  // namespace mechane::benchmark
