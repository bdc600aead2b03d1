#include "server/collision/part_map.hpp"

namespace mechane::collision {
namespace {

std::string blocks_of(const DistanceBrick::Grid& grid) {
  const auto& n = grid.blocks;
  return std::to_string(n[0]) + "x" + std::to_string(n[1]) + "x" + std::to_string(n[2]);
}

}  // namespace

MapHit PartMap::evaluate(const Vec3f& p_QP) const noexcept {
  if (const RadialMap* map = radial()) return map->evaluate(p_QP);
  if (const DistanceBrick* map = brick()) return map->evaluate(p_QP);
  if (const DistanceField* map = field()) return map->evaluate(p_QP);
  return {};
}

BoxView PartMap::box() const noexcept {
  if (const RadialMap* map = radial()) return map->box();
  if (const DistanceBrick* map = brick()) return map->box();
  if (const DistanceField* map = field()) return map->box();
  return {{0, 0, 0}, {0, 0, 0}};
}

std::string PartMap::name() const {
  if (const RadialMap* map = radial()) return "radial " + std::to_string(map->resolution());
  if (const DistanceBrick* map = brick()) return "brick " + blocks_of(map->grid());
  if (const DistanceField* map = field()) return "field " + blocks_of(map->grid());
  return "none";
}

std::size_t PartMap::bytes() const noexcept {
  if (const RadialMap* map = radial()) return map->texels().size_bytes();
  if (const DistanceBrick* map = brick()) return map->bytes();
  if (const DistanceField* map = field()) return map->bytes();
  return 0;
}

}  // namespace mechane::collision
