// The shelf as a catalogue: who uses what, in all exhibits; what is said of files, and where it goes with them.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "client-sdk/studio/shelf/shelf.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_files.hpp"
#include "tests/unit/studio/studio_fixture.hpp"

namespace mechane::studio {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const Author kCurator{"eleni", 1'700'000'000};

/// The shipped exhibits with their models, and two drafts.
class ShelfCatalogue : public ::testing::Test {
 protected:
  ShelfCatalogue() {
    for (const char* name : {"archimedes-screw", "village", "LICENCE"})
      fs::copy(test::source_folder() / "scenarios" / name, scenarios_ / name, fs::copy_options::recursive);
    fs::create_directory_symlink(test::source_folder() / "scenarios/models", scenarios_ / "models");
    right(shelf_.begin("first", "template:empty", kCurator));
    right(shelf_.begin("second", "template:empty", kCurator));
  }
  static json right(const ShelfResult<std::string>& result) {
    EXPECT_TRUE(result) << (result ? "" : result.error().error.to_string());
    return result ? json::parse(*result) : json();
  }
  void bring(const std::string& name, const std::string& file, const std::string& bytes) {
    right(shelf_.add_file(name, file, std::as_bytes(std::span(bytes)), false));
  }
  void set_sound(const std::string& name, std::int64_t revision, const std::string& url) {
    const auto list = parse_command_list(
        R"({"revision": )" + std::to_string(revision) +
        R"(, "commands": [{"op": "set", "path": "activities/try/steps/first/text/audio.el", "value": ")" + url +
        "\"}]}");
    right(shelf_.change(name, *list, kCurator));
  }
  json describe(const std::string& path, const Record& about) {
    return right(shelf_.describe({path, about, std::nullopt}));
  }
  std::map<std::string, json> items(const CatalogueQuery& query = {}) {
    std::map<std::string, json> out;
    const json answer = right(shelf_.catalogue(query));
    for (const json& item : answer["items"])
      out[item["path"].get<std::string>().empty() ? item["name"] : item["path"]] = item;
    return out;
  }

