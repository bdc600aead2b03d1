// Which file a step's narration is, and what of a world is heard.
#include "client-sdk/display/display_sound.hpp"

#include <cstdlib>
#include <fstream>
#include <functional>

#include <gtest/gtest.h>

#include "server/base/clock.hpp"
#include "server/log/log.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::display {
namespace {

class NarrationFile : public testing::Test {
 protected:
  NarrationFile() {
    status_.scenario = "crane";
    status_.step = "lift";
    put("built/crane/lift.en.wav");
    put("built/crane/lift.el.ogg");
    put("scenario/audio/mine.en.flac");
    put("secret.en.wav");
  }
  void put(const std::string& name) {
    const std::filesystem::path file = folder_.path() / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << "sound";
  }
  [[nodiscard]] std::string found(const std::string& language) const {
    const std::string file =
        narration_file(status_, language, (folder_.path() / "scenario").string(), (folder_.path() / "built").string());
    return file.empty() ? file : std::filesystem::relative(file, folder_.path()).string();
  }

  test::ScratchFolder folder_;
  client::WorldStatus status_;
};

TEST_F(NarrationFile, IsThatOfStepAndLanguage) {
  EXPECT_EQ(found("en"), "built/crane/lift.en.wav");
  EXPECT_EQ(found("el"), "built/crane/lift.el.ogg");
  EXPECT_EQ(found("de"), "");
  status_.step = "lower";
  EXPECT_EQ(found("en"), "");
}

TEST_F(NarrationFile, TheAuthorsOwnComesFirstWhereItIsThere) {
  status_.audio = {{"en", "audio/mine.en.flac"}, {"el", "audio/lost.el.flac"}};
  EXPECT_EQ(found("en"), "scenario/audio/mine.en.flac");
  EXPECT_EQ(found("el"), "built/crane/lift.el.ogg");
}

TEST_F(NarrationFile, NoNameLeadsOutOfItsFolder) {
  status_.audio = {{"en", "../secret.en.wav"}};
  EXPECT_EQ(found("en"), "built/crane/lift.en.wav");
  status_.audio = {{"en", (folder_.path() / "secret.en.wav").string()}};
  EXPECT_EQ(found("en"), "built/crane/lift.en.wav");
  status_.audio.clear();
  status_.scenario = "..";
  status_.step = "../secret";
  EXPECT_EQ(found("en"), "");
  status_.scenario = ".";
  EXPECT_EQ(found("en"), "");
}

/// Water that flows, a fire that is out, smoke, and a crank that somebody takes.
class HeardWorld {
 public:
  HeardWorld() {
    for (const char* kind : {"sound.water", "sound.fire", "smoke"}) {
      client::Effect effect;
      effect.name = effect.kind = kind;
      effect.quantity = presentation_.effects.size() == 1 ? 1 : 0;
      presentation_.effects.push_back(effect);
    }
    objects_.resize(1);
    objects_[0].name = "crank";
    frame_.quantities = {1, 0};
  }

  /// A picture of it after another, until so many voices are heard.
  [[nodiscard]] bool comes_to(std::size_t voices) {
    SystemClock clock;
    const TimePoint end = clock.now() + std::chrono::seconds(20);
    while (sound.state().voices != voices) {
      if (clock.now() > end) return false;
      frame_.tick += 20;
      hear({});
      clock.sleep_until(clock.now() + std::chrono::milliseconds(20));  // sleeps: between two looks
    }
    return true;
  }
  void hear(const std::vector<client::WorldEvent>& events) {
    sound.hear({}, sounds_.hear(here ? &frame_ : nullptr, &presentation_, objects_, events), &status_, "");
  }
  void flow(double water, double fire) { frame_.quantities = {water, fire}; }

  bool here = true;
  DisplaySound sound{{}, "en"};

 private:
  sound::WorldSounds sounds_;
  client::Frame frame_;
  client::WorldStatus status_;
  client::WorldPresentation presentation_;
  std::vector<client::SceneObject> objects_;
};

int hears_what_the_world_tells() {
  ::setenv("ALSOFT_DRIVERS", "null", 1);
  log::start("test", log::Level::info);
  HeardWorld world;
  if (!world.comes_to(1)) return 1;  // the water
  world.flow(1, 1);
  if (!world.comes_to(2)) return 2;  // and the fire
  world.flow(0, 0);
  if (!world.comes_to(0)) return 3;
  world.hear({{1, "grasped", "kiosk-1/0", "crank", 0}});
  if (!world.comes_to(1)) return 4;  // a knock, once
  if (!world.comes_to(0)) return 5;
  world.flow(1, 1);
  if (!world.comes_to(2)) return 6;
  world.here = false;  // the link is lost
  return world.comes_to(0) ? 0 : 7;
}

/// In a process of its own: OpenAL Soft chooses its outputs once a process.
class DisplaySoundDeathTest : public testing::Test {
 protected:
  DisplaySoundDeathTest() { testing::FLAGS_gtest_death_test_style = "threadsafe"; }
};

TEST_F(DisplaySoundDeathTest, WhatTheWorldTellsIsHeard) {
  EXPECT_EXIT(std::exit(hears_what_the_world_tells()), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace mechane::display
