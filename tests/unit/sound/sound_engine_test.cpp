#include "client-sdk/sound/sound_engine.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

#include <gtest/gtest.h>
#include <sndfile.h>

#include "client-sdk/sound/sound_file.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::sound {
namespace {

namespace fs = std::filesystem;

// No sound card is touched by these tests, whatever the machine has. Read when the first device is opened.
const int kOnlyNull = ::setenv("ALSOFT_DRIVERS", "null", 1);

constexpr double kFrame_s = 1.0 / 60;
constexpr double kDither = 1e-4;  ///< silence, in 16 bits
constexpr std::size_t kFrameSamples = kSoundRate_hz / 60;

struct Heard {
  double left = 0;
  double right = 0;
  double peak = 0;
  [[nodiscard]] double both() const { return std::hypot(left, right); }
};

Heard measure(const std::vector<float>& samples) {
  Heard heard;
  for (std::size_t i = 0; i + 1 < samples.size(); i += 2) {
    heard.left += double{samples[i]} * double{samples[i]};
    heard.right += double{samples[i + 1]} * double{samples[i + 1]};
    heard.peak = std::max({heard.peak, std::abs(double{samples[i]}), std::abs(double{samples[i + 1]})});
  }
  const double frames = static_cast<double>(samples.size()) / 2;
  heard.left = std::sqrt(heard.left / frames);
  heard.right = std::sqrt(heard.right / frames);
  return heard;
}

double decibels(double ratio) {
  return 20 * std::log10(ratio);
}

SoundSource source_at(const std::string& id, SoundKind kind, const Vec3& p_W, bool looped = true) {
  SoundSource source;
  source.id = id;
  source.kind = kind;
  source.p_W = p_W;
  source.gain = 1;
  source.looped = looped;
  return source;
}

class SoundEngineTest : public testing::Test {
 protected:
  SoundEngineTest() : engine_(std::move(*SoundEngine::open(SoundOutput::samples))) {}
  /// As a display would: sixty frames a second.
  std::vector<float> play(const SoundScene& scene, double seconds) {
    std::vector<float> all;
    for (double t = 0; t < seconds; t += kFrame_s) {
      engine_->apply(scene, levels_, kFrame_s);
      const std::vector<float> piece = engine_->render(kFrameSamples);
      all.insert(all.end(), piece.begin(), piece.end());
    }
    return all;
  }
  /// After half a second, when gains stand.
  Heard settled(const SoundScene& scene, double seconds = 1) {
    (void)play(scene, 0.5);
    return measure(play(scene, seconds));
  }
  /// A file of one tone, or of silence.
  [[nodiscard]] std::string recording(const char* name, double seconds, float level, int format) const {
    SF_INFO info{};
    info.samplerate = 22'050;
    info.channels = 1;
    info.format = format;
    const std::string file = (top_ / name).string();
    std::vector<float> samples(static_cast<std::size_t>(seconds * info.samplerate));
    for (std::size_t i = 0; i < samples.size(); ++i)
      samples[i] = level * static_cast<float>(std::sin(2 * kPi * 440 * static_cast<double>(i) / info.samplerate));
    SNDFILE* out = sf_open(file.c_str(), SFM_WRITE, &info);
    EXPECT_NE(out, nullptr) << sf_strerror(nullptr);
    sf_write_float(out, samples.data(), static_cast<sf_count_t>(samples.size()));
    sf_close(out);
    return file;
  }

