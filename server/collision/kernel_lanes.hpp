// Vectors of floats for the kernels, and the functions that both kinds of map use. Compiled once for each instruction set, like everything
// that includes it: see kernel_body.hpp.
#pragma once

#include "server/collision/kernels.hpp"

// g++ warns that it passes vectors wider than the instruction set's in a way of its own; they are passed within this file only.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace mechane::collision {
namespace {

// The compilers' own vectors; their size must not depend on a template's parameter.
template <int Width>
struct VectorsOf;
template <>
struct VectorsOf<4> {
  typedef float F __attribute__((vector_size(16)));
  typedef int I __attribute__((vector_size(16)));
};
template <>
struct VectorsOf<8> {
  typedef float F __attribute__((vector_size(32)));
  typedef int I __attribute__((vector_size(32)));
};
template <>
struct VectorsOf<16> {
  typedef float F __attribute__((vector_size(64)));
  typedef int I __attribute__((vector_size(64)));
};

/// Lanes of `Width` floats. A class that derives from it may bring what its instruction set does better, to the same bits.
template <int Width>
struct PortableLanes {
  static constexpr int kWidth = Width;
  using F = typename VectorsOf<Width>::F;
  using I = typename VectorsOf<Width>::I;

  static F root(F x) {
    for (int i = 0; i < Width; ++i)
      x[i] = __builtin_sqrtf(x[i]);
    return x;
  }
  /// `condition` has all bits or none in each lane.
  static F select(I condition, F a, F b) {
    return reinterpret_cast<F>((condition & reinterpret_cast<I>(a)) | (~condition & reinterpret_cast<I>(b)));
  }
  /// a b + c, rounded once: the same bits on every machine, and one instruction where there is one.
  static F mad(F a, F b, F c) {
    for (int i = 0; i < Width; ++i)
      c[i] = __builtin_fmaf(a[i], b[i], c[i]);
    return c;
  }
  /// The lanes whose bit is set, moved together to the front; what follows them may be anything.
  template <class Vector>
  static Vector pack(Vector from, LaneMask lanes) {
    Vector out = from;
    for (int i = 0; lanes != 0; lanes &= lanes - 1)
      out[i++] = from[__builtin_ctz(lanes)];
    return out;
  }
  // Both give b where one of them is NaN, and where both are zeros.
  static F lesser(F a, F b) { return select(a < b, a, b); }
  static F greater(F a, F b) { return select(a > b, a, b); }
  /// For each lane the four bytes from table + Scale * index on, the first the lowest.
  template <int Scale>
  static I gather(const void* table, I index) {
    I out{};
    for (int i = 0; i < Width; ++i) {
      int four = 0;
      __builtin_memcpy(&four, static_cast<const char*>(table) + Scale * static_cast<long>(index[i]), sizeof four);
      out[i] = four;
    }
    return out;
  }
  static LaneMask mask_of(I condition) {
    LaneMask bits = 0;
    for (int i = 0; i < Width; ++i)
      bits |= (condition[i] != 0 ? 1U : 0U) << i;
    return bits;
  }
};

/// What both kinds of map share.
template <class Lanes>
struct KernelMath {
  using F = typename Lanes::F;
  using I = typename Lanes::I;
  static constexpr int kWidth = Lanes::kWidth;
  static constexpr LaneMask kAll = kWidth == 32 ? ~0U : (1U << kWidth) - 1;
  static constexpr float kTiny = 1e-20F;

  struct Point {
    F x, y, z;
  };

  static F all(float value) { return F{} + value; }
  static F select(I condition, F a, F b) { return Lanes::select(condition, a, b); }
  static F lesser(F a, F b) { return Lanes::lesser(a, b); }
  static F greater(F a, F b) { return Lanes::greater(a, b); }
  static F magnitude(F x) { return reinterpret_cast<F>(reinterpret_cast<I>(x) & 0x7fffffff); }
  static F sign_of(F x) { return select(x < 0.0F, all(-1), all(1)); }
  static I to_int(F x) { return __builtin_convertvector(x, I); }
  static F to_float(I x) { return __builtin_convertvector(x, F); }
  static F clamp(F x, float least, float most) { return lesser(greater(x, all(least)), all(most)); }
  static F dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

  static F load(const float* from, int at) {
    F out;
    __builtin_memcpy(&out, from + at, sizeof out);
    return out;
  }
  template <class Array>
  static void store(F value, Array& to, int at) {
    __builtin_memcpy(&to[static_cast<std::size_t>(at)], &value, sizeof value);
  }
  /// Four floats from each place that of_quad(k) points to, k from 0 to kWidth / 4.
  template <class Pointer>
  [[gnu::always_inline]] static F load_quads(const Pointer& of_quad) {
    using Four = typename VectorsOf<4>::F;
    const auto four = [&](int k) {
      Four out;
      __builtin_memcpy(&out, of_quad(k), sizeof out);
      return out;
    };
    if constexpr (kWidth == 4) {
      return four(0);
    } else {
      const auto eight = [&](int k) { return __builtin_shufflevector(four(k), four(k + 1), 0, 1, 2, 3, 4, 5, 6, 7); };
      if constexpr (kWidth == 8) {
        return eight(0);
      } else {
        return __builtin_shufflevector(eight(0), eight(2), 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
      }
    }
  }
  static Point load_points(const PointsView& points, int at) {
    return {load(points.x, at), load(points.y, at), load(points.z, at)};
  }
  static void store_points(const Point& p, PointBlock& block, int at) {
    store(p.x, block.x, at);
    store(p.y, block.y, at);
    store(p.z, block.z, at);
  }

  static Point transform(const BlockTransform& X, const Point& p) {
    const auto& r = X.R_BA;
    return {r[0] * p.x + r[1] * p.y + r[2] * p.z + X.p_BA[0], r[3] * p.x + r[4] * p.y + r[5] * p.z + X.p_BA[1],
            r[6] * p.x + r[7] * p.y + r[8] * p.z + X.p_BA[2]};
  }

  /// Squared distance to a box around the origin.
  static F outside_box(const Point& p, const std::array<float, 3>& half) {
    const Point out{greater(magnitude(p.x) - half[0], all(0)), greater(magnitude(p.y) - half[1], all(0)),
                    greater(magnitude(p.z) - half[2], all(0))};
    return dot(out, out);
  }
  static LaneMask first(std::size_t count) { return count >= kLanes ? 0xffffU : (1U << count) - 1; }
};

}  // namespace
}  // namespace mechane::collision
