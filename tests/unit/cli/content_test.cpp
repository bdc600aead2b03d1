#include "client-sdk/cli/content.hpp"

#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_folder.hpp"

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
    options_.catalogue = folder_ / "scenarios/catalogue.db";
    for (const char* path :
         {"archimedes-screw/archimedes-screw.x3d", "archimedes-screw/archimedes-screw.md",
          "models/archimedes-screw.glb", "pulley-crane/pulley-crane.x3d", "pulley-crane/pulley-crane.md",
          "models/pulley-crane.glb", "models/modelling.py", "REFERENCE.md"}) {
      fs::create_directories((folder_ / "scenarios" / path).parent_path());
      fs::copy_file(mechane::test::source_folder() / "scenarios" / path, folder_ / "scenarios" / path);
    }
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

  const test::ScratchFolder scratch_;
  const fs::path& folder_ = scratch_.path();
  ContentOptions options_;
  std::string out_;
  std::string errors_;
};

TEST_F(ContentTest, TheShippedFolderIsAddedAndNothingIsWrongWithIt) {
  ASSERT_EQ(add_all(), 0) << errors_;
  EXPECT_THAT(out_, HasSubstr("6 added, 0 changed, 0 unchanged"));
  EXPECT_EQ(run("verify"), 0) << out_;
  EXPECT_THAT(out_, AllOf(HasSubstr("6 files"), HasSubstr("all as recorded in the catalogue")));
  ASSERT_EQ(add_all(), 0);
  EXPECT_THAT(out_, AllOf(HasSubstr("0 added, 0 changed, 6 unchanged"), Not(HasSubstr(".glb"))));
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
  EXPECT_THAT(out_, AllOf(HasSubstr("archimedes-screw.x3d: language: these words are missing in 'de'"),
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
  EXPECT_THAT(out_, HasSubstr(" archimedes-screw/archimedes-screw.x3d\n"));
  EXPECT_EQ(run("add", {"archimedes-screw/archimedes-screw.x3d"}), 0) << errors_;
}

TEST_F(ContentTest, ANameThatSeveralFilesHaveRemovesNone) {
  ASSERT_EQ(add_all(), 0);
  EXPECT_EQ(run("remove", {"pulley-crane"}), 1);
  EXPECT_THAT(errors_, AllOf(HasSubstr("this names 3 files"), HasSubstr("models/pulley-crane.glb")));
  EXPECT_EQ(json("list").size(), 6U);
}

TEST_F(ContentTest, WhatAScenarioOpensIsExportedWithIt) {
  const fs::path shipped = mechane::test::source_folder() / "scenarios";
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
  EXPECT_THAT(errors_, HasSubstr("a catalogue does not keep this kind of file"));
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

TEST_F(ContentTest, RemediesNameTheCatalogueAndTakeBlanks) {
  const fs::path blank = folder_ / "scenarios/archimedes screw.md";
  std::ofstream(folder_ / "scenarios/archimedes screw.x3d") << "no scenario; it makes the page content\n";
  std::ofstream(blank) << "A page.\n";
  ASSERT_EQ(run("add", {(folder_ / "scenarios/models").string()}), 0) << errors_;
  EXPECT_EQ(run("verify"), 1);
  const std::string catalogue = options_.catalogue.string();
  EXPECT_THAT(out_, HasSubstr("mechane content add --catalogue " + catalogue + " 'archimedes screw.md'"));
  EXPECT_THAT(out_, HasSubstr("mechane content remove --catalogue " + catalogue + " models/pulley-crane.glb"));
}

TEST_F(ContentTest, ABrokenOrEmptyModelIsRefusedAndNoCatalogueIsLeft) {
  const fs::path models = folder_ / "scenarios/models";
  std::ofstream(models / "broken.glb") << "glTF and nothing more";
  std::ofstream(models / "empty.obj") << "";
  EXPECT_EQ(run("add", {(models / "broken.glb").string(), (models / "empty.obj").string()}), 1);
  EXPECT_THAT(errors_, AllOf(HasSubstr("broken.glb"), HasSubstr("empty.obj: the file is empty")));
  EXPECT_FALSE(fs::exists(options_.catalogue)) << "an add that added nothing made one";
  EXPECT_EQ(run("remove", {"x"}), 1);
  EXPECT_FALSE(fs::exists(options_.catalogue)) << "a removal made one";
  EXPECT_EQ(add_all(), 1);
  EXPECT_THAT(out_, HasSubstr("6 added")) << "the good ones are";
}

TEST_F(ContentTest, ALinkIsNotTaken) {
  const fs::path link = folder_ / "scenarios/models/linked.glb";
  fs::create_symlink(folder_ / "scenarios/models/pulley-crane.glb", link);
  EXPECT_EQ(run("add", {link.string()}), 1);
  EXPECT_THAT(errors_, HasSubstr("linked.glb: this is a link"));
}

TEST_F(ContentTest, AnEmptyFileIsACatalogueThatIsYetToBeMadeAndADamagedOneIsMadeAnew) {
  std::ofstream(options_.catalogue) << "";
  EXPECT_EQ(run("list"), 1);
  EXPECT_THAT(errors_, AllOf(HasSubstr("the file is empty"), HasSubstr("mechane content add")));
  ASSERT_EQ(add_all(), 0) << errors_;
  EXPECT_EQ(run("verify"), 0) << out_;
  std::fstream(options_.catalogue, std::ios::in | std::ios::out | std::ios::binary) << "damage at the beginning";
  EXPECT_EQ(run("list"), 1);
  const std::string file = options_.catalogue.string();
  EXPECT_THAT(errors_, HasSubstr("mv " + file + " " + file + ".damaged && mechane content add --catalogue " + file +
                                 " " + (folder_ / "scenarios").string()));
  fs::rename(options_.catalogue, file + ".damaged");
  EXPECT_EQ(add_all(), 0) << "the remedy helps: " << errors_;
}

TEST_F(ContentTest, AnExportStaysOutOfTheCataloguesFolder) {
  ASSERT_EQ(add_all(), 0);
  for (const char* inside : {"scenarios", "scenarios/kiosk", "scenarios/models/../kiosk/"}) {
    options_.folder = (folder_ / inside).string();
    EXPECT_EQ(run("export"), 1) << inside;
    EXPECT_THAT(errors_, HasSubstr("the catalogue's own folder")) << inside;
  }
  EXPECT_FALSE(fs::exists(folder_ / "scenarios/kiosk"));
  options_.folder = (folder_ / "scenarios-of-a-kiosk").string();
  ASSERT_EQ(run("export", {"pulley-crane/pulley-crane.x3d"}), 0) << errors_;
  EXPECT_THAT(out_, HasSubstr("1 named, and 2 that they refer to"));
}

TEST_F(ContentTest, WhatRefersToARenamedFileIsRetoldAndNotChanged) {
  const fs::path page = folder_ / "scenarios/pulley-crane/pulley-crane.md";
  ASSERT_EQ(add_all(), 0);
  fs::rename(page, page.parent_path() / "pulley-crane.en.md");
  ASSERT_EQ(add_all(), 0);
  EXPECT_THAT(out_, AllOf(HasSubstr("added    pulley-crane/pulley-crane.en.md"), HasSubstr("0 changed, 1 updated"),
                          HasSubstr("updated  pulley-crane/pulley-crane.x3d: the same file")));
}

TEST_F(ContentTest, ALicenceNoteSpeaksForWhatSaysNothing) {
  const fs::path scenarios = folder_ / "scenarios";
  fs::copy_file(mechane::test::source_folder() / "scenarios/LICENCE", scenarios / "LICENCE");
  std::ofstream(scenarios / "pulley-crane/LICENSE") << "SPDX-License-Identifier: CC-BY-4.0\n";
  options_.credits.licence = "CC0-1.0";
  ASSERT_EQ(run("add", {(scenarios / "models/pulley-crane.glb").string()}), 0);
  options_.credits = {};
  ASSERT_EQ(add_all(), 0);
  const auto licence = [&](const char* path) { return json("show", {path}).at(0)["licence"].get<std::string>(); };
  EXPECT_EQ(licence("models/pulley-crane.glb"), "CC0-1.0") << "a person said so";
  EXPECT_EQ(licence("models/archimedes-screw.glb"), "Apache-2.0");
  EXPECT_EQ(licence("pulley-crane/pulley-crane.md"), "CC-BY-4.0") << "the nearest counts";
  EXPECT_EQ(licence("pulley-crane/pulley-crane.x3d"), "Apache-2.0") << "the file says so itself";
  ASSERT_EQ(run("verify"), 0);
  EXPECT_THAT(out_, Not(HasSubstr("no licence")));
}

TEST_F(ContentTest, WhatAModelRefersToIsTakenAlong) {
  const fs::path models = folder_ / "scenarios/models";
  std::ofstream(models / "stool.obj")
      << "mtllib stool.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  std::ofstream(models / "stool.mtl") << "newmtl wood\nmap_Kd -s 1 1 1 oak.png\n";
  std::ofstream(models / "oak.png") << "\x89PNG\r\n\x1a\n not decoded here";
  edit_screw("../models/archimedes-screw.glb", "../models/stool.obj");
  ASSERT_EQ(run("add", {(models / "stool.obj").string()}), 0) << errors_;
  EXPECT_THAT(out_, AllOf(HasSubstr("models/stool.mtl"), HasSubstr("models/oak.png"), HasSubstr("3 added")));
  EXPECT_EQ(json("show", {"models/stool.obj"}).at(0)["refers_to"],
            (std::vector<std::string>{"models/oak.png", "models/stool.mtl"}));
  options_.folder = (folder_ / "kiosk").string();
  ASSERT_EQ(run("export", {"models/stool.obj"}), 0) << errors_;
  EXPECT_TRUE(fs::exists(folder_ / "kiosk/models/oak.png"));
  fs::remove(models / "stool.mtl");
  EXPECT_EQ(run("verify"), 1);
  EXPECT_THAT(out_, HasSubstr("models/stool.mtl: gone"));
}

}  // namespace
}  // namespace mechane::cli
