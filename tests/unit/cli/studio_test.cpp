// A script edits a file: an answer for each line, and the file changes when it is told to.
#include "client-sdk/cli/studio.hpp"

#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_files.hpp"

namespace mechane::cli {
namespace {

using test::ScratchFolder;
using test::shipped_file;
using test::text_of;

struct ScriptRun {
  int status = 0;
  std::vector<nlohmann::json> answers;
};

ScriptRun run_script(const std::filesystem::path& file, const std::string& script) {
  std::istringstream in(script);
  std::ostringstream out, errors;
  ScriptRun run{run_studio(file.string(), in, out, errors), {}};
  std::istringstream lines(out.str());
  for (std::string line; std::getline(lines, line);)
    run.answers.push_back(nlohmann::json::parse(line));
  return run;
}

TEST(StudioScript, EditsAndSaves) {
  const ScratchFolder folder;
  const std::string before = text_of(shipped_file());
  const auto file = folder.write("screw.x3d", before);
  const ScriptRun run = run_script(file, R"({"op": "set", "path": "effortScale", "value": 0.5}
{"do": "undo"}
{"do": "redo"}
{"do": "view"}
{"do": "save"}
)");
  EXPECT_EQ(run.status, 0);
  ASSERT_EQ(run.answers.size(), 5U);
  EXPECT_EQ(run.answers[0]["revision"], 1);
  EXPECT_EQ(run.answers[3]["undoes"], "set effortScale");
  EXPECT_EQ(run.answers[3]["revision"], 3);
  const std::string after = text_of(file);
  EXPECT_NE(after, before);
  EXPECT_NE(after.find("name='effortScale' value='0.5'"), std::string::npos);
}

TEST(StudioScript, ExportsWhatItHasWithTheMeshesOfIt) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder.path() / "in");
  std::filesystem::create_directory_symlink(test::source_folder() / "scenarios/models", folder.path() / "models");
  const auto file = folder.write("in/screw.x3d", text_of(shipped_file()));
  const ScriptRun run = run_script(file, R"({"op": "set", "path": "effortScale", "value": 0.5}
{"do": "export"}
)");
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.answers.at(1)["exported"], (folder.path() / "in/screw.zip").string());
  const std::string archive = text_of(folder.path() / "in/screw.zip");
  EXPECT_TRUE(archive.starts_with("PK"));
  EXPECT_NE(archive.find("screw/files/archimedes-screw.glb"), std::string::npos);
  EXPECT_NE(archive.find("name='effortScale' value='0.5'"), std::string::npos);
  const ScriptRun refused = run_script(folder.write("My Screw.x3d", text_of(shipped_file())), "{\"do\": \"export\"}\n");
  EXPECT_EQ(refused.status, 1);
}

TEST(StudioScript, WhatIsRefusedChangesNothing) {
  const ScratchFolder folder;
  const std::string before = text_of(shipped_file());
  const auto file = folder.write("screw.x3d", before);
  const ScriptRun run = run_script(file, R"({"op": "set", "path": "effortScal", "value": 0.5}
{"revision": 7, "commands": [{"op": "remove", "path": "effortScale"}]}
{"revision": 0, "commands": [{"op": "remove", "path": "effortScale"}, {"op": "remove", "path": "no/such"}]}
{"do": "fly"}
nothing
{"do": "redo"}
{"do": "text"}
)");
  EXPECT_EQ(run.status, 1);
  ASSERT_EQ(run.answers.size(), 7U);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_FALSE(run.answers[i].value("remedy", "").empty()) << run.answers[i];
  EXPECT_EQ(run.answers[2]["command"], 1);
  EXPECT_EQ(run.answers[6]["text"], before);
  EXPECT_EQ(text_of(file), before);
  EXPECT_EQ(run_script(folder.path() / "none.x3d", "").status, 2);
}

}  // namespace
}  // namespace mechane::cli
