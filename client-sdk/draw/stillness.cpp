#include "client-sdk/draw/stillness.hpp"

#include <bit>
#include <utility>

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

void Stillness::see(std::span<const picture::Instance> instances) {
  std::map<InstanceKey, std::uint32_t> now;
  for (const picture::Instance& instance : instances) {
    const InstanceKey key(instance);
    now.try_emplace(key, pictures(key) + 1);
  }
  seen_ = std::move(now);
}

std::uint32_t Stillness::pictures(const InstanceKey& key) const {
  const auto seen = seen_.find(key);
  return seen == seen_.end() ? 0 : seen->second;
}

}  // namespace mechane::draw
