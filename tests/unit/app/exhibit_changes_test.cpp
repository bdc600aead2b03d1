#include "server/app/exhibit_changes.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"

namespace mechane::app {
namespace {

std::shared_ptr<const state::WorldDescription> scenario(const std::string& id) {
  auto made = std::make_shared<state::WorldDescription>();
  made->id = id;
  return made;
}

ScenarioStore store_of(const std::vector<std::string>& ids) {
  ScenarioStore store;
  for (const std::string& id : ids)
    store.put(scenario(id), "/museum/" + id + ".x3d");
  return store;
}

TEST(ExhibitChanges, AreWhatDiffersFromTheSettings) {
  const std::vector<std::string> of_settings{"screw", "pump"};
  EXPECT_EQ(changes_since(of_settings, store_of({"screw", "pump"})), ExhibitChanges());
  const ExhibitChanges changes = changes_since(of_settings, store_of({"screw", "crane"}));
  EXPECT_EQ(changes, (ExhibitChanges{{{"crane", "/museum/crane.x3d"}}, {"pump"}}));
}

TEST(ExhibitChanges, AreReadAsTheyWereWritten) {
  const test::ScratchFolder scratch;
  const auto file = scratch.path() / "exhibits.json";
  EXPECT_EQ(read_changes(file), ExhibitChanges()) << "there is no file";
  const ExhibitChanges changes{{{"crane", "/museum/κρα\"νη.x3d"}}, {"pump", "screw"}};
  ASSERT_TRUE(write_changes(file, changes));
  EXPECT_EQ(read_changes(file), changes);
}

TEST(ExhibitChanges, ADamagedFileIsRefused) {
  const test::ScratchFolder scratch;
  const auto file = scratch.path() / "exhibits.json";
  for (const char* text : {"", "{", "[]", "{}", R"({"loaded": [], "retired": []})", R"({"loaded": {}, "retired": {}})",
                           R"({"loaded": {"crane": 1}, "retired": []})", R"({"loaded": {}, "retired": [1]})"}) {
    std::ofstream(file) << text;
    const auto read = read_changes(file);
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().code, ErrorCode::damaged);
    EXPECT_FALSE(read.error().remedy.empty());
  }
}

TEST(ExhibitChanges, HomeStaysAndABadFileIsLeftOut) {
  const test::ScratchFolder scratch;
  ScenarioStore store = store_of({"screw", "pump"});
  std::ofstream(scratch.path() / "crane.x3d") << "<X3D";
  make_again({{{"crane", scratch.path() / "crane.x3d"}, {"pump", "/nowhere.x3d"}}, {"screw", "pump", "mill"}},
             Settings(), store);
  EXPECT_EQ(store.ids(), std::vector<std::string>{"screw"}) << "home was retired once; the pump is retired; no crane";
}

}  // namespace
}  // namespace mechane::app
