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

}  // namespace
}  // namespace mechane::app
