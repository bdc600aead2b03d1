#include "server/scenario/checker.hpp"

#include <algorithm>
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

/// A warning on the line that holds `at`.
void expect_warning(const std::string& from, const std::string& to, ErrorCode code, const std::string& at,
                    const std::string& name) {
  const EditedFile file(from, to);
  const x3d::Problem problem = find_problem(check(file.path), code, line_of(text_of(file.path), at), name);
  EXPECT_EQ(problem.severity, x3d::Severity::warning) << to_string(problem);
}

TEST(Check, ShippedExhibitsAreWithoutFault) {
  ASSERT_FALSE(shipped_scenarios().empty());
  for (const auto& file : shipped_scenarios()) {
    for (const x3d::Problem& p : check(file))
      ADD_FAILURE() << to_string(p);
  }
}

/// Whether some caption of a language holds all these words.
bool a_caption_says(const state::WorldDescription& world, const std::string& language,
                    const std::vector<std::string>& words) {
  return std::ranges::any_of(world.steps, [&](const state::StepDescription& step) {
    const std::string& caption = step.texts.at("caption").at(language);
    return std::ranges::all_of(words, [&](const auto& word) { return caption.find(word) != std::string::npos; });
  });
}

TEST(Check, ShippedExhibitsSayHowTheirForceAndTimeAreScaledAndHaveAPage) {
  for (const auto& file : shipped_scenarios()) {
    FakeLoader loader;
    x3d::Problems problems(file.string());
    const auto world = read_scenario(file, loader, problems);
    ASSERT_TRUE(world) << world.error().to_string();
    const std::string page = text_of(std::filesystem::path(file).replace_extension(".md"));
    for (const char* words : {"## What is known", "`effort_scale`", "`time_scale`", "## Where it departs, and why"})
      EXPECT_NE(page.find(words), std::string::npos) << file << ": the page lacks " << words;
    if (world->id == "village") continue;  // a place to choose in: no machine works there
    EXPECT_NE(page.find("## The model"), std::string::npos) << file;
    EXPECT_TRUE(a_caption_says(*world, "en", {"our hand feels", "real"})) << file;
    EXPECT_TRUE(a_caption_says(*world, "el", {"ο χέρι", "πραγματικ"})) << file;
    EXPECT_TRUE(a_caption_says(*world, "en", {"time is real"}) || a_caption_says(*world, "en", {"times as fast"}))
        << file;
    EXPECT_TRUE(a_caption_says(*world, "el", {"ο χρόνος είναι ο πραγματικός"}) ||
                a_caption_says(*world, "el", {"φορές πιο γρήγορα"}))
        << file;
  }
}

TEST(Check, ShippedExhibitsHoldAgainstTheStandardsSchema) {
  const auto schema = shared_folder() / "x3d/schema/x3d-4.0.xsd";
  if (!std::filesystem::exists(schema)) GTEST_SKIP() << "the standard's schema is not beside the project";
  std::string files;
  for (const auto& file : shipped_scenarios())
    files += " '" + file.string() + "'";
  // Reading the schema takes most of the time.
  const std::string said = output_of("xmllint --nonet --noout --schema '" + schema.string() + "'" + files);
  EXPECT_TRUE(said.ends_with("exit 0")) << said;
  EXPECT_EQ(said.find("fails to validate"), std::string::npos) << said;
}

TEST(Check, AnotherReaderTakesShippedExhibitsWithoutWarning) {
  const test::ScratchFolder folder;
  // It locks what it reads: files of this test's own, as the test may run several times at once.
  const auto all = source_folder() / "scenarios";
  std::filesystem::copy(all, folder.path() / "scenarios", std::filesystem::copy_options::recursive);
  for (const auto& file : shipped_scenarios()) {
    const auto own = folder.path() / "scenarios" / file.lexically_relative(all);
    const std::string said = output_of("tovrmlx3d '" + own.string() + "' --encoding=xml");
    EXPECT_EQ(said.find("Warning:"), std::string::npos) << said.substr(said.find("Warning:"), 400);
    EXPECT_TRUE(said.ends_with("exit 0")) << said.substr(said.size() < 400 ? 0 : said.size() - 400);
  }
}

