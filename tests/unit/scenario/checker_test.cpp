#include "server/scenario/checker.hpp"

#include <array>
#include <cstdio>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::scenario {
namespace {

std::vector<std::filesystem::path> shipped_scenarios() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source_folder() / "scenarios")) {
    if (entry.path().extension() == ".x3d") files.push_back(entry.path());
  }
  return files;
}

/// What a command prints, both channels; its exit status is added as a last line.
std::string output_of(const std::string& command) {
  std::string text;
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return "cannot be run";
  std::array<char, 4096> block{};
  for (std::size_t n = fread(block.data(), 1, block.size(), pipe); n > 0;
       n = fread(block.data(), 1, block.size(), pipe)) {
    text.append(block.data(), n);
  }
  const int status = pclose(pipe);
  return text + "exit " + std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : -1);
}

/// A copy of the shipped file with an edit, in a folder where its url finds a file.
class EditedFile {
 public:
  EditedFile(const std::string& from, const std::string& to) {
    std::filesystem::create_directories(scratch_.path() / "exhibit");
    std::filesystem::create_directory_symlink(source_folder() / "scenarios/models", scratch_.path() / "models");
    path = scratch_.path() / "exhibit/test.x3d";
    std::ofstream(path) << edited(from, to);
  }
  std::filesystem::path path;

 private:
  const test::ScratchFolder scratch_;
};

void expect_warning(const std::string& from, const std::string& to, const std::string& words) {
  const EditedFile file(from, to);
  const std::vector<Problem> problems = check(file.path);
  const bool said = std::any_of(problems.begin(), problems.end(), [&](const Problem& p) {
    return p.severity == Severity::warning && p.line > 0 && to_string(p).find(words) != std::string::npos;
  });
  EXPECT_TRUE(said) << "wanted: " << words << (problems.empty() ? "" : "; got " + to_string(problems[0]));
}

TEST(Check, ShippedExhibitsAreWithoutFault) {
  ASSERT_FALSE(shipped_scenarios().empty());
  for (const auto& file : shipped_scenarios()) {
    for (const Problem& p : check(file))
      ADD_FAILURE() << to_string(p);
  }
}

TEST(Check, ShippedExhibitsHoldAgainstTheStandardsSchema) {
  const auto schema = shared_folder() / "x3d/schema/x3d-4.0.xsd";
  if (!std::filesystem::exists(schema)) GTEST_SKIP() << "the standard's schema is not beside the project";
  for (const auto& file : shipped_scenarios()) {
    const std::string said =
        output_of("xmllint --nonet --noout --schema '" + schema.string() + "' '" + file.string() + "'");
    EXPECT_TRUE(said.ends_with("exit 0")) << said;
  }
}

TEST(Check, AnotherReaderTakesShippedExhibitsWithoutWarning) {
  for (const auto& file : shipped_scenarios()) {
    const std::string said = output_of("tovrmlx3d '" + file.string() + "' --encoding=xml");
    EXPECT_EQ(said.find("Warning:"), std::string::npos) << said.substr(said.find("Warning:"), 400);
    EXPECT_TRUE(said.ends_with("exit 0")) << said.substr(said.size() < 400 ? 0 : said.size() - 400);
  }
}

TEST(Check, WarnsOfWhatIsLikelyNotMeant) {
  expect_warning("name='next' value='\"seat\"'", "name='next' value='\"end\"'", "no trigger leads to this step");
  expect_warning("name='caption.el' value='\"Γυρίστε", "name='captoin.el' value='\"Γυρίστε",
                 "the caption is missing in: el");
  expect_warning("name='activity' value='\"assemble\"'", "name='activity' value='\"use\"'", "no visit plays it");
  expect_warning("value='\"CARRY\" \"SEAT\"'/>",
                 "value='\"SEAT\"'/><MetadataString containerField='value' name='disable' value='\"CARRY\"'/>",
                 "can never fire");
  expect_warning("name='effortScale' value='0.045'/>\n        <MetadataSet",
                 "name='colour' value='1'/>\n        <MetadataSet", "not known here");
}

TEST(Check, WritesForPeopleAndForPrograms) {
  const EditedFile file("mass='42'", "mass='nan'");
  const std::vector<std::string> names{file.path.string()};
  std::ostringstream text;
  EXPECT_EQ(run_check(names, text), 1);
  const std::string place = file.path.string() + ":" + std::to_string(line_of(text_of(file.path), "mass='nan'"));
  EXPECT_NE(text.str().find(place + ": error: RigidBody INNER: mass: 'nan' is not a finite number"), std::string::npos)
      << text.str();
  EXPECT_NE(text.str().find("1 file: 1 error, 0 warnings\n"), std::string::npos) << text.str();
  std::ostringstream json;
  EXPECT_EQ(run_check(names, json, CheckFormat::json), 1);
  const auto parsed = nlohmann::json::parse(json.str());
  ASSERT_EQ(parsed.size(), 1u);
  EXPECT_EQ(parsed[0]["node"], "RigidBody INNER");
  std::ostringstream clean;
  EXPECT_EQ(run_check(std::vector<std::string>{shipped_file().string()}, clean), 0);
  std::ostringstream none;
  EXPECT_EQ(run_check({}, none), 2);
}

TEST(Checker, TwoFilesOfOneIdAreAnErrorAndOneFileTwiceIsNone) {
  const EditedFile copy("title='", "title='A copy of ");
  std::ostringstream text;
  EXPECT_EQ(run_check(std::vector<std::string>{shipped_file().string(), copy.path.string()}, text), 1);
  EXPECT_NE(text.str().find(copy.path.string() + ": error: its id 'archimedes-screw' is that of " +
                            shipped_file().string() + " too; give it an id of its own"),
            std::string::npos)
      << text.str();
  std::ostringstream same;
  EXPECT_EQ(run_check(std::vector<std::string>{shipped_file().string(), shipped_file().string()}, same), 0)
      << same.str();
}

TEST(Checker, AFolderIsAnsweredWithTheNamesOfItsScenarios) {
  const auto said = [](const std::filesystem::path& folder) {
    std::ostringstream text;
    EXPECT_EQ(run_check(std::vector<std::string>{folder.string()}, text), 1);
    return text.str();
  };
  const std::filesystem::path scenarios = source_folder() / "scenarios";
  EXPECT_NE(said(scenarios).find("write: mechane check " + (scenarios / "*/*.x3d").string()), std::string::npos);
  EXPECT_NE(said(scenarios / "village").find((scenarios / "village/*.x3d").string()), std::string::npos);
  EXPECT_NE(said(scenarios / "models").find("no scenario (.x3d) is in it"), std::string::npos);
}

}  // namespace
}  // namespace mechane::scenario
