#include "server/state/surface_keys.hpp"

#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::state {
namespace {

using Written = std::map<std::string_view, std::vector<double>>;

struct Changed {
  HapticMaterial surface;
  std::vector<SurfaceFault> faults;
};

Changed changed(const HapticMaterial& own, const Written& written) {
  Changed out;
  const auto look_up = [&](std::string_view key) {
    const auto found = written.find(key);
    return found == written.end() ? std::vector<double>() : found->second;
  };
  out.surface = changed_surface(own, look_up, out.faults);
  return out;
}

HapticMaterial ribbed() {
  HapticMaterial material;
  material.groove_depth_m = 5e-5;
  material.groove_wave_B = Vec3(0, 0, 2 * kPi / 0.004);
  return material;
}

/// The fields that one number writes, by its key.
std::map<std::string_view, double> numbers_of(const HapticMaterial& m) {
  return {{"stiffness", m.stiffness_n_per_m},    {"damping", m.damping_ns_per_m},
          {"staticFriction", m.static_friction}, {"dynamicFriction", m.dynamic_friction},
          {"viscosity", m.viscosity_ns_per_m},   {"knock", m.knock_ns_per_m},
          {"grooveDepth", m.groove_depth_m}};
}

TEST(SurfaceKeys, DefaultsOfTheTableAreThoseOfAMaterial) {
  for (const auto& [key, value] : numbers_of(HapticMaterial{}))
    EXPECT_EQ(surface_key(key).default_value, value) << key;
}

RC_GTEST_PROP(SurfaceKeys, WhatIsWrittenIsChangedAndNothingElse, ()) {
  const HapticMaterial own = ribbed();
  std::map<std::string_view, double> expected = numbers_of(own);
  Written written;
  for (auto& [name, value] : expected) {
    if (!*rc::gen::arbitrary<bool>()) continue;
    const ParameterType& key = surface_key(name);
    value = key.min + 0.01 * *rc::gen::inRange(0, 101) * (key.max - key.min);
    written[name] = {value};
  }
  const Changed out = changed(own, written);
  RC_ASSERT(numbers_of(out.surface) == expected);
  std::set<std::string_view> faulty;
  for (const SurfaceFault& fault : out.faults)
    faulty.insert(fault.key);
  RC_ASSERT(faulty.contains("dynamicFriction") == (expected["dynamicFriction"] > expected["staticFriction"]));
  const double wave_rad_per_m = own.groove_wave_B.norm();
  RC_ASSERT(faulty.contains("grooveDepth") == !hand::are_renderable(expected["grooveDepth"], wave_rad_per_m));
  RC_ASSERT(out.surface.groove_wave_B == (expected["grooveDepth"] > 0 ? own.groove_wave_B : Vec3(Vec3::Zero())));
}

TEST(SurfaceKeys, GroovesKeepWhatOfThemIsNotWritten) {
  const Vec3 own_B = ribbed().groove_wave_B;
  EXPECT_LT((changed(ribbed(), {{"grooveDistance", {0.008}}}).surface.groove_wave_B - own_B / 2).norm(), 1e-9);
  const Vec3 turned_B = changed(ribbed(), {{"grooveDirection", {3, 0, 0}}}).surface.groove_wave_B;
  EXPECT_LT((turned_B - own_B.norm() * Vec3::UnitX()).norm(), 1e-9);
  const Changed bare = changed({}, {{"grooveDepth", {5e-5}}});
  ASSERT_EQ(bare.faults.size(), 1u);
  EXPECT_EQ(bare.faults[0].code, ErrorCode::missing);
  EXPECT_THAT(bare.faults[0].remedy, ::testing::HasSubstr("grooveDirection"));
}

}  // namespace
}  // namespace mechane::state
