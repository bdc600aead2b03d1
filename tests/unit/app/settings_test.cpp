#include "server/app/settings.hpp"

#include <initializer_list>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"

namespace mechane::app {
namespace {

using testing::HasSubstr;

class SettingsTest : public testing::Test {
 protected:
  static Expected<Settings> read(std::vector<std::string> arguments) {
    std::vector<const char*> argv{"mechane-server"};
    for (const std::string& argument : arguments)
      argv.push_back(argument.c_str());
    std::string help;
    return read_settings(static_cast<int>(argv.size()), argv.data(), help);
  }

  test::ScratchFolder folder_;
  std::string file_ = folder_.write("server.toml", "scenarios = ['a.x3d']\nworlds = 3\n[force]\nmax_force_n = 2.5\n");
};

TEST_F(SettingsTest, TheFileIsReadInEachWayThatAFlagCanBeWritten) {
  for (const auto& arguments : {std::vector<std::string>{"--settings", file_}, {"--settings=" + file_}}) {
    const auto settings = read(arguments);
    ASSERT_TRUE(settings) << settings.error().to_string();
    EXPECT_EQ(settings->force.governor.max_force_n, 2.5) << arguments.front();
    EXPECT_EQ(settings->worlds, 3) << arguments.front();
  }
}

TEST_F(SettingsTest, AFlagWinsOverTheFileOnWhicheverSideItStands) {
  for (const auto& arguments :
       {std::vector<std::string>{"--worlds=5", "--settings=" + file_}, {"--settings", file_, "--worlds", "5"}}) {
    const auto settings = read(arguments);
    ASSERT_TRUE(settings) << settings.error().to_string();
    EXPECT_EQ(settings->worlds, 5);
    EXPECT_EQ(settings->force.governor.max_force_n, 2.5);
  }
}

TEST_F(SettingsTest, AFileThatIsMissingOrWrongIsAnError) {
  const auto missing = read({"--settings=" + (folder_.path() / "none.toml").string()});
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().to_string(), HasSubstr("none.toml"));
  EXPECT_FALSE(read({"--scenario=a.x3d", "--settings", ""}));
  const auto misspelt = read({"--settings=" + folder_.write("bad.toml", "\nmax_force = 2\n").string()});
  ASSERT_FALSE(misspelt);
  EXPECT_THAT(misspelt.error().to_string(), HasSubstr("bad.toml:2"));
}

TEST_F(SettingsTest, AForceLimitOutOfItsRangeIsAnErrorThatNamesIt) {
  for (const std::string name : {"max_force_n", "max_torque_nm", "max_slew_n_per_s", "stiffness_scale"}) {
    for (const std::string value : {"-1.0", "1e7", "nan"}) {
      const auto file = folder_.write("force.toml", "scenarios = ['a.x3d']\n[force]\n" + name + " = " + value + "\n");
      const auto wrong = read({"--settings", file.string()});
      ASSERT_FALSE(wrong) << name << " = " << value;
      EXPECT_THAT(wrong.error().what, HasSubstr(name));
      EXPECT_THAT(wrong.error().remedy, HasSubstr(" to "));
    }
  }
  for (const std::string flag : {"--max-force=100.5", "--max-force=-0.5", "--max-force=nan", "--stiffness-scale=nan"})
    EXPECT_FALSE(read({"--scenario=a.x3d", flag})) << flag;
  EXPECT_TRUE(read({"--scenario=a.x3d", "--max-force=0"})) << "touch can be turned off";
}

}  // namespace
}  // namespace mechane::app