TEST(Check, WarnsOfWhatIsLikelyNotMeant) {
  expect_warning("name='next' value='\"seat\"'", "name='next' value='\"end\"'", ErrorCode::missing, "name='seat'>",
                 "step seat");
  expect_warning("name='caption.el' value='\"Γυρίστε", "name='captoin.el' value='\"Γυρίστε", ErrorCode::missing,
                 "name='turn'>", "caption is missing in: el");
  expect_warning("name='activity' value='\"assemble\"'", "name='activity' value='\"use\"'", ErrorCode::missing,
                 "name='assemble'>", "activity assemble");
  expect_warning("value='\"CARRY\" \"SEAT\"'/>",
                 "value='\"SEAT\"'/><MetadataString containerField='value' name='disable' value='\"CARRY\"'/>",
                 ErrorCode::conflict, "name='take'>", "'CARRY'");
  expect_warning("name='effortScale' value='0.0125'/>\n        <MetadataSet",
                 "name='colour' value='1'/>\n        <MetadataSet", ErrorCode::unknown_name, "name='colour'",
                 "'colour'");
}

TEST(Check, AnEffectsNodeIsLookedForInTheMeshFile) {
  const auto problems_of = [](const std::string& node, ErrorCode code) {
    const EditedFile file("'\"WATER_BASIN\"'", "'\"" + node + "\"'");
    std::vector<x3d::Problem> problems = check(file.path);
    EXPECT_EQ(problems.size(), 1u) << "one fault, one message";
    EXPECT_EQ(problems.at(0).code, code);
    EXPECT_FALSE(problems[0].remedy.empty());
    EXPECT_EQ(problems.at(0).severity, x3d::Severity::error);
    EXPECT_EQ(problems[0].line, line_of(text_of(file.path), "'\"" + node + "\"'"));
    EXPECT_NE(problems[0].node.find("effect "), std::string::npos);
    return to_string(problems[0]);
  };
  EXPECT_NE(problems_of("WATER_BASN", ErrorCode::unknown_name).find("did you mean 'WATER_BASIN'?"), std::string::npos);
  const std::string far = problems_of("POND", ErrorCode::unknown_name);
  EXPECT_NE(far.find("node 'POND' of ../models/archimedes-screw.glb"), std::string::npos) << far;
  for (const char* name : {"OUTER", "INNER", "SCENE", "WATER_BASIN", "WATER_RIVER"})
    EXPECT_NE(far.find(name), std::string::npos) << far;
  EXPECT_NE(problems_of("visual_quay", ErrorCode::conflict).find("WATER_visual_quay"), std::string::npos);
}

TEST(Check, AQuestionsFaultIsToldOnceAtItsOwnLine) {
  const std::string question =
      "<MetadataSet containerField='value' name='liked'>\n"
      "<MetadataString containerField='value' name='kind' value='\"scale\"'/>\n"
      "<MetadataSet containerField='value' name='text'>\n"
      "<MetadataString containerField='value' name='question.el' value='\"Σας άρεσε;\"'/>\n"
      "<MetadataString containerField='value' name='question.en' value='\"Did you like it?\"'/>\n"
      "<MetadataString containerField='value' name='low.el' value='\"λίγο\"'/>\n"
      "<MetadataString containerField='value' name='low.en' value='\"a little\"'/>\n"
      "<MetadataString containerField='value' name='high.el' value='\"πολύ\"'/>\n"
      "<MetadataString containerField='value' name='high.en' "
      "value='\"very\"'/>\n</MetadataSet></MetadataSet>\n";
  const std::string next = "              <MetadataSet containerField='value' name='lifts'>\n";
  const auto only_problem = [&](const std::string& from, const std::string& to) {
    std::string text = question + next;
    text.replace(text.find(from), from.size(), to);
    const EditedFile file(next, text);
    const std::vector<x3d::Problem> problems = check(file.path);
    EXPECT_EQ(problems.size(), 1u) << to;
    for (const x3d::Problem& p : problems)
      EXPECT_NE(p.node.find("activity use, question liked"), std::string::npos) << to_string(p);
    return problems.empty() ? x3d::Problem{} : problems[0];
  };
  const int first = line_of(edited(next, question + next), "name='liked'");
  const x3d::Problem kind = only_problem("\"scale\"", "\"scael\"");
  EXPECT_TRUE(is_problem(kind, ErrorCode::invalid_value, first + 1, "'scael'")) << to_string(kind);
  EXPECT_NE(kind.what.find("choice scale"), std::string::npos) << kind.what;
  const x3d::Problem key = only_problem("name='kind'", "name='knid'");
  EXPECT_TRUE(is_problem(key, ErrorCode::unknown_name, first + 1, "did you mean 'kind'?")) << to_string(key);
  const x3d::Problem lacks =
      only_problem("<MetadataString containerField='value' name='low.en' value='\"a little\"'/>\n", "");
  EXPECT_TRUE(is_problem(lacks, ErrorCode::missing, first, "low")) << to_string(lacks);
  EXPECT_TRUE(lacks.what.ends_with(": en")) << lacks.what;
}

