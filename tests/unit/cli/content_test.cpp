#include "client-sdk/cli/content.hpp"

#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace mechane::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Two shipped scenarios with their models and pages, copied to a folder of the test; and what the command said last.
class ContentTest : public testing::Test {
 protected:
  ContentTest() {
    std::string name = (fs::temp_directory_path() / "mechane-cli-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    options_.catalogue = folder_ / "scenarios/catalogue.db";
    for (const char* path :
         {"archimedes-screw/archimedes-screw.x3d", "archimedes-screw/archimedes-screw.md",
          "models/archimedes-screw.glb", "pulley-crane/pulley-crane.x3d", "pulley-crane/pulley-crane.md",
          "models/pulley-crane.glb", "models/modelling.py", "REFERENCE.md"}) {
      fs::create_directories((folder_ / "scenarios" / path).parent_path());
      fs::copy_file(fs::path(MECHANE_SOURCE_DIR) / "scenarios" / path, folder_ / "scenarios" / path);
    }
  }
  void TearDown() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  int run(std::string_view verb, const std::vector<std::string>& words = {}) {
    options_.words = words;
    std::ostringstream out;
    std::ostringstream errors;
    const int status = run_content(verb, options_, out, errors);
    out_ = out.str();
    errors_ = errors.str();
    return status;
  }
  int add_all() { return run("add", {(folder_ / "scenarios").string()}); }
  nlohmann::json json(std::string_view verb, const std::vector<std::string>& words = {}) {
    options_.json = true;
    EXPECT_EQ(run(verb, words), 0) << errors_;
    options_.json = false;
    return nlohmann::json::parse(out_);
  }
  /// Changes the first `from` of the screw's scenario.
  void edit_screw(const std::string& from, const std::string& to) const {
    const fs::path file = folder_ / "scenarios/archimedes-screw/archimedes-screw.x3d";
    std::stringstream bytes;
    bytes << std::ifstream(file).rdbuf();
    std::string text = bytes.str();
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << "the shipped file no longer holds: " << from;
    std::ofstream(file) << text.replace(at, from.size(), to);
  }

  fs::path folder_;
  ContentOptions options_;
  std::string out_;
  std::string errors_;
};

TEST_F(ContentTest, TheShippedFolderIsAddedAndNothingIsWrongWithIt) {
  ASSERT_EQ(add_all(), 0) << errors_;
  EXPECT_THAT(out_, HasSubstr("6 added, 0 changed, 0 as they were"));
  EXPECT_EQ(run("verify"), 0) << out_;
  EXPECT_THAT(out_, AllOf(HasSubstr("6 files"), HasSubstr("each as the catalogue says")));
  ASSERT_EQ(add_all(), 0);
  EXPECT_THAT(out_, AllOf(HasSubstr("0 added, 0 changed, 6 as they were"), Not(HasSubstr(".glb"))));
}

TEST_F(ContentTest, AScenarioAloneBringsWhatItNeeds) {
  ASSERT_EQ(run("add", {(folder_ / "scenarios/pulley-crane/pulley-crane.x3d").string()}), 0) << errors_;
  EXPECT_THAT(out_, AllOf(HasSubstr("models/pulley-crane.glb"), HasSubstr("pulley-crane.md"), HasSubstr("3 added")));
}

TEST_F(ContentTest, WhatAScenarioSaysOfItselfIsShown) {
  ASSERT_EQ(add_all(), 0);
  ASSERT_EQ(run("show", {"archimedes-screw/archimedes-screw.x3d"}), 0) << errors_;
  EXPECT_THAT(out_,
              AllOf(HasSubstr("archimedes-screw (scenario)"), HasSubstr("Ο κοχλίας του Αρχιμήδη"), HasSubstr("el en"),
                    HasSubstr("Apache-2.0"), HasSubstr("models/archimedes-screw.glb"), Not(HasSubstr("lacks"))));
  ASSERT_EQ(run("show", {"models/archimedes-screw.glb"}), 0);
  EXPECT_THAT(out_, HasSubstr("used by     archimedes-screw/archimedes-screw.x3d"));
  EXPECT_EQ(run("show", {"no such thing"}), 1);
  EXPECT_THAT(errors_, HasSubstr("mechane content list"));
}

TEST_F(ContentTest, FlagsAddAndOverrideAndStay) {
  options_.credits = {.licence = "CC-BY-4.0", .source = "", .author = "A. Person", .version = ""};
  options_.tags = {"water"};
  const std::string model = (folder_ / "scenarios/models/archimedes-screw.glb").string();
  ASSERT_EQ(run("add", {model}), 0);
  options_.credits = {};
  options_.tags = {"bronze"};
  ASSERT_EQ(add_all(), 0);
  const nlohmann::json entry = json("show", {"models/archimedes-screw.glb"}).at(0);
  EXPECT_EQ(entry["licence"], "CC-BY-4.0");
  EXPECT_EQ(entry["author"], "A. Person");
  EXPECT_EQ(entry["tags"], (std::vector<std::string>{"bronze", "water"}));
}

TEST_F(ContentTest, AListIsNarrowedByKindTagAndLanguage) {
  options_.tags = {"shown in spring"};
  ASSERT_EQ(run("add", {(folder_ / "scenarios/archimedes-screw").string()}), 0);
  ASSERT_EQ(add_all(), 0);
  const auto listed = [&](const std::string& kind, const std::string& tag, const std::string& language) {
    options_.kind = kind;
    options_.tag = tag;
    options_.language = language;
    return json("list").size();
  };
  EXPECT_EQ(listed("", "", ""), 6U);
  EXPECT_EQ(listed("model", "", ""), 2U);
  EXPECT_EQ(listed("scenario", "", "el"), 2U);
  EXPECT_EQ(listed("scenario", "", "de"), 0U);
  EXPECT_EQ(listed("", "absent", ""), 0U);
  options_.kind = "film";
  EXPECT_EQ(run("list"), 2);
}

TEST_F(ContentTest, VerifyNamesAChangedFileALackingLanguageAndAnOrphan) {
  ASSERT_EQ(add_all(), 0);
  edit_screw("title.en", "title.EN");
  EXPECT_EQ(run("verify"), 1);
  EXPECT_THAT(out_, AllOf(HasSubstr("archimedes-screw.x3d: changed"), HasSubstr("1 fault\n")));
  edit_screw("title.EN", "title.en");
  edit_screw(R"('"el" "en"')", R"('"el" "en" "de"')");
  edit_screw("../models/archimedes-screw.glb", "../models/pulley-crane.glb");
  ASSERT_EQ(add_all(), 0) << errors_;
  EXPECT_EQ(run("verify"), 1);
  EXPECT_THAT(out_, AllOf(HasSubstr("archimedes-screw.x3d: language: in 'de' it lacks"),
                          HasSubstr("models/archimedes-screw.glb: orphan"), HasSubstr("2 faults")));
  ASSERT_EQ(run("show", {"archimedes-screw/archimedes-screw.x3d"}), 0);
  EXPECT_THAT(out_, AllOf(HasSubstr("  lacks in de activity "), HasSubstr("\n              title\n")));
  ASSERT_EQ(run("remove", {"models/archimedes-screw.glb"}), 0);
  EXPECT_EQ(run("verify"), 1);
  EXPECT_THAT(out_, HasSubstr("models/archimedes-screw.glb: unknown"));
}

TEST_F(ContentTest, ARemedyOfVerifyWorksAsItIsWritten) {
  ASSERT_EQ(add_all(), 0);
  edit_screw("</X3D>", "</X3D>\n");
  ASSERT_EQ(run("verify"), 1);
  EXPECT_THAT(out_, HasSubstr("mechane content add archimedes-screw/archimedes-screw.x3d"));
  EXPECT_EQ(run("add", {"archimedes-screw/archimedes-screw.x3d"}), 0) << errors_;
}

TEST_F(ContentTest, ANameThatSeveralFilesHaveRemovesNone) {
  ASSERT_EQ(add_all(), 0);
  EXPECT_EQ(run("remove", {"pulley-crane"}), 1);
  EXPECT_THAT(errors_, AllOf(HasSubstr("it names 3 files"), HasSubstr("models/pulley-crane.glb")));
  EXPECT_EQ(json("list").size(), 6U);
}

TEST_F(ContentTest, WhatAScenarioOpensIsExportedWithIt) {
  const fs::path shipped = fs::path(MECHANE_SOURCE_DIR) / "scenarios";
  fs::create_directories(folder_ / "scenarios/village");
  fs::copy_file(shipped / "village/village.x3d", folder_ / "scenarios/village/village.x3d");
  fs::copy_file(shipped / "models/village.glb", folder_ / "scenarios/models/village.glb");
  ASSERT_EQ(add_all(), 0) << errors_;
  options_.folder = (folder_ / "kiosk").string();
  ASSERT_EQ(run("export", {"village/village.x3d"}), 0) << errors_;
  EXPECT_THAT(out_, HasSubstr("8 files")) << "itself and its model, two exhibits with a model and a page each";
}

TEST_F(ContentTest, ABrokenScenarioIsNotAddedAndTheOthersAre) {
  edit_screw("<Scene>", "<Scene");
  EXPECT_EQ(add_all(), 1);
  EXPECT_THAT(errors_, HasSubstr("archimedes-screw.x3d:"));
  EXPECT_THAT(out_, HasSubstr("5 added"));
  EXPECT_EQ(run("add", {(folder_ / "scenarios/models/modelling.py").string()}), 1);
  EXPECT_THAT(errors_, HasSubstr("this is no content"));
}

TEST_F(ContentTest, AnExportOfOneExhibitHasWhatItNeedsAndVerifies) {
  ASSERT_EQ(add_all(), 0);
  options_.folder = (folder_ / "kiosk").string();
  ASSERT_EQ(run("export", {"pulley-crane/pulley-crane.x3d"}), 0) << errors_;
  EXPECT_THAT(out_, HasSubstr("3 files"));
  options_.catalogue = folder_ / "kiosk/catalogue.db";
  EXPECT_EQ(run("verify"), 0) << out_;
  EXPECT_TRUE(fs::exists(folder_ / "kiosk/models/pulley-crane.glb"));
  EXPECT_FALSE(fs::exists(folder_ / "kiosk/models/archimedes-screw.glb"));
}

TEST_F(ContentTest, WithoutACatalogueEachVerbSaysHowToMakeOne) {
  options_.folder = (folder_ / "kiosk").string();
  for (const char* verb : {"list", "show", "verify", "export"}) {
    EXPECT_EQ(run(verb, {"x"}), 1) << verb;
    EXPECT_THAT(errors_, HasSubstr("mechane content add")) << verb;
    EXPECT_THAT(out_, IsEmpty()) << verb;
  }
  EXPECT_FALSE(fs::exists(options_.catalogue)) << "looking made one";
}

TEST_F(ContentTest, AHostileNameDoesNotReachTheTerminal) {
  ASSERT_EQ(add_all(), 0);
  options_.tags = {"\x1b[2J"};
  ASSERT_EQ(add_all(), 0);
  ASSERT_EQ(run("show", {"models/pulley-crane.glb"}), 0);
  EXPECT_THAT(out_, AllOf(HasSubstr("?[2J"), Not(HasSubstr("\x1b"))));
}

}  // namespace
}  // namespace mechane::cli
