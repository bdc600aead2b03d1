#include "server/state/surface_keys.hpp"

#include <cmath>

#include <fmt/format.h>

namespace mechane::state {
namespace {

void change(const WrittenKeys& written, std::string_view key, double& value) {
  if (const std::vector<double> numbers = written(key); !numbers.empty()) value = numbers.front();
}

/// 2 pi over the distance of the grooves, across them; zero where there are none.
Vec3 groove_wave_B(const HapticMaterial& own, double depth_m, const WrittenKeys& written,
                   std::vector<SurfaceFault>& faults) {
  if (depth_m == 0) return Vec3::Zero();
  const bool has_own = !own.groove_wave_B.isZero(0);
  double distance_m = has_own ? 2 * kPi / own.groove_wave_B.norm() : surface_key("grooveDistance").default_value;
  change(written, "grooveDistance", distance_m);
  const std::vector<double> across = written("grooveDirection");
  const Vec3 direction = across.empty() ? own.groove_wave_B : Vec3(across[0], across[1], across[2]);
  if (direction.isZero()) {
    faults.push_back({ErrorCode::missing, "grooveDepth", "there are grooves, but not in which direction",
                      "write grooveDirection: 0 0 1 has one groove after the other along the body's z axis"});
    return Vec3::Zero();
  }
  const double wave_rad_per_m = 2 * kPi / distance_m;
  if (!hand::are_renderable(depth_m, wave_rad_per_m)) {
    const double most_um = std::floor(1e6 * hand::max_groove_depth_m(wave_rad_per_m));
    faults.push_back(
        {ErrorCode::conflict, "grooveDepth", "the grooves are too steep for a device to render",
         fmt::format("at a grooveDistance of {:g}, write a grooveDepth of at most {:.6f}, or a larger distance",
                     distance_m, 1e-6 * most_um)});
  }
  return wave_rad_per_m * direction.normalized();
}

}  // namespace

HapticMaterial changed_surface(const HapticMaterial& own, const WrittenKeys& written,
                               std::vector<SurfaceFault>& faults) {
  HapticMaterial surface = own;
  change(written, "stiffness", surface.stiffness_n_per_m);
  change(written, "damping", surface.damping_ns_per_m);
  change(written, "staticFriction", surface.static_friction);
  change(written, "dynamicFriction", surface.dynamic_friction);
  change(written, "viscosity", surface.viscosity_ns_per_m);
  change(written, "knock", surface.knock_ns_per_m);
  change(written, "grooveDepth", surface.groove_depth_m);
  surface.groove_wave_B = groove_wave_B(own, surface.groove_depth_m, written, faults);
  if (surface.dynamic_friction > surface.static_friction) {
    faults.push_back({ErrorCode::conflict, "dynamicFriction",
                      fmt::format("the dynamicFriction, {:g}, is larger than the staticFriction, {:g}",
                                  surface.dynamic_friction, surface.static_friction),
                      "write both, with a dynamicFriction that is at most the staticFriction"});
  }
  return surface;
}

}  // namespace mechane::state