TEST(Check, OneFaultIsOneMessageAtItsLine) {
  struct Typo {
    const char* from;
    const char* to;
    ErrorCode code;
    const char* name;
  };
  using enum ErrorCode;
  static constexpr Typo kTypos[] = {
      {"'\"simulation.grasp\"'", "'\"simulation.gasp\"'", unknown_name, "did you mean 'simulation.grasp'?"},
      {"name='diameter'", "name='diametre'", unknown_name, "did you mean 'diameter'?"},
      {"name='bodies' value='\"INNER\"'", "name='bodies' value='\"INNR\"'", unknown_name,
       "'INNR'; did you mean 'INNER'?"},
      {"name='steps'>", "name='stepps'>", unknown_name, "did you mean 'steps'?"},
      {"name='trigger:1'>", "name='triger'>", unknown_name, "did you mean 'trigger:1'?"},
      {"name='tolerance' value='0.06 0.26'", "name='tolerance' value='0.06'", invalid_value, "tolerance has 1"},
      {"value='\">\"'", "value='\">=\"'", invalid_value, "'>=' is not one of: < = >"},
      {"name='value' value='0.5'", "name='value' value='0,5'", invalid_value, "write a decimal point: 0.5"},
      {"'\"archimedes-screw\"'", "'\"Archimedes Screw\"'", invalid_value, "like archimedes-screw"},
      {"'\"Bring the screw", "'\"Don't bring the screw", damaged, "write &apos; there"},
  };
  for (const Typo& typo : kTypos) {
    const std::string text = edited(typo.from, typo.to);
    const Outcome outcome = compile_text(text);
    EXPECT_FALSE(outcome.world) << typo.to;
    ASSERT_FALSE(outcome.problems.empty()) << typo.to;
    EXPECT_TRUE(is_problem(outcome.problems[0], typo.code, line_of(text, typo.to), typo.name))
        << name_of(outcome.problems[0].code) << " " << to_string(outcome.problems[0]);
    for (std::size_t i = 1; i < outcome.problems.size(); ++i)
      ADD_FAILURE() << typo.to << " is reported again: " << to_string(outcome.problems[i]);
  }
}

/// Each value in a set of metadata of the shipped file, in its turn with a letter too many behind its quote or number.
TEST(Check, AValueThatCannotBeReadIsOneMessageWhateverItsKey) {
  const std::string whole = text_of(shipped_file());
  const std::string begin = " containerField='value' name='", value = "' value='";
  std::size_t tried = 0;
  for (std::size_t at = whole.find(begin); at != std::string::npos; at = whole.find(begin, at + 1)) {
    const std::size_t from = at + begin.size();
    const std::size_t end = whole.find('\'', whole.find('\'', from) + value.size());
    if (whole.compare(whole.find('\'', from), value.size(), value) != 0) continue;
    std::string text = whole;
    text.insert(end, "x");
    const Outcome outcome = compile_text(text);
    EXPECT_FALSE(outcome.world);
    ASSERT_FALSE(outcome.problems.empty()) << whole.substr(from, end - from);
    EXPECT_TRUE(is_problem(outcome.problems[0], ErrorCode::invalid_value, line_of(text, text.substr(at, end + 1 - at)),
                           "metadata '"))
        << to_string(outcome.problems[0]);
    for (std::size_t i = 1; i < outcome.problems.size(); ++i)
      ADD_FAILURE() << whole.substr(from, end - from) << " is reported again: " << to_string(outcome.problems[i]);
    ++tried;
  }
  EXPECT_GT(tried, 200u);
}

