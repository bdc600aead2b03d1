#include "client-sdk/sound/sound_player.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "server/base/clock.hpp"
#include "server/log/log.hpp"

namespace mechane::sound {
namespace {

using std::chrono::milliseconds;

/// OpenAL Soft's own choice of outputs, before its first use in this process.
void use_driver(const char* driver) {
  ::setenv("ALSOFT_DRIVERS", driver, 1);
  log::start("test", log::Level::info);
}

MATCHER_P(SaysOnce, what, "") {
  const std::string text = arg;
  const std::size_t first = text.find(what);
  return first != std::string::npos && text.find(what, first + 1) == std::string::npos;
}

bool comes(const std::function<bool()>& what) {
  SystemClock clock;
  const TimePoint end = clock.now() + std::chrono::seconds(20);
  while (!what()) {
    if (clock.now() > end) return false;
    clock.sleep_until(clock.now() + milliseconds(2));  // sleeps: between two looks
  }
  return true;
}

SoundScene water() {
  SoundScene scene;
  SoundSource source;
  source.id = "water";
  source.gain = 1;
  source.p_W = Vec3(0, 0, -2);
  scene.sources = {source};
  return scene;
}

SoundPlayerOptions quick() {
  SoundPlayerOptions options;
  options.first_retry = milliseconds(10);
  options.longest_retry = milliseconds(40);
  options.forget = milliseconds(300);
  return options;
}

/// Each in a process of its own: OpenAL Soft chooses its outputs once a process.
class SoundPlayerDeathTest : public testing::Test {
 protected:
  SoundPlayerDeathTest() { testing::FLAGS_gtest_death_test_style = "threadsafe"; }
};

int plays_what_it_is_told() {
  use_driver("null");
  SoundPlayer player(quick());
  if (!comes([&] { return player.state().sounding; })) return 1;
  player.play(water());
  if (!comes([&] { return player.state().voices == 1; })) return 2;
  // Two scenes at once: the knock of the first is not lost.
  SoundScene knock = water();
  knock.sources[0] = {"knock", SoundKind::knock, Vec3::Zero(), 1, 1, 2, false};
  player.play(knock);
  player.play(water());
  if (!comes([&] { return player.state().voices == 2; })) return 3;
  // The display stands still: a machine that is not seen to move is not heard to.
  if (!comes([&] { return player.state().voices == 0; })) return 4;
  player.set_levels({0.3, true});
  return player.levels().muted && player.state().problem.empty() ? 0 : 5;
}

int goes_on_without_a_card() {
  use_driver("none");
  SoundPlayer player(quick());
  player.play(water());
  if (!comes([&] { return !player.state().problem.empty(); })) return 1;
  SystemClock clock;
  clock.sleep_until(clock.now() + milliseconds(300));  // sleeps: more tries add nothing to the log
  const SoundState state = player.state();
  return !state.sounding && state.device.empty() && state.voices == 0 ? 0 : 2;
}

/// A card or none: what is told is told by our own log alone.
int asks_alsa() {
  use_driver("alsa");
  SoundPlayer player(quick());
  return comes([&] { return player.state().sounding || !player.state().problem.empty(); }) ? 0 : 1;
}

int notices_a_lost_device() {
  // A file on a full disk is a device that fails once it is written to.
  use_driver("wave");
  std::string settings = (std::filesystem::temp_directory_path() / "mechane-alsoft-XXXXXX").string();
  const int fd = mkstemp(settings.data());
  if (fd < 0) return 1;
  ::close(fd);
  std::ofstream(settings) << "[wave]\nfile = /dev/full\n";
  ::setenv("ALSOFT_CONF", settings.c_str(), 1);
  SoundPlayer player(quick());
  bool lost = false;
  const bool back = comes([&] {
    player.play(water());
    lost = lost || player.state().problem == "the sound device was lost";
    return lost && player.state().sounding;  // it is looked for, and found
  });
  std::filesystem::remove(settings);
  return back ? 0 : 2;
}

TEST_F(SoundPlayerDeathTest, plays_what_it_is_told) {
  EXPECT_EXIT(std::exit(plays_what_it_is_told()), testing::ExitedWithCode(0), "");
}

TEST_F(SoundPlayerDeathTest, without_a_card_it_goes_on_silently_and_says_so_once) {
  EXPECT_EXIT(std::exit(goes_on_without_a_card()), testing::ExitedWithCode(0), SaysOnce("there is no sound device"));
}

TEST_F(SoundPlayerDeathTest, alsa_says_nothing_past_the_log) {
  EXPECT_EXIT(std::exit(asks_alsa()), testing::ExitedWithCode(0), testing::Not(testing::HasSubstr("ALSA lib")));
}

TEST_F(SoundPlayerDeathTest, a_lost_device_is_told_and_looked_for) {
  EXPECT_EXIT(std::exit(notices_a_lost_device()), testing::ExitedWithCode(0), "the sound device was lost");
}

}  // namespace
}  // namespace mechane::sound
