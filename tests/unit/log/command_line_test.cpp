#include "server/log/command_line.hpp"

#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"

namespace mechane {
namespace {

/// What stderr told of these arguments, and the status; empty and -1: the program goes on.
struct Told {
  std::string text;
  int status = -1;
};

Told told_of(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "/usr/lib/mechane/mechane-try");
  CLI::App app{"A program.", "mechane try"};
  int port = 0;
  std::string file;
  app.add_option("--device", file);
  app.add_option("--port", port)->check(CLI::Range(1, 9));
  CLI::App* show = app.add_subcommand("show");
  show->add_option("visit", file)->required();
  show->add_flag("--json");
  app.set_config("--settings");
  app.allow_config_extras(CLI::config_extras_mode::error);
  testing::internal::CaptureStderr();
  const std::optional<int> status = parse_command_line(app, static_cast<int>(arguments.size()), arguments.data());
  return {testing::internal::GetCapturedStderr(), status.value_or(-1)};
}

TEST(CommandLine, NamesWhatIsWrongAndTheOptionThatIsNear) {
  EXPECT_EQ(told_of({"--devic", "virtual"}).text,
            "mechane try: there is no option '--devic'; did you mean '--device'? (mechane try --help lists them)\n");
  EXPECT_EQ(told_of({"--xyz=3"}).text, "mechane try: there is no option '--xyz'; see mechane try --help\n");
  EXPECT_EQ(
      told_of({"show", "7", "--jsn"}).text,
      "mechane try show: there is no option '--jsn'; did you mean '--json'? (mechane try show --help lists them)\n");
  EXPECT_EQ(told_of({"show", "7", "8"}).text, "mechane try show: unexpected word '8'; see mechane try show --help\n");
  EXPECT_EQ(told_of({"shw"}).text,
            "mechane try: unexpected word 'shw'; did you mean 'show'? (mechane try --help lists them)\n");
  EXPECT_EQ(told_of({"show"}).text, "mechane try show: visit is required; see mechane try show --help\n");
  EXPECT_NE(told_of({"--port", "10"}).text.find("mechane try: --port: Value 10 not in range"), std::string::npos);
  EXPECT_EQ(told_of({"--port", "10"}).status, 2);
}

TEST(CommandLine, NamesTheWordOfASettingsFileThatIsNoOption) {
  const test::ScratchFolder folder;
  const std::string file = folder.write("try.toml", "port = 3\ndevize = \"virtual\"\n");
  EXPECT_EQ(
      told_of({"--settings", file.c_str()}).text,
      "mechane try: the settings file has 'devize', which is not an option of this program; did you mean 'device'? "
      "Write options without dashes, one a line, as in quality = \"cached\" (mechane try --help lists them)\n");
}

TEST(CommandLine, EndsAfterHelpAndGoesOnWithoutAFault) {
  testing::internal::CaptureStdout();
  EXPECT_EQ(told_of({"--help"}).status, 0);
  EXPECT_NE(testing::internal::GetCapturedStdout().find("Usage: mechane try [OPTIONS]"), std::string::npos);
  const Told good = told_of({"--port", "3", "show", "7"});
  EXPECT_EQ(good.status, -1);
  EXPECT_EQ(good.text, "");
}

}  // namespace
}  // namespace mechane
