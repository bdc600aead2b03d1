#include "server/app/settings.hpp"

#include <initializer_list>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/error_like.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::app {
namespace {

using test::is_error;

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
  EXPECT_THAT(missing.error(), is_error(ErrorCode::not_found, 0, {"none.toml"}));
  EXPECT_FALSE(read({"--scenario=a.x3d", "--settings", ""}));
  EXPECT_THAT(read({"--scenario=a.x3d", "--no-such-flag"}).error(),
              is_error(ErrorCode::invalid_value, 0, {"--no-such-flag", "--help"}));
  EXPECT_THAT(read({}).error(), is_error(ErrorCode::missing, 0, {"--scenario"}));
}

TEST_F(SettingsTest, AFaultInTheFileIsNamedWithItsLine) {
  const auto error_of = [&](const std::string& text) {
    const auto settings = read({"--settings=" + folder_.write("bad.toml", "scenarios = ['a.x3d']\n" + text).string()});
    return settings ? Error{} : settings.error();
  };
  EXPECT_THAT(error_of("\nmax_force = 2\n"), is_error(ErrorCode::unknown_name, 3, {"bad.toml:3", "'max_force'"}));
  EXPECT_THAT(error_of("worlds = 'many'\n"), is_error(ErrorCode::invalid_value, 2, {"bad.toml:2", "'worlds'"}));
  EXPECT_THAT(error_of("[force]\nmode = 'papr'\n"), is_error(ErrorCode::invalid_value, 3, {"'papr'", "'paper'"}));
  EXPECT_THAT(error_of("worlds 3\n"), is_error(ErrorCode::damaged, 2, {"bad.toml:2"}));
}

TEST_F(SettingsTest, AForceLimitOutOfItsRangeIsAnErrorThatNamesIt) {
  for (const std::string name : {"max_force_n", "max_torque_nm", "max_slew_n_per_s", "stiffness_scale"}) {
    for (const std::string value : {"-1.0", "1e7", "nan"}) {
      const auto file = folder_.write("force.toml", "scenarios = ['a.x3d']\n[force]\n" + name + " = " + value + "\n");
      const auto wrong = read({"--settings", file.string()});
      ASSERT_FALSE(wrong) << name << " = " << value;
      EXPECT_THAT(wrong.error(), is_error(ErrorCode::invalid_value, 0, {name, " to "}));
    }
  }
  for (const std::string flag : {"--max-force=100.5", "--max-force=-0.5", "--max-force=nan", "--stiffness-scale=nan"})
    EXPECT_FALSE(read({"--scenario=a.x3d", flag})) << flag;
  EXPECT_TRUE(read({"--scenario=a.x3d", "--max-force=0"})) << "touch can be turned off";
}

TEST_F(SettingsTest, OrdersAreTakenOnlyWhereThatIsAskedFor) {
  EXPECT_FALSE(read({"--scenario=a.x3d"})->paced);
  EXPECT_TRUE(read({"--scenario=a.x3d", "--paced"})->paced);
}

}  // namespace
}  // namespace mechane::app