  std::unique_ptr<SoundEngine> engine_;
  SoundLevels levels_;
  test::ScratchFolder scratch_;
  fs::path top_ = scratch_.path();
};

constexpr int kWav = SF_FORMAT_WAV | SF_FORMAT_PCM_16;
constexpr int kOgg = SF_FORMAT_OGG | SF_FORMAT_VORBIS;

TEST_F(SoundEngineTest, nothing_sounds_by_itself) {
  EXPECT_LT(measure(play({}, 0.5)).peak, kDither);
}

TEST_F(SoundEngineTest, what_is_on_the_left_is_louder_on_the_left) {
  SoundScene scene;
  scene.sources = {source_at("a", SoundKind::water, Vec3(-3, 0, 0))};
  const Heard left = settled(scene);
  EXPECT_GT(left.left, 2 * left.right);
  // The visitor turns round: the same place is on the right.
  scene.listener.forward_W = Vec3::UnitZ();
  const Heard turned = settled(scene);
  EXPECT_GT(turned.right, 2 * turned.left);
  scene.listener.p_W = Vec3(-6, 0, 0);
  EXPECT_GT(settled(scene).left, 2 * settled(scene).right) << "he walks to its other side";
}

TEST_F(SoundEngineTest, what_is_far_is_quiet_by_its_distance) {
  SoundScene scene;
  scene.sources = {source_at("a", SoundKind::steam, Vec3(0, 0, -2))};
  const double near = settled(scene, 2.6).both();
  scene.sources[0].p_W.z() = -0.5;
  EXPECT_NEAR(decibels(settled(scene, 2.6).both() / near), 0, 0.5) << "nearer than near_m nothing grows louder";
  scene.sources[0].p_W.z() = -8;
  EXPECT_NEAR(decibels(settled(scene, 2.6).both() / near), decibels(0.25), 0.5);
}

TEST_F(SoundEngineTest, the_gain_follows_without_a_jump) {
  SoundScene scene;
  scene.sources = {source_at("a", SoundKind::steam, Vec3(0, 0, -2))};
  const std::vector<float> rise = play(scene, 0.4);
  const std::vector<float> first(rise.begin(), rise.begin() + 2 * kFrameSamples);
  const std::vector<float> last(rise.end() - 2 * kFrameSamples, rise.end());
  EXPECT_LT(measure(first).both(), 0.5 * measure(last).both());
  scene.sources[0].gain = 0.5;
  const double half = settled(scene, 2.6).both();
  scene.sources[0].gain = 1;
  EXPECT_NEAR(decibels(settled(scene, 2.6).both() / half), 6, 0.5);
  scene.sources.clear();
  (void)play(scene, 1);
  EXPECT_EQ(engine_->voices_playing(), 0U);
  EXPECT_LT(measure(play(scene, 0.2)).peak, kDither);
}

TEST_F(SoundEngineTest, a_higher_pitch_is_heard) {
  SoundScene scene;
  scene.sources = {source_at("a", SoundKind::ratchet, Vec3(0, 0, -2))};
  const auto crossings = [&] {
    (void)play(scene, 0.5);
    const std::vector<float> s = play(scene, 1);
    int count = 0;
    for (std::size_t i = 2; i < s.size(); i += 2)
      count += (s[i] > 0) != (s[i - 2] > 0) ? 1 : 0;
    return count;
  };
  scene.sources[0].pitch = 0.5;
  const int low = crossings();
  scene.sources[0].pitch = 2;
  EXPECT_GT(crossings(), 2 * low);
}

TEST_F(SoundEngineTest, what_sounds_once_sounds_once) {
  SoundScene scene;
  scene.sources = {source_at("knock 1", SoundKind::knock, Vec3(0, 0, -2), false)};
  EXPECT_GT(measure(play(scene, 0.2)).peak, 0.05);
  (void)play(scene, 0.5);
  EXPECT_LT(measure(play(scene, 0.5)).peak, kDither) << "though the scene still has it";
  EXPECT_EQ(engine_->voices_playing(), 0U);
  scene.sources[0].id = "knock 2";
  EXPECT_GT(measure(play(scene, 0.2)).peak, 0.05);
  // Gone from the scene at once, as events are: it sounds to its end.
  scene.sources[0].id = "knock 3";
  engine_->apply(scene, levels_, kFrame_s);
  EXPECT_GT(measure(play({}, 0.2)).peak, 0.05);
}

TEST_F(SoundEngineTest, a_voice_makes_the_effects_quieter_by_nine_decibels_and_only_as_long_as_it_speaks) {
  SoundScene scene;
  scene.sources = {source_at("a", SoundKind::steam, Vec3(0, 0, -2))};
  const double alone = settled(scene, 1).both();
  scene.narration = Narration{"step 1", recording("silence.wav", 3, 0, kWav)};
  (void)play(scene, 1);
  EXPECT_EQ(engine_->speaking(), "step 1");
  const double ducked = measure(play(scene, 1)).both();
  EXPECT_NEAR(decibels(ducked / alone), -9, 1);
  (void)play(scene, 2.5);
  EXPECT_EQ(engine_->speaking(), "");
  EXPECT_NEAR(decibels(measure(play(scene, 1)).both() / alone), 0, 1);
}

TEST_F(SoundEngineTest, a_narration_speaks_once_and_ends_with_its_step) {
  const std::string one = recording("one.wav", 0.5, 0.5F, kWav);
  const std::string two = recording("two.ogg", 5, 0.5F, kOgg);
  SoundScene scene;
  scene.narration = Narration{"step 1", one};
  EXPECT_GT(measure(play(scene, 0.4)).both(), 0.1);
  (void)play(scene, 0.3);
  EXPECT_LT(measure(play(scene, 0.5)).peak, kDither) << "once";
  scene.narration = Narration{"step 2", two};
  EXPECT_GT(measure(play(scene, 0.4)).both(), 0.1) << "Ogg Vorbis";
  EXPECT_EQ(engine_->speaking(), "step 2");
  scene.narration = Narration{"step 3", ""};
  (void)play(scene, 0.1);
  EXPECT_LT(measure(play(scene, 0.2)).peak, kDither) << "a step without a voice ends that of the one before";
  scene.narration->file = two;
  EXPECT_GT(measure(play(scene, 0.4)).both(), 0.1) << "its file came late";
  scene.narration = Narration{"step 1", one};
  EXPECT_GT(measure(play(scene, 0.4)).both(), 0.1) << "a step that begins again is told again";
}

TEST_F(SoundEngineTest, a_file_that_is_no_sound_is_silent_and_named) {
  const std::string bad = (top_ / "bad.wav").string();
  std::ofstream(bad) << "RIFF\xff\xff\xff\xffWAVEfmt nonsense";
  SoundScene scene;
  scene.narration = Narration{"step 1", bad};
  EXPECT_LT(measure(play(scene, 0.2)).peak, kDither);
  scene.narration = Narration{"step 2", (top_ / "missing.ogg").string()};
  EXPECT_LT(measure(play(scene, 0.2)).peak, kDither);
  EXPECT_EQ(engine_->bad_files(), (std::set<std::string>{bad, (top_ / "missing.ogg").string()}));
  EXPECT_EQ(engine_->speaking(), "");
}

TEST_F(SoundEngineTest, the_master_turns_everything_down_and_mutes) {
  SoundScene scene;
  scene.sources = {source_at("a", SoundKind::steam, Vec3(0, 0, -2))};
  const double full = settled(scene, 2.6).both();
  levels_.volume = 0.5;
  EXPECT_NEAR(decibels(settled(scene, 2.6).both() / full), -6, 0.5);
  levels_.muted = true;
  EXPECT_LT(settled(scene).peak, kDither);
  levels_ = {7, false};
  EXPECT_NEAR(decibels(settled(scene, 2.6).both() / full), 0, 0.5) << "not above its full volume";
}

TEST_F(SoundEngineTest, a_crowd_of_sounds_does_not_clip_and_the_loudest_are_heard) {
  SoundScene scene;
  for (int i = 0; i < 60; ++i)
    scene.sources.push_back(
        source_at(std::to_string(i), kSoundKinds[static_cast<std::size_t>(i) % kSoundKinds.size()], Vec3(20, 0, 0)));
  (void)play(scene, 0.5);
  EXPECT_EQ(engine_->voices_playing(), 24U);
  for (SoundSource& source : scene.sources)
    source.p_W = Vec3(0, 0, -1);
  scene.narration = Narration{"step", recording("loud.wav", 5, 0.9F, kWav)};
  const std::vector<float> loud = play(scene, 3);
  EXPECT_GT(measure(loud).both(), 0.2);
  // Clipped, a wave would stand at its limit from sample to sample.
  int run = 0;
  int longest = 0;
  for (std::size_t i = 0; i < loud.size(); i += 2) {
    run = std::abs(loud[i]) > 0.9999F ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  EXPECT_LE(longest, 2);
  // A knock beside the ear takes the place of one of them.
  scene.sources.push_back(source_at("knock", SoundKind::knock, Vec3(0, 0, -0.1), false));
  scene.sources.back().near_m = 4;
  for (SoundSource& source : scene.sources)
    source.gain = source.looped ? 0.3 : 1;
  (void)play(scene, 0.1);
  EXPECT_EQ(engine_->voices_playing(), 24U);
}

TEST(SoundFile, what_is_no_sound_is_an_error_with_a_remedy) {
  for (const auto& [file, code] :
       {std::pair("/dev/null", ErrorCode::damaged), std::pair("/nowhere/a.wav", ErrorCode::not_found)}) {
    const auto read = read_sound(file);
    ASSERT_FALSE(read.has_value());
    EXPECT_THAT(read.error(), test::is_error(code, 0, {file}));
  }
}

}  // namespace
}  // namespace mechane::sound
