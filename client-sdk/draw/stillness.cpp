#include "client-sdk/draw/stillness.hpp"

#include <bit>

namespace mechane::draw {

InstanceKey::InstanceKey(const picture::Instance& instance)
    : mesh(instance.mesh), material(instance.material), casts_shadow(instance.casts_shadow) {
  for (Eigen::Index i = 0; i < 16; ++i)
    X_WM[static_cast<std::size_t>(i)] = std::bit_cast<std::uint32_t>(instance.X_WM.matrix()(i));
}

Eigen::Affine3f InstanceKey::pose() const {
  Eigen::Affine3f out;
  for (Eigen::Index i = 0; i < 16; ++i)
    out.matrix()(i) = std::bit_cast<float>(X_WM[static_cast<std::size_t>(i)]);
  return out;
}

FireKey::FireKey(const picture::ParticleEffect& fire)
    : p_W{fire.p_W.x(), fire.p_W.y(), fire.p_W.z()}, size_m(fire.size_m), intensity(fire.intensity) {}

}  // namespace mechane::draw
