#include "client-sdk/sound/sound_synth.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

namespace mechane::sound {
namespace {

constexpr std::size_t kWindow = 4096;

/// Radix two, in place.
void transform(std::vector<std::complex<double>>& x) {
  const std::size_t n = x.size();
  if (n == 1) return;
  std::vector<std::complex<double>> even(n / 2);
  std::vector<std::complex<double>> odd(n / 2);
  for (std::size_t i = 0; i < n / 2; ++i) {
    even[i] = x[2 * i];
    odd[i] = x[2 * i + 1];
  }
  transform(even);
  transform(odd);
  for (std::size_t i = 0; i < n / 2; ++i) {
    const auto turned =
        std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n)) * odd[i];
    x[i] = even[i] + turned;
    x[i + n / 2] = even[i] - turned;
  }
}

/// The mean frequency of a sound's power, Hz.
double centroid_hz(const std::vector<float>& samples) {
  double weighted = 0;
  double sum = 0;
  for (std::size_t begin = 0; begin + kWindow <= samples.size(); begin += kWindow) {
    std::vector<std::complex<double>> x(kWindow);
    for (std::size_t i = 0; i < kWindow; ++i) {
      const double hann = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(i) / kWindow);
      x[i] = hann * double{samples[begin + i]};
    }
    transform(x);
    for (std::size_t k = 1; k < kWindow / 2; ++k) {
      weighted += static_cast<double>(k) * std::norm(x[k]);
      sum += std::norm(x[k]);
    }
  }
  return weighted / sum * kSoundRate_hz / kWindow;
}

double rms(const std::vector<float>& samples) {
  double power = 0;
  for (const float s : samples)
    power += double{s} * double{s};
  return std::sqrt(power / static_cast<double>(samples.size()));
}

class SoundSynth : public testing::TestWithParam<SoundKind> {};

TEST_P(SoundSynth, is_of_a_fit_level_and_length_without_clipping_or_offset) {
  const SoundClip clip = synthesise(GetParam());
  const double length_s = static_cast<double>(clip.samples.size()) / kSoundRate_hz;
  EXPECT_GE(length_s, 0.3);
  EXPECT_LE(length_s, 3.0);
  double mean = 0;
  double peak = 0;
  for (const float s : clip.samples) {
    ASSERT_TRUE(std::isfinite(s));
    mean += double{s};
    peak = std::max(peak, std::abs(double{s}));
  }
  EXPECT_LE(peak, 0.7501);
  EXPECT_GE(peak, 0.2);
  EXPECT_LT(std::abs(mean / static_cast<double>(clip.samples.size())), 1e-3);
  EXPECT_GT(rms(clip.samples), clip.loops ? 0.05 : 0.03);
  EXPECT_LE(rms(clip.samples), 0.2);
}

TEST_P(SoundSynth, is_the_same_each_time) {
  EXPECT_EQ(synthesise(GetParam()).samples, synthesise(GetParam()).samples);
}

TEST_P(SoundSynth, a_loop_has_no_click_at_its_seam_and_a_sound_that_plays_once_ends_in_silence) {
  const SoundClip clip = synthesise(GetParam());
  const std::vector<float>& s = clip.samples;
  const auto jump = [&](std::size_t i) { return std::abs(double{s[(i + 1) % s.size()]} - double{s[i]}); };
  if (!clip.loops) {
    EXPECT_LT(std::abs(s.front()), 0.05);
    EXPECT_LT(std::abs(s.back()), 1e-4);
    return;
  }
  // Of the steps from sample to sample, the one over the seam is not an odd one; nor is its change from the step before.
  std::vector<double> jumps;
  for (std::size_t i = 0; i + 1 < s.size(); ++i)
    jumps.push_back(jump(i));
  std::ranges::sort(jumps);
  EXPECT_LE(jump(s.size() - 1), jumps[jumps.size() * 999 / 1000]);
  // The level about the seam is that of the rest: no gap, no swell.
  std::vector<float> about(s.end() - 2205, s.end());
  about.insert(about.end(), s.begin(), s.begin() + 2205);
  if (GetParam() != SoundKind::ratchet && GetParam() != SoundKind::fire) {
    EXPECT_GT(rms(about), 0.3 * rms(s));
    EXPECT_LT(rms(about), 3.0 * rms(s));
  }
}

TEST_P(SoundSynth, sounds_in_its_range) {
  const std::map<SoundKind, std::pair<double, double>> ranges{
      {SoundKind::water, {500, 2500}}, {SoundKind::splash, {700, 3500}}, {SoundKind::creak, {250, 1200}},
      {SoundKind::knock, {200, 1200}}, {SoundKind::rope, {700, 3500}},   {SoundKind::scrape, {900, 3500}},
      {SoundKind::thud, {50, 500}},    {SoundKind::fire, {150, 1800}},   {SoundKind::steam, {4000, 8500}},
      {SoundKind::bow, {80, 1000}},    {SoundKind::ratchet, {500, 2600}}};
  const double hz = centroid_hz(synthesise(GetParam()).samples);
  EXPECT_GE(hz, ranges.at(GetParam()).first);
  EXPECT_LE(hz, ranges.at(GetParam()).second);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SoundSynth, testing::ValuesIn(kSoundKinds),
                         [](const auto& kind) { return std::string(name_of(kind.param)); });

}  // namespace
}  // namespace mechane::sound
