#include "server/app/scenario_files.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/content/catalogue.hpp"
#include "server/content/content_hash.hpp"
#include "server/log/log.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::app {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A folder with a scenario and its model, both in a catalogue; and what was logged, on stderr.
class ScenarioFilesTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { log::start("test", log::Level::info); }
  ScenarioFilesTest() {
    auto catalogue = content::Catalogue::open(folder_ / "catalogue.db", content::Catalogue::Access::write);
    entries_ = {entry("crane.x3d", content::ContentKind::scenario), entry("crane.glb", content::ContentKind::model)};
    entries_[0].refers_to = {"crane.glb"};
    EXPECT_TRUE(catalogue->put(entries_));
  }
  [[nodiscard]] content::CatalogueEntry entry(const std::string& path, content::ContentKind kind) const {
    std::ofstream(folder_ / path) << path;
    content::CatalogueEntry entry;
    entry.path = path;
    entry.kind = kind;
    entry.name = "crane";
    entry.hash = *content::content_hash(folder_ / path);
    return entry;
  }
  Expected<std::vector<fs::path>> find(const fs::path& name) {
    testing::internal::CaptureStderr();
    auto files = find_scenarios(std::vector{name}, folder_ / "catalogue.db");
    said_ = testing::internal::GetCapturedStderr();
    return files;
  }

  const test::ScratchFolder scratch_;
  const fs::path& folder_ = scratch_.path();
  std::vector<content::CatalogueEntry> entries_;
  std::string said_;
};

TEST_F(ScenarioFilesTest, AnIdIsFoundAndAPathStays) {
  EXPECT_THAT(*find("crane"), ElementsAre(folder_ / "crane.x3d"));
  EXPECT_THAT(*find(folder_ / "crane.x3d"), ElementsAre(folder_ / "crane.x3d"));
  EXPECT_THAT(said_, Not(HasSubstr("catalogue")));
}

TEST_F(ScenarioFilesTest, AChangedFileThatTheScenarioNeedsIsSaid) {
  std::ofstream(folder_ / "crane.glb") << "something else";
  EXPECT_TRUE(find("crane"));
  EXPECT_THAT(said_, AllOf(HasSubstr("crane.glb"), HasSubstr("mechane content verify"), Not(HasSubstr("crane.x3d"))));
}

TEST_F(ScenarioFilesTest, AScenarioThatIsNotInTheCatalogueRuns) {
  std::ofstream(folder_ / "new.x3d") << "a scenario";
  EXPECT_THAT(*find(folder_ / "new.x3d"), ElementsAre(folder_ / "new.x3d"));
  EXPECT_THAT(said_, AllOf(HasSubstr("new.x3d"), HasSubstr("mechane content add")));
}

TEST_F(ScenarioFilesTest, WhatIsNeitherIsAnErrorWithTheIdsThatThereAre) {
  EXPECT_THAT(find("cranes").error(), test::is_error(ErrorCode::unknown_name, 0, {"'cranes'", "name one of: crane"}));
  fs::remove(folder_ / "catalogue.db");
  EXPECT_THAT(find("crane").error(), test::is_error(ErrorCode::not_found, 0, {"catalogue.db"}));
}

TEST_F(ScenarioFilesTest, WithoutACatalogueNamesStayAsTheyAre) {
  EXPECT_THAT(*find_scenarios(std::vector<fs::path>{"crane"}, ""), ElementsAre("crane"));
}

}  // namespace
}  // namespace mechane::app
