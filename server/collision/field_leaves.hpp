// What the leaves of a DistanceField say, a vector of places at a time. See kernel_body.hpp.
#pragma once

#include "server/collision/kernel_lanes.hpp"

namespace mechane::collision {
namespace {

// Every product that is added to is a mad: rounded once, so that all instruction sets give the same bits.
template <class Lanes>
struct FieldLeaves : KernelMath<Lanes> {
  using Base = KernelMath<Lanes>;
  using Base::all;
  using Base::kWidth;
  using Base::load_quads;
  using Base::select;
  using Base::to_float;
  using typename Base::F;
  using typename Base::I;
  using typename Base::Point;

  static F mad(F a, F b, F c) { return Lanes::mad(a, b, c); }
  static F dot(const Point& a, const Point& b) { return mad(a.x, b.x, mad(a.y, b.y, a.z * b.z)); }

  /// A distance, not yet scaled, and its gradient.
  struct Slope {
    F value;
    Point g;
  };
  template <int Byte>
  static F byte_of(I four) {
    return to_float((four << (24 - 8 * Byte)) >> 24);
  }
  /// Trilinear between eight corners, x fastest, four to a word.
  [[gnu::always_inline]] static Slope trilinear(I low, I high, const Point& f) {
    const auto edge = [&](F from, F to, F& along) {
      along = to - from;
      return mad(along, f.x, from);
    };
    F d00, d10, d01, d11;
    const F x00 = edge(byte_of<0>(low), byte_of<1>(low), d00);
    const F x10 = edge(byte_of<2>(low), byte_of<3>(low), d10);
    const F x01 = edge(byte_of<0>(high), byte_of<1>(high), d01);
    const F x11 = edge(byte_of<2>(high), byte_of<3>(high), d11);
    const F e0 = x10 - x00;
    const F e1 = x11 - x01;
    const F y0 = mad(e0, f.y, x00);
    const F y1 = mad(e1, f.y, x01);
    const F ex0 = mad(d10 - d00, f.y, d00);
    const F ex1 = mad(d11 - d01, f.y, d01);
    return {mad(y1 - y0, f.z, y0), {mad(ex1 - ex0, f.z, ex0), mad(e1 - e0, f.z, e0), y1 - y0}};
  }
  /// q f (1 - f) along one axis.
  [[gnu::always_inline]] static void add_bubble(F q, F f, F& value, F& slope) {
    const F rise = q * f;
    value = mad(rise, 1.0F - f, value);
    slope = slope + (q - (rise + rise));
  }
  [[gnu::always_inline]] static void take(I holds, const Slope& other, Slope& s) {
    s.value = select(holds, other.value, s.value);
    s.g = {select(holds, other.g.x, s.g.x), select(holds, other.g.y, s.g.y), select(holds, other.g.z, s.g.z)};
  }
  struct Words {
    I w[4];
  };
  /// Sixteen bytes for each lane, as four words. Four lanes' words are read as rows of four and turned over.
  [[gnu::always_inline]] static Words read_slots(const unsigned char* slots, I at) {
    alignas(64) int offset[kWidth];
    __builtin_memcpy(offset, &at, sizeof offset);
    const auto row = [&](int j) {
      return load_quads([&](int k) { return reinterpret_cast<const float*>(slots + offset[4 * k + j]); });
    };
    const F r0 = row(0);
    const F r1 = row(1);
    const F r2 = row(2);
    const F r3 = row(3);
    const F a0 = mix<0, 1>(r0, r1);
    const F a1 = mix<2, 3>(r0, r1);
    const F a2 = mix<0, 1>(r2, r3);
    const F a3 = mix<2, 3>(r2, r3);
    return {{reinterpret_cast<I>(join<0>(a0, a2)), reinterpret_cast<I>(join<2>(a0, a2)),
             reinterpret_cast<I>(join<0>(a1, a3)), reinterpret_cast<I>(join<2>(a1, a3))}};
  }
  /// Of each four lanes: a[A], b[A], a[B], b[B].
  template <int A, int B>
  static F mix(F a, F b) {
    return shuffle(a, b,
                   [](int lane) { return (lane & ~3) + ((lane & 2) != 0 ? B : A) + (lane % 2 == 1 ? kWidth : 0); });
  }
  /// Of each four lanes: a[A], a[A + 1], b[A], b[A + 1].
  template <int A>
  static F join(F a, F b) {
    return shuffle(a, b, [](int lane) { return (lane & ~3) + A + (lane & 1) + ((lane & 2) != 0 ? kWidth : 0); });
  }
  template <class From>
  [[gnu::always_inline]] static F shuffle(F a, F b, From) {
    constexpr From kFrom{};
    if constexpr (kWidth == 4) {
      return __builtin_shufflevector(a, b, kFrom(0), kFrom(1), kFrom(2), kFrom(3));
    } else if constexpr (kWidth == 8) {
      return __builtin_shufflevector(a, b, kFrom(0), kFrom(1), kFrom(2), kFrom(3), kFrom(4), kFrom(5), kFrom(6),
                                     kFrom(7));
    } else {
      return __builtin_shufflevector(a, b, kFrom(0), kFrom(1), kFrom(2), kFrom(3), kFrom(4), kFrom(5), kFrom(6),
                                     kFrom(7), kFrom(8), kFrom(9), kFrom(10), kFrom(11), kFrom(12), kFrom(13),
                                     kFrom(14), kFrom(15));
    }
  }

  /// What the leaf says at f: the distance in blocks, and its gradient in some unit. See DistanceField::Leaf for the bytes.
  [[gnu::always_inline]] static Slope told(const FieldView& map, I leaf, const Point& f) {
    const I at = (leaf << 3) & ((1 << (kFieldSpanAt + 3)) - 16);  // sixteen bytes for each; without the span
    const Words slot = read_slots(map.slots, at);
    Slope s = trilinear(slot.w[0], slot.w[1], f);
    add_bubble(byte_of<0>(slot.w[2]), f.x, s.value, s.g.x);  // none where there are sheets
    add_bubble(byte_of<1>(slot.w[2]), f.y, s.value, s.g.y);
    add_bubble(byte_of<2>(slot.w[2]), f.z, s.value, s.g.z);
    const auto has = [&](int flag) { return (slot.w[2] & flag << 24) != 0; };
    const I sheets = has(1);
    if (Lanes::mask_of(sheets) != 0) {
      const Words second = read_slots(map.slots, at + (sheets & 16));
      Slope rest = trilinear(second.w[0], second.w[1], f);
      const I three = has(2);
      if (Lanes::mask_of(three) != 0) {
        const Slope third = trilinear(second.w[2], second.w[3], f);
        take(three & (has(8) ^ (third.value < rest.value)), third, rest);
      }
      take(sheets & (has(4) ^ (rest.value < s.value)), rest, s);
    }
    const F scale = reinterpret_cast<F>(slot.w[3] << 16);
    const F base = reinterpret_cast<F>(slot.w[3] & ~0xffff);
    s.value = mad(s.value, scale, base);
    return s;
  }
  static Point unit(const Point& g) {
    const F square = dot(g, g);
    const I sound = square > 0.0F;  // on a medial axis every direction leads out: take z
    const F inverse = 1.0F / Lanes::root(select(sound, square, all(1)));
    return {select(sound, g.x * inverse, all(0)), select(sound, g.y * inverse, all(0)),
            select(sound, g.z * inverse, all(1))};
  }
  static F depth_of(const FieldView& map, const Slope& s) { return s.value * -map.block_m; }
};

}  // namespace
}  // namespace mechane::collision