TEST(Check, ALanguageThatTheScenarioDoesNotNameIsToldOnce) {
  const EditedFile file("name='languages' value='\"el\" \"en\"'", "name='languages' value='\"el\"'");
  const std::vector<x3d::Problem> problems = check(file.path);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_TRUE(is_problem(problems[0], ErrorCode::unknown_name, kAnyLine, "'en'")) << to_string(problems[0]);
}

TEST(Check, WritesForPeopleAndForPrograms) {
  const EditedFile file("mass='42'", "mass='nan'");
  const std::vector<std::string> names{file.path.string()};
  std::ostringstream text;
  EXPECT_EQ(run_check(names, text), 1);
  const std::string place = file.path.string() + ":" + std::to_string(line_of(text_of(file.path), "mass='nan'"));
  EXPECT_NE(text.str().find(place + ": error: RigidBody INNER: mass: 'nan'"), std::string::npos) << text.str();
  EXPECT_NE(text.str().find("1 file: 1 error, 0 warnings\n"), std::string::npos) << text.str();
  std::ostringstream json;
  EXPECT_EQ(run_check(names, json, CheckFormat::json), 1);
  const auto parsed = nlohmann::json::parse(json.str());
  ASSERT_EQ(parsed.size(), 1u);
  EXPECT_EQ(parsed[0]["severity"], "error");
  EXPECT_EQ(parsed[0]["code"], "invalid_value");
  EXPECT_EQ(parsed[0]["file"], file.path.string());
  EXPECT_EQ(parsed[0]["line"], line_of(text_of(file.path), "mass='nan'"));
  EXPECT_EQ(parsed[0]["node"], "RigidBody INNER");
  EXPECT_FALSE(parsed[0]["what"].get<std::string>().empty());
  EXPECT_FALSE(parsed[0]["remedy"].get<std::string>().empty());
  std::ostringstream clean;
  EXPECT_EQ(run_check(std::vector<std::string>{shipped_file().string()}, clean), 0);
  std::ostringstream none;
  EXPECT_EQ(run_check({}, none), 2);
}

TEST(Checker, TwoFilesOfOneIdAreAnErrorButNotOneFileTwice) {
  const EditedFile copy("title='", "title='A copy of ");
  std::ostringstream json;
  EXPECT_EQ(run_check(std::vector<std::string>{shipped_file().string(), copy.path.string()}, json, CheckFormat::json),
            1);
  const auto parsed = nlohmann::json::parse(json.str());
  ASSERT_EQ(parsed.size(), 1u) << json.str();
  EXPECT_EQ(parsed[0]["code"], "duplicate");
  EXPECT_EQ(parsed[0]["file"], copy.path.string());
  const std::string what = parsed[0]["what"];
  EXPECT_NE(what.find("'archimedes-screw'"), std::string::npos) << what;
  EXPECT_NE(what.find(shipped_file().string()), std::string::npos) << what;
  EXPECT_FALSE(parsed[0]["remedy"].get<std::string>().empty());
  std::ostringstream same;
  EXPECT_EQ(run_check(std::vector<std::string>{shipped_file().string(), shipped_file().string()}, same), 0)
      << same.str();
}

TEST(Checker, AFolderIsAnsweredWithTheNamesOfItsScenarios) {
  const auto said = [](const std::filesystem::path& folder) {
    std::ostringstream json;
    EXPECT_EQ(run_check(std::vector<std::string>{folder.string()}, json, CheckFormat::json), 1);
    const auto parsed = nlohmann::json::parse(json.str());
    EXPECT_EQ(parsed.size(), 1u);
    return parsed.at(0).at("code").get<std::string>() + ": " + parsed[0].at("remedy").get<std::string>();
  };
  const std::filesystem::path scenarios = source_folder() / "scenarios";
  EXPECT_EQ(said(scenarios), "invalid_value: write: mechane check " + (scenarios / "*/*.x3d").string());
  EXPECT_EQ(said(scenarios / "village"),
            "invalid_value: write: mechane check " + (scenarios / "village/*.x3d").string());
  EXPECT_TRUE(said(scenarios / "models").starts_with("not_found: "));
}

}  // namespace
}  // namespace mechane::scenario
