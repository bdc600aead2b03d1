#include "client-sdk/sound/sound_synth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "server/base/assert.hpp"
#include "server/base/math.hpp"
#include "server/base/random.hpp"

namespace mechane::sound {
namespace {

/// Fluttering noise between two frequencies. With a decay it is a burst.
struct NoiseLayer {
  float level = 0;
  float low_hz = 0, high_hz = 0;
  float flutter_hz = 0, flutter = 0;  ///< how fast, and how much of the level, 0..1
  float decay_s = 0;                  ///< 0: steady
};

/// Many small ringing drops. A bubble's tone rises as it nears the surface (van den Doel 2005, Physically based models
/// for liquid sounds, eq. 8: f(t) = f0 (1 + xi d t); here `rise` is xi d over one decay). Without a rise, it is a
/// crackle.
struct DropLayer {
  float level = 0;
  float per_s = 0;
  float low_hz = 0, high_hz = 0;
  float short_s = 0, long_s = 0;  ///< decay
  float rise = 0;
  float fade_s = 0;  ///< of the layer; 0: steady
};

/// A struck body: its modes, each with a decay. With many strikes it creaks or ticks.
struct BodyLayer {
  float level = 0;
  float strikes_per_s = 0;  ///< 0: once, at the beginning
  float jitter = 0;         ///< of the time between strikes, and of their strength; 0..1
  std::array<float, 4> hz{};
  std::array<float, 4> decay_s{};
};

struct SoundRecipe {
  SoundKind kind;
  std::string_view name;
  float length_s;
  bool loops;
  std::array<NoiseLayer, 2> noise;
  DropLayer drops;
  BodyLayer body;
};

constexpr std::array<SoundRecipe, kSoundKinds.size()> kRecipes{{
    {SoundKind::water,
     "water",
     3.0F,
     true,
     {{{0.5F, 350, 1800, 7, 0.5F, 0}, {0.12F, 2500, 7000, 11, 0.6F, 0}}},
     {0.55F, 70, 450, 2400, 0.006F, 0.030F, 0.20F, 0},
     {}},
    {SoundKind::splash,
     "splash",
     1.2F,
     false,
     {{{1.0F, 500, 4500, 0, 0, 0.09F}, {0.35F, 150, 900, 0, 0, 0.16F}}},
     {0.6F, 90, 500, 2200, 0.006F, 0.028F, 0.25F, 0.35F},
     {}},
    {SoundKind::creak,
     "wood",
     2.4F,
     true,
     {{{0.05F, 200, 1200, 5, 0.9F, 0}, {}}},
     {},
     {1.0F, 34, 0.55F, {270, 610, 1130, 1900}, {0.016F, 0.012F, 0.007F, 0.004F}}},
    {SoundKind::knock,
     "knock",
     0.45F,
     false,
     {{{0.5F, 300, 3500, 0, 0, 0.003F}, {}}},
     {},
     {1.0F, 0, 0, {205, 470, 890, 1480}, {0.055F, 0.040F, 0.026F, 0.015F}}},
    {SoundKind::rope,
     "rope",
     2.2F,
     true,
     {{{0.16F, 1200, 5000, 6, 0.9F, 0}, {}}},
     {0.25F, 26, 900, 2600, 0.002F, 0.006F, 0, 0},
     {0.8F, 17, 0.8F, {420, 760, 1350, 2300}, {0.010F, 0.007F, 0.005F, 0.003F}}},
    {SoundKind::scrape,
     "scrape",
     2.4F,
     true,
     {{{0.8F, 500, 3500, 38, 0.8F, 0}, {0.25F, 90, 300, 14, 0.7F, 0}}},
     {0.35F, 130, 1500, 5200, 0.001F, 0.004F, 0, 0},
     {}},
    {SoundKind::thud,
     "thud",
     0.7F,
     false,
     {{{0.7F, 60, 420, 0, 0, 0.045F}, {0.25F, 900, 4000, 0, 0, 0.012F}}},
     {0.12F, 60, 1400, 4200, 0.001F, 0.003F, 0, 0.10F},
     {1.0F, 0, 0, {92, 158, 246, 410}, {0.090F, 0.070F, 0.045F, 0.020F}}},
    {SoundKind::fire,
     "fire",
     3.0F,
     true,
     {{{0.55F, 70, 420, 5, 0.7F, 0}, {0.10F, 900, 5000, 9, 0.7F, 0}}},
     {0.75F, 14, 900, 5200, 0.001F, 0.005F, 0, 0},
     {}},
    {SoundKind::steam,
     "steam",
     2.6F,
     true,
     {{{0.8F, 2600, 9500, 16, 0.25F, 0}, {0.12F, 500, 1800, 8, 0.5F, 0}}},
     {},
     {}},
    {SoundKind::bow,
     "bow",
     0.9F,
     false,
     {{{0.6F, 250, 2600, 0, 0, 0.030F}, {0.2F, 1500, 6000, 0, 0, 0.060F}}},
     {},
     {1.0F, 0, 0, {176, 358, 537, 1130}, {0.110F, 0.090F, 0.060F, 0.030F}}},
    {SoundKind::ratchet,
     "ratchet",
     2.0F,
     true,
     {{{0.02F, 300, 1500, 9, 0.8F, 0}, {}}},
     {},
     {1.0F, 8, 0.06F, {520, 1240, 2300, 3700}, {0.014F, 0.009F, 0.006F, 0.004F}}},
}};

constexpr float kSeam_s = 0.12F;      ///< overlap of a loop's end and beginning
constexpr float kLoopLevel = 0.11F;   ///< root mean square
constexpr float kLoudest = 0.75F;     ///< of any sample
constexpr float kAttack_s = 0.0006F;  ///< of a strike, to avoid a click
constexpr float kLowest_hz = 35;      ///< a high-pass removes what no loudspeaker of a museum plays, and any offset
constexpr float kTailShare = 0.15F;   ///< of a sound that plays once: it fades to nothing

/// Second order, Butterworth: Bristow-Johnson's cookbook, Q = 1/sqrt 2.
class Biquad {
 public:
  static Biquad low_pass(float hz) { return {hz, false}; }
  static Biquad high_pass(float hz) { return {hz, true}; }
  float operator()(float x) {
    const float y = b0_ * x + b1_ * x1_ + b0_ * x2_ - a1_ * y1_ - a2_ * y2_;
    x2_ = x1_;
    x1_ = x;
    y2_ = y1_;
    y1_ = y;
    return y;
  }

