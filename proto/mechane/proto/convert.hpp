// Converts between wire types (float32 arrays, C sequences) and our own. Reading checks only pointers; validators check values.
#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "server/base/math.hpp"
#include <mechane/proto/names.hpp>
#include <mechane/proto/topics.hpp>

namespace mechane::proto {

[[nodiscard]] inline Vec3 to_vec3(const float (&v)[3]) noexcept {
  return {v[0], v[1], v[2]};
}
inline void set_vec3(float (&out)[3], const Vec3& v) noexcept {
  for (int i = 0; i < 3; ++i)
    out[i] = static_cast<float>(v[i]);
}

/// Does not check or scale the quaternion: see normalise().
[[nodiscard]] inline Pose to_pose(const WirePose& w) noexcept {
  return {to_vec3(w.p), Quat(w.q[0], w.q[1], w.q[2], w.q[3])};
}
inline void set_pose(WirePose& out, const Pose& X) noexcept {
  set_vec3(out.p, X.p);
  const double q[4] = {X.R.w(), X.R.x(), X.R.y(), X.R.z()};
  for (int i = 0; i < 4; ++i)
    out.q[i] = static_cast<float>(q[i]);
}

template <std::size_t N>
[[nodiscard]] bool all_finite(const float (&values)[N]) noexcept {
  for (const float v : values) {
    if (!std::isfinite(v)) return false;
  }
  return true;
}
[[nodiscard]] inline bool all_finite(const WirePose& w) noexcept {
  return all_finite(w.p) && all_finite(w.q);
}

/// Scales the rotation to unit length. False, and X unchanged, where its length is more than 1 % away from 1.
[[nodiscard]] inline bool normalise(Pose& X) noexcept {
  const double norm = X.R.norm();
  if (!(norm > 0.99 && norm < 1.01)) return false;
  X.R.coeffs() /= norm;
  return true;
}

/// The elements of a wire sequence; empty where its buffer is null.
template <class Sequence>
[[nodiscard]] auto elements(const Sequence& sequence) noexcept {
  using Element = std::remove_pointer_t<decltype(sequence._buffer)>;
  return std::span<Element>(sequence._buffer, sequence._buffer == nullptr ? 0 : sequence._length);
}

/// Lets a wire sequence point at the elements of a vector, which must outlive it and not grow meanwhile.
template <class Sequence, class Element>
void look_into(Sequence& sequence, std::vector<Element>& storage) noexcept {
  sequence._buffer = storage.data();
  sequence._length = sequence._maximum = static_cast<std::uint32_t>(storage.size());
  sequence._release = false;
}

/// Lets a wire string point at the characters of a std::string, which must outlive it. DDS only reads them.
[[nodiscard]] inline char* look_into(const std::string& text) noexcept {
  return const_cast<char*>(text.c_str());
}

/// Pointers to the texts of a vector of strings, for a sequence<string>.
[[nodiscard]] inline std::vector<char*> pointers_to(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size());
  for (const std::string& text : texts)
    pointers.push_back(look_into(text));
  return pointers;
}

}  // namespace mechane::proto
