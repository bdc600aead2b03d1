// Which things of a scene stand still, and which fires burn evenly: told by their numbers alone, picture by picture.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include "client-sdk/picture/scene_parts.hpp"

namespace mechane::draw {

/// All of an instance that its picture and its shadow depend on, to the bit.
struct InstanceKey {
  std::uint32_t mesh = 0;
  std::uint32_t material = 0;
  bool casts_shadow = true;
  std::array<std::uint32_t, 16> X_WM{};

  explicit InstanceKey(const picture::Instance& instance);
  [[nodiscard]] Eigen::Affine3f pose() const;
  friend bool operator==(const InstanceKey&, const InstanceKey&) = default;
  friend bool operator<(const InstanceKey& a, const InstanceKey& b) {
    return std::tie(a.mesh, a.material, a.casts_shadow, a.X_WM) < std::tie(b.mesh, b.material, b.casts_shadow, b.X_WM);
  }
};

/// All of a fire that its light on what stands still depends on.
struct FireKey {
  std::array<float, 3> p_W{};
  float size_m = 0;
  float intensity = 0;

  explicit FireKey(const picture::ParticleEffect& fire);
  friend bool operator<(const FireKey& a, const FireKey& b) {
    return std::tie(a.p_W, a.size_m, a.intensity) < std::tie(b.p_W, b.size_m, b.intensity);
  }
};

/// Key: of a thing that can be made of it.
template <class Key>
class Stillness {
 public:
  /// Takes the things of the next picture.
  template <class Thing>
  void see(std::span<const Thing> things) {
    std::map<Key, std::uint32_t> now;
    for (const Thing& thing : things) {
      const Key key(thing);
      now.try_emplace(key, pictures(key) + 1);
    }
    seen_ = std::move(now);
  }
  /// In how many pictures in a row, up to the last, such a thing has been there; 0: it was not in the last one.
  [[nodiscard]] std::uint32_t pictures(const Key& key) const {
    const auto seen = seen_.find(key);
    return seen == seen_.end() ? 0 : seen->second;
  }
  void forget() { seen_.clear(); }

 private:
  std::map<Key, std::uint32_t> seen_;
};

}  // namespace mechane::draw
