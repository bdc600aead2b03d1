#include "server/collision/placed_part.hpp"

namespace mechane::collision {

void PlacedPart::place(const Part& source, std::uint16_t source_index, const Pose& X_QS_exact) noexcept {
  const Mat3 R = X_QS_exact.R.toRotationMatrix();
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 3; ++column)
      X_QS.R_BA[static_cast<std::size_t>(3 * row + column)] = static_cast<float>(R(row, column));
    X_QS.p_BA[static_cast<std::size_t>(row)] = static_cast<float>(X_QS_exact.p[row]);
  }
  part = &source;
  index = source_index;
  const RadialMap* map = source.map.radial();
  is_radial = map != nullptr;
  if (is_radial) {
    radial = map->view();
  } else {
    brick = source.map.brick()->view();
  }
}

}  // namespace mechane::collision
