// Which things of a scene stand still: told by their poses alone, picture by picture.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>

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

class Stillness {
 public:
  /// Takes the things of the next picture.
  void see(std::span<const picture::Instance> instances);
  /// In how many pictures in a row, up to the last, such a thing has been there; 0: it was not in the last one.
  [[nodiscard]] std::uint32_t pictures(const InstanceKey& key) const;
  void forget() { seen_.clear(); }

 private:
  std::map<InstanceKey, std::uint32_t> seen_;
};

}  // namespace mechane::draw
