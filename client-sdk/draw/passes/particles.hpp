// Steam, smoke, fire, dust and drops as puffs that face the eye. A particle's place and look depend on its number and
// the world's time alone: nothing is stored between frames, and when the world stands still, so does the steam.
#pragma once

#include <vector>

#include "client-sdk/picture/render_scene.hpp"

namespace mechane::draw {

enum class ParticleShape : std::uint8_t { puff, drop, flame };

struct Particle {
  Vec3f p_W = Vec3f::Zero();
  float radius_m = 0;
  Vec3f colour = Vec3f::Ones();  ///< puffs and drops: albedo; flames: radiance
  float opacity = 0;             ///< 0..1
  float spin_rad = 0;
  float seed = 0;  ///< 0..1, so that puffs look different
  ParticleShape shape = ParticleShape::puff;
};

/// Adds the particles of `effect` in the air at time_s. `number` is the effect's number in the scene.
void append_particles(const picture::ParticleEffect& effect, std::uint32_t number, const Vec3f& wind_W, double time_s,
                      std::vector<Particle>& out);

/// Adds the drops into which a jet breaks up; a stream that is not a jet has none.
void append_drops(const picture::WaterStream& jet, double time_s, std::vector<Particle>& out);

/// Adds the splash where falling water lands, and its foam. `number` is the stream's number in the scene.
void append_splash(const picture::WaterStream& stream, std::uint32_t number, double time_s, std::vector<Particle>& out);

/// All particles of a scene, the farthest from the eye first.
[[nodiscard]] std::vector<Particle> particles_of(const picture::RenderScene& scene, const Vec3f& p_WE);

/// Whether a fire's light flickers with the world's time, or has its mean.
enum class FireLight : std::uint8_t { flickering, steady };

/// The light of the scene's first kMaxFires fires on nearby things: xyz is the flame's middle in W, w its irradiance at
/// one metre.
[[nodiscard]] std::vector<Eigen::Vector4f> fire_lights(const picture::RenderScene& scene, FireLight light);

inline constexpr std::size_t kMaxFires = 4;

}  // namespace mechane::draw