  test::ScratchFolder folder_;
  fs::path scenarios_ = [this] {
    fs::create_directories(folder_.path() / "scenarios");
    return folder_.path() / "scenarios";
  }();
  Shelf shelf_{scenarios_, folder_.path() / "state"};
};

TEST_F(ShelfCatalogue, HasAllThatTheMuseumHasWithItsUsers) {
  bring("first", "turn.ogg", "OggS");
  const auto all = items();
  EXPECT_EQ(all.at("first/first.x3d")["draft"], true);
  EXPECT_EQ(all.at("first/first.x3d")["published"], false);
  EXPECT_EQ(all.at("archimedes-screw/archimedes-screw.x3d")["about"]["licence"], "Apache-2.0");
  EXPECT_EQ(all.at("archimedes-screw/archimedes-screw.x3d")["about"]["languages"], json({"el", "en"}));
  const json& opened = all.at("archimedes-screw/archimedes-screw.x3d")["uses"];
  ASSERT_EQ(opened.size(), 1U) << "a step of the village leads there";
  EXPECT_EQ(opened[0]["exhibit"], "village");
  const json& model = all.at("models/archimedes-screw.glb");
  EXPECT_EQ(model["kind"], "mesh");
  EXPECT_EQ(model["about"]["licence"], "Apache-2.0") << "by the note beside it";
  EXPECT_EQ(model["uses"][0]["exhibit"], "archimedes-screw");
  EXPECT_GT(model["uses"][0]["line"], 0);
  const json& sound = all.at("first/files/turn.ogg");
  EXPECT_EQ(sound["about"]["licence"], "") << "an author brought it";
  EXPECT_TRUE(sound["uses"].empty());
  EXPECT_EQ(all.at("crank")["kind"], "part");
  EXPECT_EQ(all.at("crank-and-rope")["kind"], "template");
  EXPECT_THAT(items({.text = "κοχλιασ αρχιμηδη"}),
              ::testing::Contains(::testing::Key("archimedes-screw/archimedes-screw.x3d")));
  EXPECT_EQ(right(shelf_.catalogue({.kind = "draft"}))["items"].size(), 2U);
}

TEST_F(ShelfCatalogue, AFileIsNotDeletedWhileAnyExhibitNamesIt) {
  bring("first", "turn.ogg", "OggS");
  std::int64_t revision = 0;
  for (const char* url :
       {"../first/files/turn.ogg", "../first/./files/../files/turn.ogg", "files/../../first/files/turn.ogg"}) {
    set_sound("second", revision, url);
    const auto refused = shelf_.remove_file("first", "turn.ogg");
    ASSERT_FALSE(refused) << url;
    ASSERT_EQ(refused.error().uses.size(), 1U);
    const FileUse& use = refused.error().uses.front();
    EXPECT_EQ(use.exhibit, "second");
    EXPECT_EQ(use.place, "audio.el of first");
    EXPECT_TRUE(use.draft);
    EXPECT_EQ(items().at("first/files/turn.ogg")["about"]["languages"], json({"el"}));
    right(shelf_.undo("second", revision + 1, kCurator));
    revision += 2;
  }
  describe("first/files/turn.ogg", {"A creak", {}, {}, {}});
  right(shelf_.remove_file("first", "turn.ogg"));
  bring("first", "turn.ogg", "OggS another");
  EXPECT_EQ(items().at("first/files/turn.ogg")["about"]["description"], "") << "what was said was of the other";
}

TEST_F(ShelfCatalogue, WhatIsSaidOfAFileGoesWithItsCopies) {
  bring("first", "turn.ogg", "OggS");
  bring("second", "turn.ogg", "OggS another");
  const Record about{"Το τρίξιμο", {"CC0-1.0", "", "Ελένη", ""}, {"τρίξιμο"}, {}};
  describe("first/files/turn.ogg", about);
  const json taken = right(shelf_.take_file("second", "first/files/turn.ogg"));
  EXPECT_EQ(taken["taken"], "turn-2.ogg");
  EXPECT_EQ(taken["files"].size(), 2U);
  EXPECT_EQ(right(shelf_.take_file("second", "first/files/turn.ogg"))["taken"], "turn-2.ogg") << "it is there already";
  EXPECT_EQ(right(shelf_.take_file("second", "models/archimedes-screw.glb"))["taken"], "archimedes-screw.glb");
  const auto tagged = items({.tag = "ΤΡΙΞΙΜΟ"});
  EXPECT_EQ(tagged.size(), 2U);
  EXPECT_EQ(tagged.at("second/files/turn-2.ogg")["about"]["author"], "Ελένη");
  EXPECT_EQ(items().at("second/files/archimedes-screw.glb")["about"]["licence"], "Apache-2.0");
  // What others have written meanwhile is not overwritten unseen.
  const auto late = shelf_.describe({"first/files/turn.ogg", {}, Record{"an older text", {}, {}, {}}});
  EXPECT_THAT(late.error().error, is_fault(ErrorCode::conflict));
  right(shelf_.describe({"first/files/turn.ogg", {}, about}));
  EXPECT_EQ(items({.tag = "τριξιμο"}).size(), 1U);
}

TEST_F(ShelfCatalogue, NothingButMeshesAndSoundsOfTheMuseumIsTaken) {
  std::ofstream(folder_.path() / "secret.glb") << "glTF";
  fs::create_directories(scenarios_ / "archimedes-screw/.preview");
  std::ofstream(scenarios_ / "archimedes-screw/.preview/a.glb") << "glTF";
  for (const char* path :
       {"../secret.glb", "models/../../secret.glb", "archimedes-screw/archimedes-screw.x3d", "LICENCE", "",
        "archimedes-screw/.preview/a.glb", "first/draft.x3d", "models", "first/files/no.glb"}) {
    EXPECT_EQ(shelf_.take_file("first", path).error().error.code, ErrorCode::not_found) << path;
    EXPECT_EQ(shelf_.describe({path, {}, std::nullopt}).error().error.code, ErrorCode::not_found) << path;
  }
  EXPECT_TRUE(right(shelf_.files("first"))["files"].empty());
}

TEST_F(ShelfCatalogue, DamagedRecordsAreToldAndNotOverwritten) {
  bring("first", "turn.ogg", "OggS");
  const fs::path file = folder_.path() / "state/catalogue.json";
  std::ofstream(file) << R"({"files": {"first/files/turn.ogg": {"tags": [1]}}})";
  const json told = right(shelf_.catalogue({}));
  EXPECT_THAT(told["notice"]["remedy"].get<std::string>(), ::testing::HasSubstr("catalogue.json"));
  EXPECT_FALSE(told["items"].empty());
  EXPECT_EQ(shelf_.describe({"first/files/turn.ogg", {"new", {}, {}, {}}, std::nullopt}).error().error.code,
            ErrorCode::damaged);
  EXPECT_THAT(test::text_of(file), ::testing::HasSubstr("[1]"));
}

}  // namespace
}  // namespace mechane::studio
