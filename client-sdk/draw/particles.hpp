// Steam, smoke, fire, dust and drops as puffs that face the eye. Where a particle is, and how it looks, follows from its number and the
// world's time alone: nothing is kept from frame to frame, and when the world stands still, so does the steam.
#pragma once

#include <vector>

#include "client-sdk/picture/render_scene.hpp"

namespace mechane::draw {

enum class ParticleShape : std::uint8_t { puff, drop, flame };

struct Particle {
  Vec3f p_W = Vec3f::Zero();
  float radius_m = 0;
  Vec3f colour = Vec3f::Ones();  ///< puffs and drops: what they send back of the light; flames: radiance
  float opacity = 0;             ///< 0..1
  float spin_rad = 0;
  float seed = 0;  ///< 0..1: no two puffs look the same
  ParticleShape shape = ParticleShape::puff;
};

/// The particles that `effect` has in the air at time_s. `number` tells one effect of a scene from another.
void append_particles(const picture::ParticleEffect& effect, std::uint32_t number, const Vec3f& wind_W, double time_s,
                      std::vector<Particle>& out);

/// The drops that a jet falls apart into; a stream that is not a jet has none.
void append_drops(const picture::WaterStream& jet, double time_s, std::vector<Particle>& out);

/// What is thrown up where falling water lands, and its foam. `number` tells one stream of a scene from another.
void append_splash(const picture::WaterStream& stream, std::uint32_t number, double time_s, std::vector<Particle>& out);

/// All of a scene's, the farthest from the eye first.
[[nodiscard]] std::vector<Particle> particles_of(const picture::RenderScene& scene, const Vec3f& p_WE);

/// What the scene's fires throw on things near by: xyz the flame's middle in W, w its irradiance at one metre. They flicker with the
/// world's time. The first kMaxFires.
[[nodiscard]] std::vector<Eigen::Vector4f> fire_lights(const picture::RenderScene& scene);

inline constexpr std::size_t kMaxFires = 4;

}  // namespace mechane::draw
