// Which file a step's narration is.
#include "client-sdk/display/display_sound.hpp"

#include <fstream>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace mechane::display
