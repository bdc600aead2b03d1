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
  if (const RadialMap* map = source.map.radial()) {
    kind = Kind::radial;
    radial = map->view();
  } else if (const DistanceBrick* other = source.map.brick()) {
    kind = Kind::brick;
    brick = other->view();
  } else {
    kind = Kind::field;
    field = source.map.field()->view();
    X_BS = X_QS;
    for (std::size_t i = 0; i < 3; ++i) {
      X_BS.p_BA[i] = (X_QS.p_BA[i] - field.origin[i]) * field.inverse_block;
      for (std::size_t j = 3 * i; j < 3 * i + 3; ++j)
        X_BS.R_BA[j] = X_QS.R_BA[j] * field.inverse_block;
    }
  }
}

}  // namespace mechane::collision
