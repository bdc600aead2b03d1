#include "client-sdk/draw/passes/particles.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "client-sdk/picture/procedural_mesh.hpp"

namespace mechane::draw {
namespace {

using Kind = picture::ParticleEffect::Kind;

picture::ParticleEffect effect_of(Kind kind) {
  return {kind, Vec3f(0.2F, 1, -0.3F), Vec3f(0.6F, 0.8F, 0), 1, 0.05F, 1.5F};
}

std::vector<Particle> at(const picture::ParticleEffect& effect, double time_s, const Vec3f& wind = Vec3f::Zero()) {
  std::vector<Particle> out;
  append_particles(effect, 0, wind, time_s, out);
  return out;
}

/// Weighted by what is seen of each.
Vec3f middle_of(const std::vector<Particle>& particles) {
  Vec3f sum = Vec3f::Zero();
  float weight = 0;
  for (const Particle& p : particles) {
    sum += p.opacity * p.p_W;
    weight += p.opacity;
  }
  return sum / weight;
}

constexpr std::array kKinds{Kind::steam, Kind::smoke, Kind::fire, Kind::dust, Kind::spray};

RC_GTEST_PROP(Particles, follow_from_the_worlds_time_alone, ()) {
  const double time_s = *rc::gen::inRange(0, 3'600'000) * 1e-3;
  for (const Kind kind : kKinds) {
    const std::vector<Particle> once = at(effect_of(kind), time_s);
    (void)at(effect_of(kind), time_s + 5);
    const std::vector<Particle> again = at(effect_of(kind), time_s);
    RC_ASSERT(once.size() == again.size());
    for (std::size_t i = 0; i < once.size(); ++i) {
      RC_ASSERT(once[i].p_W == again[i].p_W);
      RC_ASSERT(once[i].opacity == again[i].opacity);
      RC_ASSERT(once[i].p_W.allFinite());
      RC_ASSERT(once[i].opacity >= 0 && once[i].opacity <= 1);
      RC_ASSERT(once[i].radius_m > 0);
    }
  }
}

RC_GTEST_PROP(Particles, move_without_jumps_while_they_are_seen, ()) {
  const double time_s = *rc::gen::inRange(0, 60'000) * 1e-3;
  for (const Kind kind : kKinds) {
    const std::vector<Particle> before = at(effect_of(kind), time_s);
    const std::vector<Particle> after = at(effect_of(kind), time_s + 0.001);
    for (std::size_t i = 0; i < before.size(); ++i) {
      // A new life begins and the old one ends unseen.
      const bool reborn = (after[i].p_W - before[i].p_W).norm() > 0.012F;
      if (reborn) RC_ASSERT(before[i].opacity < 0.01F && after[i].opacity < 0.05F);
      RC_ASSERT(std::abs(after[i].opacity - before[i].opacity) < 0.05F);
    }
  }
}

TEST(Particles, rise_drift_and_fall_as_their_kind_does) {
  const picture::ParticleEffect still{Kind::smoke, Vec3f::Zero(), Vec3f::UnitY(), 1, 0.05F, 0};
  const Vec3f wind(0.5F, 0, 0);
  double steam = 0, smoke = 0, drift = 0, fall = 0, shot = 0;
  for (int i = 0; i < 40; ++i) {
    const double time_s = 3 + 0.37 * i;
    picture::ParticleEffect effect = still;
    smoke += middle_of(at(effect, time_s)).y() / 40;
    drift += (middle_of(at(effect, time_s, wind)).x() - middle_of(at(effect, time_s)).x()) / 40;
    effect.kind = Kind::steam;
    steam += middle_of(at(effect, time_s)).y() / 40;
    effect.kind = Kind::spray;
    fall += middle_of(at(effect, time_s)).y() / 40;
    effect.direction_W = Vec3f::UnitX();
    effect.speed_m_per_s = 3;
    shot += middle_of(at(effect, time_s)).x() / 40;
  }
  EXPECT_GT(smoke, 0.3);
  EXPECT_GT(steam, 0.05);
  EXPECT_GT(drift, 0.2);
  EXPECT_LT(fall, -0.2);
  EXPECT_GT(shot, 0.5);
}

TEST(Particles, spray_flies_on_parabolas) {
  // What one drop does between two moments is what gravity makes of it.
  picture::ParticleEffect effect{Kind::spray, Vec3f::Zero(), Vec3f::UnitX(), 1, 0.02F, 4};
  constexpr double kDt = 0.02;
  const std::vector<Particle> a = at(effect, 10);
  const std::vector<Particle> b = at(effect, 10 + kDt);
  const std::vector<Particle> c = at(effect, 10 + 2 * kDt);
  int flying = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::min({a[i].opacity, b[i].opacity, c[i].opacity}) < 0.01F || a[i].seed != c[i].seed) continue;
    ++flying;
    const Vec3f bend = (a[i].p_W - 2 * b[i].p_W + c[i].p_W) / static_cast<float>(kDt * kDt);
    EXPECT_LT((bend - Vec3f(0, -9.81F, 0)).norm(), 0.1F);
  }
  EXPECT_GT(flying, 40);
}

TEST(Particles, intensity_says_how_many) {
  picture::ParticleEffect effect = effect_of(Kind::steam);
  const std::size_t all = at(effect, 2).size();
  effect.intensity = 0.5F;
  EXPECT_EQ(at(effect, 2).size(), all / 2);
  effect.intensity = 0;
  EXPECT_TRUE(at(effect, 2).empty());
  effect.intensity = 7;
  EXPECT_EQ(at(effect, 2).size(), all);
  effect.direction_W = Vec3f::Zero();
  EXPECT_TRUE(at(effect, 2).empty());
  effect = effect_of(Kind::steam);
  effect.p_W.x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(at(effect, 2).empty());
}

TEST(Particles, a_jet_falls_apart_on_its_way_and_a_spout_does_not) {
  picture::WaterStream jet;
  jet.p_WS = Vec3f(0, 1.2F, 0);
  jet.v_W = Vec3f(4, 0.8F, 0);
  jet.width_m = 0.010F;
  std::vector<Particle> drops;
  append_drops(jet, 1, drops);
  EXPECT_TRUE(drops.empty());
  jet.jet = true;
  append_drops(jet, 1, drops);
  EXPECT_GT(drops.size(), 60U);
  // We = 998 * 16.64 * 0.01 / 0.0728 = 2281; 8.51 * 0.01 * 2281^0.31 = 0.935 m.
  EXPECT_NEAR(picture::jet_breakup_s(jet) * jet.v_W.norm(), 0.935, 0.01);
  for (const Particle& drop : drops) {
    const float t = drop.p_W.x() / 4;
    EXPECT_GT(drop.p_W.x(), 0.2F) << "none at the nozzle";
    const float y = 1.2F + 0.8F * t - 0.5F * 9.81F * t * t;
    EXPECT_NEAR(drop.p_W.y(), y, 0.25F) << "along the jet";
    EXPECT_LT(drop.radius_m, 0.005F);
  }
}

TEST(Particles, are_sorted_from_far_to_near_over_all_effects) {
  picture::RenderScene scene;
  scene.effects = {effect_of(Kind::smoke), effect_of(Kind::fire)};
  scene.effects[1].p_W = Vec3f(0, 1, 0.4F);
  const Vec3f eye(0, 1, 3);
  const std::vector<Particle> all = particles_of(scene, eye);
  ASSERT_GT(all.size(), 100U);
  for (std::size_t i = 1; i < all.size(); ++i)
    EXPECT_GE((all[i - 1].p_W - eye).norm(), (all[i].p_W - eye).norm());
}

TEST(Splash, is_thrown_up_where_the_water_lands) {
  picture::WaterStream stream;
  stream.p_WS = Vec3f(1, 2, 3);
  stream.v_W = Vec3f(0.5F, 0, 0);
  stream.landing_height_m = 1;
  std::vector<Particle> dry;
  append_splash(stream, 0, 10, dry);
  EXPECT_TRUE(dry.empty()) << "no water, no splash";
  stream.width_m = 0.05F;
  // One metre down in 0.4515 s.
  const Vec3f place(1 + 0.5F * std::sqrt(2 / 9.81F), 1, 3);
  for (const double time_s : {0.0, 7.3, 3599.9}) {
    std::vector<Particle> drops;
    append_splash(stream, 0, time_s, drops);
    ASSERT_GT(drops.size(), 40U);
    Vec3f middle = Vec3f::Zero();
    for (const Particle& drop : drops) {
      EXPECT_GE(drop.p_W.y(), 1.0F) << "above the water";
      EXPECT_LT((drop.p_W - place).norm(), 0.8F);
      middle += drop.p_W / static_cast<float>(drops.size());
    }
    EXPECT_LT((middle - place).cwiseProduct(Vec3f(1, 0, 1)).norm(), 0.08F) << "evenly about the place";
    std::vector<Particle> again;
    append_splash(stream, 0, time_s, again);
    ASSERT_EQ(again.size(), drops.size());
    EXPECT_EQ(again[5].p_W, drops[5].p_W) << "the world's time alone moves it";
  }
}

}  // namespace
}  // namespace mechane::draw