 private:
  Biquad(float hz, bool high) {
    const float w = kTwoPiF * hz / static_cast<float>(kSoundRate_hz);
    const float alpha = std::sin(w) / std::numbers::sqrt2_v<float>;
    const float a0 = 1 + alpha;
    const float side = high ? -(1 + std::cos(w)) : 1 - std::cos(w);
    b1_ = side / a0;
    b0_ = (high ? -side : side) / (2 * a0);
    a1_ = -2 * std::cos(w) / a0;
    a2_ = (1 - alpha) / a0;
  }
  float b0_ = 0, b1_ = 0, a1_ = 0, a2_ = 0;
  float x1_ = 0, x2_ = 0, y1_ = 0, y2_ = 0;
};

std::size_t samples_in(float seconds) {
  return static_cast<std::size_t>(seconds * static_cast<float>(kSoundRate_hz));
}

void add_noise(const NoiseLayer& layer, ShortRandom& random, std::vector<float>& out) {
  if (layer.level <= 0) return;
  Biquad low = Biquad::low_pass(layer.high_hz);
  Biquad high = Biquad::high_pass(layer.low_hz);
  const float step = layer.flutter_hz / static_cast<float>(kSoundRate_hz);
  float from = random.unit();
  float to = random.unit();
  float at = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    at += step;
    if (at >= 1) {
      at -= 1;
      from = to;
      to = random.unit();
    }
    const float smooth = from + (to - from) * at * at * (3 - 2 * at);
    float level = layer.level * (1 - layer.flutter * smooth);
    if (layer.decay_s > 0)
      level *= std::exp(-static_cast<float>(i) / (layer.decay_s * static_cast<float>(kSoundRate_hz)));
    // Times three: a narrow band of white noise is quieter than a ringing body by about this factor.
    out[i] += 3 * level * high(low(random.between(-1, 1)));
  }
}

struct Ring {
  float hz, decay_s, rise, level;
};

/// A decaying tone from sample `first` on.
void add_ring(const Ring& ring, std::size_t first, std::vector<float>& out) {
  const std::size_t end = std::min(out.size(), first + samples_in(7 * ring.decay_s));
  for (std::size_t i = first; i < end; ++i) {
    const float t = static_cast<float>(i - first) / static_cast<float>(kSoundRate_hz);
    const float phase = kTwoPiF * ring.hz * t * (1 + 0.5F * ring.rise * t / ring.decay_s);
    out[i] += ring.level * std::min(t / kAttack_s, 1.0F) * std::exp(-t / ring.decay_s) * std::sin(phase);
  }
}

void add_drops(const DropLayer& layer, ShortRandom& random, std::vector<float>& out) {
  if (layer.level <= 0) return;
  float t = 0;
  while (samples_in(t) < out.size()) {
    // Small drops are many and high; the square makes loud ones rare.
    const float size = random.unit();
    const float hz = layer.high_hz * std::pow(layer.low_hz / layer.high_hz, size);
    const float decay_s = layer.short_s + (layer.long_s - layer.short_s) * size;
    const float strength = random.unit();
    const float faded = layer.fade_s > 0 ? std::exp(-t / layer.fade_s) : 1.0F;
    add_ring({hz, decay_s, layer.rise, layer.level * strength * strength * faded}, samples_in(t), out);
    t -= std::log(1 - 0.999F * random.unit()) / layer.per_s;  // a Poisson process
  }
}

void add_body(const BodyLayer& layer, ShortRandom& random, std::vector<float>& out) {
  if (layer.level <= 0) return;
  const float length_s = static_cast<float>(out.size()) / static_cast<float>(kSoundRate_hz);
  const float period_s = layer.strikes_per_s > 0 ? 1 / layer.strikes_per_s : length_s;
  for (int strike = 0;; ++strike) {
    const float late = layer.strikes_per_s > 0 ? 0.3F + layer.jitter * random.between(-0.5F, 0.5F) : 0.0F;
    const float t = (static_cast<float>(strike) + late) * period_s;
    if (t >= length_s || (strike > 0 && layer.strikes_per_s <= 0)) return;
    const float strength = layer.level * (1 - 0.8F * layer.jitter * random.unit());
    for (std::size_t m = 0; m < layer.hz.size(); ++m) {
      const float level = strength / (1 + 0.4F * static_cast<float>(m));
      add_ring({layer.hz[m] * (1 + 0.03F * layer.jitter * random.between(-1, 1)), layer.decay_s[m], 0, level},
               samples_in(std::max(t, 0.0F)), out);
    }
  }
}

/// Cross-fades the `extra` samples beyond the loop into its beginning, at equal power, so that the end continues
/// seamlessly.
void close_loop(std::vector<float>& samples, std::size_t extra) {
  const std::size_t length = samples.size() - extra;
  for (std::size_t i = 0; i < extra; ++i) {
    const float angle = kPiF / 2 * static_cast<float>(i) / static_cast<float>(extra);
    samples[i] = samples[i] * std::sin(angle) + samples[length + i] * std::cos(angle);
  }
  samples.resize(length);
}

void fade_out(std::vector<float>& samples) {
  const auto tail = static_cast<std::size_t>(kTailShare * static_cast<float>(samples.size()));
  for (std::size_t i = 0; i < tail; ++i) {
    const float left = static_cast<float>(i) / static_cast<float>(tail);
    samples[samples.size() - 1 - i] *= left * left * (3 - 2 * left);
  }
}

void set_level(std::vector<float>& samples, bool loops) {
  double power = 0;
  float peak = 0;
  for (const float s : samples) {
    power += double{s} * double{s};
    peak = std::max(peak, std::abs(s));
  }
  MECHANE_ASSERT(peak > 0);
  const auto rms = static_cast<float>(std::sqrt(power / static_cast<double>(samples.size())));
  const float scale = loops ? std::min(kLoopLevel / rms, kLoudest / peak) : kLoudest / peak;
  for (float& s : samples)
    s *= scale;
}

}  // namespace

std::string_view name_of(SoundKind kind) {
  return kRecipes[static_cast<std::size_t>(kind)].name;
}

SoundClip synthesise(SoundKind kind) {
  const SoundRecipe& recipe = kRecipes[static_cast<std::size_t>(kind)];
  MECHANE_ASSERT(recipe.kind == kind);
  ShortRandom random(static_cast<std::uint32_t>(kind) + 1U);
  const std::size_t extra = recipe.loops ? samples_in(kSeam_s) : 0;
  SoundClip clip{std::vector<float>(samples_in(recipe.length_s) + extra), recipe.loops};
  for (const NoiseLayer& layer : recipe.noise)
    add_noise(layer, random, clip.samples);
  add_drops(recipe.drops, random, clip.samples);
  add_body(recipe.body, random, clip.samples);
  Biquad no_offset = Biquad::high_pass(kLowest_hz);
  for (float& s : clip.samples)
    s = no_offset(s);
  if (recipe.loops) {
    close_loop(clip.samples, extra);
  } else {
    fade_out(clip.samples);
  }
  set_level(clip.samples, recipe.loops);
  return clip;
}

}  // namespace mechane::sound
