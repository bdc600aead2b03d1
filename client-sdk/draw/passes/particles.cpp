#include "client-sdk/draw/passes/particles.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "client-sdk/picture/procedural_mesh.hpp"
#include "server/base/random.hpp"

namespace mechane::draw {
namespace {

constexpr float kGravity_m_per_s2 = 9.81F;
/// The fractional parts of the multiples of this number are evenly spread, for any count of them (Weyl).
constexpr double kGolden = 0.6180339887498949;

/// The properties of a kind of particle. Sizes are shares of the effect's size.
struct Habit {
  std::uint32_t count;
  float life_s;
  float slowing_s;         ///< time in which air slows it to a third; 0: never
  float rise_m_per_s;      ///< thermal rise, once it is slowed
  float rise_sizes_per_s;  ///< additional rise of a bigger fire
  float weight;            ///< share of gravity that it feels
  float wind;              ///< share of the wind that it takes on
  float spread;            ///< half the cone's opening, as a tangent
  float source;            ///< radius of its source
  float start;             ///< its radius at the start
  float growth;            ///< its radius at the end, relative to the start
  float opacity;
  float swirl;  ///< share of its radius
  std::array<float, 3> young;
  std::array<float, 3> old;
  ParticleShape shape;
};

/// Chosen by eye from pictures of kettles, hearths and hoses.
constexpr std::array<Habit, 5> kHabits{{
    {72,
     1.7F,
     0.30F,
     0.32F,
     0,
     0,
     0.55F,
     0.13F,
     0.35F,
     0.75F,
     9,
     0.42F,
     0.35F,
     {0.95F, 0.96F, 0.97F},
     {0.9F, 0.92F, 0.94F},
     ParticleShape::puff},
    {72,
     4.6F,
     0.60F,
     0.55F,
     0.8F,
     0,
     1,
     0.16F,
     0.50F,
     0.70F,
     5,
     0.40F,
     0.45F,
     {0.07F, 0.065F, 0.06F},
     {0.30F, 0.30F, 0.31F},
     ParticleShape::puff},
    {56,
     0.85F,
     0.50F,
     0.15F,
     3.4F,
     0,
     0.35F,
     0.10F,
     0.62F,
     0.62F,
     0.28F,
     0.62F,
     0.18F,
     {4.6F, 1.75F, 0.36F},
     {3.0F, 0.55F, 0.05F},
     ParticleShape::flame},
    {48,
     2.4F,
     0.28F,
     0.06F,
     0,
     0,
     0.5F,
     0.75F,
     0.60F,
     0.60F,
     4,
     0.30F,
     0.30F,
     {0.44F, 0.35F, 0.24F},
     {0.44F, 0.36F, 0.26F},
     ParticleShape::puff},
    {220,
     0.75F,
     0,
     0,
     0,
     1,
     0,
     0.24F,
     0.40F,
     0.15F,
     1,
     0.85F,
     0,
     {0.85F, 0.9F, 0.95F},
     {0.85F, 0.9F, 0.95F},
     ParticleShape::drop},
}};

/// A point of the unit disc perpendicular to `along`.
Vec3f on_disc(const Vec3f& along, ShortRandom& random) {
  const Vec3f u = along.unitOrthogonal();
  const float r = std::sqrt(random.unit());
  const float a = kTwoPiF * random.unit();
  return r * (std::cos(a) * u + std::sin(a) * along.cross(u));
}

float smooth(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

/// A particle's age: in which of its lives it is, and the elapsed share of it.
struct Age {
  std::uint32_t life = 0;
  float share = 0;
};

Age age_of(std::uint32_t particle, double time_s, double life_s) {
  const double lives = time_s / life_s + kGolden * (particle + 1);
  const double whole = std::floor(lives);
  // Works for negative times too: the count of lives wraps around.
  return {static_cast<std::uint32_t>(static_cast<std::int64_t>(whole)), static_cast<float>(lives - whole)};
}

Vec3f place_of(const picture::ParticleEffect& effect, const Habit& habit, const Vec3f& wind_W, float t, float radius_m,
               ShortRandom& random) {
  const Vec3f source = effect.p_W + habit.source * effect.size_m * on_disc(effect.direction_W, random);
  const Vec3f v = effect.speed_m_per_s * (0.75F + 0.5F * random.unit()) *
                  (effect.direction_W + habit.spread * on_disc(effect.direction_W, random));
  const float brake = habit.slowing_s;
  const Vec3f thrown = v * (brake > 0 ? brake * (1 - std::exp(-t / brake)) : t);
  // The air carries it along more and more.
  const float carried = brake > 0 ? t * t / (t + brake) : t;
  const float rise = (habit.rise_m_per_s + habit.rise_sizes_per_s * effect.size_m) * (0.7F + 0.6F * random.unit());
  Vec3f p = source + thrown + habit.wind * wind_W * carried;
  p.y() += rise * carried - 0.5F * habit.weight * kGravity_m_per_s2 * t * t;
  const float phase = kTwoPiF * random.unit();
  const float turns = kTwoPiF * (0.35F + 0.5F * random.unit());
  p += habit.swirl * radius_m * Vec3f(std::sin(turns * t + phase), 0, std::cos(1.3F * turns * t + phase));
  return p;
}

bool is_drawable(const picture::ParticleEffect& effect) {
  return effect.p_W.allFinite() && effect.direction_W.allFinite() && effect.direction_W.norm() > 0.5F &&
         effect.intensity > 0 && effect.size_m > 0 && std::isfinite(effect.speed_m_per_s);
}

}  // namespace

void append_particles(const picture::ParticleEffect& effect, std::uint32_t number, const Vec3f& wind_W, double time_s,
                      std::vector<Particle>& out) {
  if (!is_drawable(effect)) return;
  const Habit& habit = kHabits[static_cast<std::size_t>(effect.kind)];
  const float alive = std::min(effect.intensity, 1.0F) * static_cast<float>(habit.count);
  for (std::uint32_t i = 0; static_cast<float>(i) < alive; ++i) {
    const Age age = age_of(i, time_s, habit.life_s);
    ShortRandom random(number, i, age.life);
    Particle particle;
    particle.seed = random.unit();
    particle.spin_rad = kTwoPiF * random.unit() + (random.unit() - 0.5F) * 1.5F * age.share;
    particle.radius_m = habit.start * effect.size_m * (0.7F + 0.6F * random.unit()) *
                        (1 + (habit.growth - 1) * (habit.growth > 1 ? std::sqrt(age.share) : age.share));
    particle.p_W = place_of(effect, habit, wind_W, age.share * habit.life_s, particle.radius_m, random);
    const Vec3f young(habit.young[0], habit.young[1], habit.young[2]);
    particle.colour = young + (Vec3f(habit.old[0], habit.old[1], habit.old[2]) - young) * std::sqrt(age.share);
    // The last particle fades in and out as the intensity changes.
    const float here = std::min(alive - static_cast<float>(i), 1.0F);
    particle.opacity = habit.opacity * here * smooth(0, 0.08F, age.share) * std::pow(1 - age.share, 1.4F);
    particle.shape = habit.shape;
    // Mist between the drops, too fine for single drops.
    if (habit.shape == ParticleShape::drop && i % 4 == 3) {
      particle.shape = ParticleShape::puff;
      particle.radius_m *= 9 + 14 * age.share;
      particle.opacity *= 0.07F;
    }
    out.push_back(particle);
  }
}

void append_drops(const picture::WaterStream& jet, double time_s, std::vector<Particle>& out) {
  if (!jet.jet || !(jet.width_m > 0)) return;
  constexpr std::uint32_t kDrops = 260;
  const float flight_s = picture::flight_time_s(jet);
  const float broken_s = picture::jet_breakup_s(jet);
  const float speed = jet.v_W.norm();
  if (!(flight_s > 0) || !(speed > 0) || !std::isfinite(flight_s * speed)) return;
  const Vec3f along = jet.v_W / speed;
  for (std::uint32_t i = 0; i < kDrops; ++i) {
    const Age age = age_of(i, time_s, flight_s);
    ShortRandom random(0x1E7U, i, age.life);
    const float t = age.share * flight_s;
    // Some fine drops leave the surface early; the rest appears once the core has broken up.
    const bool fine = i % 4 == 0;
    const float apart_s = (fine ? 0.35F : 0.75F) * broken_s * (0.85F + 0.3F * random.unit());
    if (t < apart_s) continue;
    Particle drop;
    drop.shape = ParticleShape::drop;
    drop.seed = random.unit();
    drop.radius_m = 0.5F * jet.width_m * (fine ? 0.25F + 0.2F * random.unit() : 0.35F + 0.55F * random.unit());
    const Vec3f aside = on_disc(along, random) * (fine ? 0.055F : 0.03F) * speed * (t - apart_s);
    drop.p_W = jet.p_WS + jet.v_W * t * (1 + 0.03F * (random.unit() - 0.5F)) + aside;
    drop.p_W.y() -= 0.5F * kGravity_m_per_s2 * t * t;
    drop.colour = Vec3f(0.85F, 0.9F, 0.95F);
    drop.opacity = 0.8F * smooth(apart_s, 1.25F * apart_s, t);
    if (drop.p_W.y() > jet.landing_height_m) out.push_back(drop);
  }
}

void append_splash(const picture::WaterStream& stream, std::uint32_t number, double time_s,
                   std::vector<Particle>& out) {
  if (!(stream.width_m > 0) || !stream.p_WS.allFinite() || !stream.v_W.allFinite()) return;
  constexpr float kLife_s = 0.42F;
  const float flight_s = picture::flight_time_s(stream);
  const Vec3f arriving = stream.v_W - Vec3f(0, kGravity_m_per_s2 * flight_s, 0);
  const float speed = std::min(arriving.norm(), 6.0F);
  Vec3f place = stream.p_WS + stream.v_W * flight_s;
  place.y() = stream.landing_height_m;
  // It begins when the arriving water is thick enough to splash.
  const auto drops = static_cast<std::uint32_t>(std::lround(110 * std::clamp(stream.width_m / 0.04F, 0.0F, 1.0F)));
  for (std::uint32_t i = 0; i < drops; ++i) {
    const Age age = age_of(i, time_s, kLife_s);
    ShortRandom random(0x5B1A5U + number, i, age.life);
    const float t = age.share * kLife_s;
    const bool foam = i % 3 == 0;
    Particle drop;
    drop.seed = random.unit();
    drop.spin_rad = kTwoPiF * random.unit();
    const Vec3f from = place + 0.6F * stream.width_m * on_disc(Vec3f::UnitY(), random);
    const Vec3f thrown =
        speed * (0.20F * on_disc(Vec3f::UnitY(), random) + (0.10F + 0.24F * random.unit()) * Vec3f::UnitY());
    drop.p_W = from + thrown * t;
    drop.p_W.y() -= 0.5F * kGravity_m_per_s2 * t * t;
    drop.colour = Vec3f(0.88F, 0.92F, 0.95F);
    if (foam) {
      // Foam drifts away on the surface.
      drop.p_W = from + Vec3f(thrown.x(), 0, thrown.z()) * 0.5F * t;
      drop.p_W.y() = place.y() + 0.15F * stream.width_m;
      drop.radius_m = stream.width_m * (0.35F + 0.9F * age.share);
      drop.opacity = 0.34F * smooth(0, 0.15F, age.share) * (1 - age.share);
    } else {
      drop.shape = ParticleShape::drop;
      drop.radius_m = 0.05F * stream.width_m * (0.6F + 1.4F * random.unit());
      drop.opacity = 0.8F * (1 - smooth(0.7F, 1, age.share));
    }
    if (drop.p_W.y() >= place.y()) out.push_back(drop);
  }
}

std::vector<Particle> particles_of(const picture::RenderScene& scene, const Vec3f& p_WE) {
  std::vector<Particle> out;
  for (std::uint32_t i = 0; i < scene.effects.size(); ++i)
    append_particles(scene.effects[i], i, scene.wind_W, scene.time_s, out);
  for (std::uint32_t i = 0; i < scene.streams.size(); ++i) {
    append_drops(scene.streams[i], scene.time_s, out);
    append_splash(scene.streams[i], i, scene.time_s, out);
  }
  std::ranges::stable_sort(out, std::greater<>(),
                           [&](const Particle& particle) { return (particle.p_W - p_WE).squaredNorm(); });
  return out;
}

std::vector<Eigen::Vector4f> fire_lights(const picture::RenderScene& scene, FireLight light) {
  std::vector<Eigen::Vector4f> out;
  for (const picture::ParticleEffect& effect : scene.effects) {
    if (effect.kind != picture::ParticleEffect::Kind::fire || !is_drawable(effect) || out.size() == kMaxFires) continue;
    const Vec3f middle = effect.p_W + 1.2F * effect.size_m * Vec3f::UnitY();
    const auto t = static_cast<float>(std::fmod(scene.time_s, 1000.0));
    const float flicker =
        light == FireLight::steady ? 1 : 1 + 0.10F * std::sin(11.3F * t) + 0.07F * std::sin(23.7F * t + 1.3F);
    const float power = 18 * effect.size_m * effect.size_m * std::min(effect.intensity, 1.0F) * flicker;
    out.emplace_back(middle.x(), middle.y(), middle.z(), power);
  }
  return out;
}

}  // namespace mechane::draw
