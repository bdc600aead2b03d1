// The corners of a box, to be moved or projected one by one.
#pragma once

#include <array>

#include <Eigen/Geometry>

namespace mechane::picture {

/// The eight corners of `box`, which is not empty: x changes fastest, z slowest, each from least to greatest.
template <class Scalar>
[[nodiscard]] std::array<Eigen::Matrix<Scalar, 3, 1>, 8> corners_of(const Eigen::AlignedBox<Scalar, 3>& box) {
  using Box = Eigen::AlignedBox<Scalar, 3>;
  std::array<Eigen::Matrix<Scalar, 3, 1>, 8> corners;
  for (int i = 0; i < 8; ++i)
    corners[static_cast<std::size_t>(i)] = box.corner(static_cast<typename Box::CornerType>(i));
  return corners;
}

/// The box around `box` moved by `X`; of an empty box, an empty one.
template <class Scalar, class Transform>
[[nodiscard]] Eigen::AlignedBox<Scalar, 3> moved(const Eigen::AlignedBox<Scalar, 3>& box, const Transform& X) {
  Eigen::AlignedBox<Scalar, 3> out;
  if (box.isEmpty()) return out;
  for (const Eigen::Matrix<Scalar, 3, 1>& p : corners_of(box))
    out.extend(Eigen::Matrix<Scalar, 3, 1>(X * p));
  return out;
}

}  // namespace mechane::picture
