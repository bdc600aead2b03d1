// Drafts on the shelf: whose they are, who was first, what is published and what is kept.
#include "client-sdk/studio/shelf/shelf.hpp"

#include <cmath>
#include <fstream>
#include <numbers>
#include <span>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "client-sdk/studio/draft/preview_file.hpp"
#include "client-sdk/studio/edits/parts.hpp"
#include "client-sdk/studio/view/schema_json.hpp"
#include "client-sdk/studio/view/view.hpp"
#include "server/scenario/checker.hpp"
#include "server/scenario/mesh_finder.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_files.hpp"
#include "tests/unit/studio/studio_fixture.hpp"

namespace mechane::studio {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace std::string_literals;
using test::ScratchFolder;
using test::source_folder;
using test::text_of;

const Author kEleni{"eleni", 1'700'000'000};
const Author kNikos{"nikos", 1'700'000'100};

/// A museum with one exhibit that has a mesh file.
struct Museum {
  Museum() {
    fs::create_directories(folder.path() / "scenarios");
    fs::copy(source_folder() / "scenarios/archimedes-screw", scenarios() / "archimedes-screw",
             fs::copy_options::recursive);
    fs::create_directory_symlink(source_folder() / "scenarios/models", scenarios() / "models");
  }
  [[nodiscard]] fs::path scenarios() const { return folder.path() / "scenarios"; }
  [[nodiscard]] fs::path state() const { return folder.path() / "state"; }
  [[nodiscard]] fs::path screw() const { return scenarios() / "archimedes-screw/archimedes-screw.x3d"; }
  [[nodiscard]] Shelf shelf() const { return {scenarios(), state()}; }

  ScratchFolder folder;
};

json right(const ShelfResult<std::string>& result) {
  EXPECT_TRUE(result) << (result ? "" : result.error().error.to_string());
  return result ? json::parse(*result) : json();
}

CommandList command_list(std::int64_t revision, const std::string& list) {
  auto parsed = parse_command_list(R"({"revision": )" + std::to_string(revision) + R"(, "commands": )" + list + "}");
  EXPECT_TRUE(parsed) << list;
  return *parsed;
}

constexpr const char* kHalf = R"([{"op": "set", "path": "effortScale", "value": 0.5}])";

std::string listed_picture(Shelf& shelf) {
  const json picture = right(shelf.list())["exhibits"][0]["picture"];
  return picture.is_null() ? "" : picture.get<std::string>();
}

TEST(Shelf, APictureGoesWithTheDraftThatIsPublished) {
  constexpr const char* kScrew = "archimedes-screw";
  const Museum museum;
  const fs::path shipped = museum.screw().parent_path() / "picture.webp";
  fs::remove(shipped);
  Shelf shelf = museum.shelf();
  EXPECT_EQ(listed_picture(shelf), "");
  EXPECT_EQ(shelf.picture(kScrew).error().error.code, ErrorCode::not_found);
  const std::string webp("RIFF\x0A\0\0\0WEBPVP8 .."s), other("RIFF\x0A\0\0\0WEBPVP8 ::"s);
  const auto set = [&](const std::string& bytes) { return shelf.set_picture(kScrew, std::as_bytes(std::span(bytes))); };
  EXPECT_EQ(set(webp).error().error.code, ErrorCode::not_found) << "there is no draft";
  right(shelf.begin(kScrew, std::string("exhibit:") + kScrew, kEleni));
  for (const std::string& bad : {std::string(), std::string("<svg/>"), webp + "more", webp.substr(0, 11)})
    EXPECT_EQ(set(bad).error().error.code, ErrorCode::invalid_value) << bad;
  right(set(webp));
  const std::string first = listed_picture(shelf);
  EXPECT_NE(first, "");
  EXPECT_EQ(*shelf.picture(kScrew), webp);
  EXPECT_FALSE(fs::exists(shipped));
  right(shelf.publish(kScrew, 0, kEleni));
  EXPECT_EQ(text_of(shipped), webp) << "though the text is as it was";
  right(set(other));
  EXPECT_NE(listed_picture(shelf), first);
  EXPECT_EQ(*shelf.picture(kScrew), other);
  right(shelf.discard(kScrew, 0));
  EXPECT_EQ(*shelf.picture(kScrew), webp) << "the exhibit's";
}

TEST(Shelf, ADraftIsLaidOutWhereItsUrlsMeanWhatTheyMean) {
  const Museum museum;
  Shelf shelf = museum.shelf();
  const fs::path file = museum.scenarios() / "archimedes-screw/.preview.x3d";
  right(shelf.begin("archimedes-screw", "exhibit:archimedes-screw", kEleni));
  right(shelf.change("archimedes-screw", command_list(0, kHalf), kEleni));
  const auto late = shelf.lay_out("archimedes-screw", 0);
  ASSERT_FALSE(late);
  EXPECT_TRUE(late.error().stale);
  EXPECT_FALSE(fs::exists(file));
  const auto laid = shelf.lay_out("archimedes-screw", 1);
  ASSERT_TRUE(laid) << laid.error().error.to_string();
  EXPECT_EQ(laid->file, file);
  EXPECT_EQ(laid->revision, 1);
  EXPECT_EQ(laid->world->effort_scale, 0.5);
  EXPECT_EQ(text_of(file), *shelf.text("archimedes-screw"));
  scenario::MeshFinder finder;
  EXPECT_EQ(count_errors(scenario::check_text(text_of(file), file, finder)), 0U) << "its mesh is found from there";
  remove_preview(file);
  EXPECT_FALSE(fs::exists(file));
  EXPECT_TRUE(fs::exists(museum.screw()));
}

TEST(Shelf, ATrialBeginsAtAStepAndTheDraftStaysAsItIs) {
  const Museum museum;
  Shelf shelf = museum.shelf();
  right(shelf.begin("mine", "template:crank-and-rope", kEleni));
  const std::string text = *shelf.text("mine");
  const auto none = shelf.lay_out("mine", 0, "lift/nothing");
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().error, is_fault(ErrorCode::unknown_name, {"lift/wind"}));
  right(shelf.change("mine", command_list(0, R"([{"op": "set", "path": "activities/lift/steps/after/enable",
    "value": ["HOLD"]}, {"op": "set", "path": "activities/lift/steps/after/timeoutSeconds", "value": 9}])"),
                     kEleni));
  const auto laid = shelf.lay_out("mine", 1, "lift/after");
  ASSERT_TRUE(laid) << laid.error().error.to_string();
  EXPECT_EQ(laid->step, "lift/after");
  EXPECT_NE(text_of(laid->file).find("before-after"), std::string::npos);
  EXPECT_EQ(shelf.text("mine")->find("before-after"), std::string::npos);
  right(shelf.undo("mine", 1, kEleni));
  EXPECT_EQ(*shelf.text("mine"), text);
}

TEST(Shelf, AFolderThatIsThereForATrialAloneGoesWithIt) {
  const Museum museum;
  Shelf shelf = museum.shelf();
  right(shelf.begin("mine", "template:empty", kEleni));
  ASSERT_TRUE(shelf.lay_out("mine", 0));
  EXPECT_TRUE(fs::exists(museum.scenarios() / "mine/.preview.x3d"));
  remove_previews(museum.scenarios());
  EXPECT_FALSE(fs::exists(museum.scenarios() / "mine"));
  EXPECT_TRUE(fs::exists(museum.screw()));
}

TEST(Shelf, ADraftWithErrorsIsNotLaidOut) {
  const Museum museum;
  Shelf shelf = museum.shelf();
  right(shelf.begin("mine", "template:empty", kEleni));
  right(shelf.change("mine", command_list(0, R"([{"op": "delete", "node": "BALL"}])"), kEleni));
  const auto laid = shelf.lay_out("mine", 1);
  ASSERT_FALSE(laid);
  EXPECT_FALSE(laid.error().problems.empty());
  EXPECT_FALSE(fs::exists(museum.scenarios() / "mine"));
}

TEST(Shelf, EveryShippedExhibitOpensWithoutErrors) {
  const ScratchFolder folder;
  Shelf shelf(source_folder() / "scenarios", folder.path());
  for (const std::string& name : shipped_exhibits()) {
    const json view = right(shelf.begin(name, "exhibit:" + name, kEleni));
    EXPECT_EQ(view["revision"], 0) << name;
    EXPECT_EQ(view["canUndo"], false);
    for (const json& problem : view["problems"])
      EXPECT_NE(problem["severity"], "error") << name << ": " << problem;
    EXPECT_FALSE(view["bodies"].empty()) << name;
    EXPECT_FALSE(view["metadata"]["children"].empty()) << name;
    EXPECT_EQ(*shelf.text(name), text_of(source_folder() / "scenarios" / name / (name + ".x3d")));
  }
  const json list = right(shelf.list());
  EXPECT_EQ(list["exhibits"].size(), shipped_exhibits().size());
  EXPECT_EQ(list["exhibits"][0]["draft"]["problems"], 0);
  EXPECT_FALSE(list["exhibits"][0]["title"]["el"].get<std::string>().empty());
}

TEST(Shelf, TwoAuthorsNeverOverwriteEachOther) {
  const Museum museum;
  Shelf shelf = museum.shelf();
  right(shelf.begin("archimedes-screw", "exhibit:archimedes-screw", kEleni));
  const json first = right(shelf.change("archimedes-screw", command_list(0, kHalf), kEleni));
  EXPECT_EQ(first["revision"], 1);
  EXPECT_EQ(first["by"], "eleni");
  EXPECT_EQ(first["undoes"], "set effortScale");
  const std::string text = *shelf.text("archimedes-screw");
  const auto late =
      shelf.change("archimedes-screw", command_list(0, R"([{"op": "remove", "path": "effortScale"}])"), kNikos);
  ASSERT_FALSE(late);
  EXPECT_TRUE(late.error().stale);
  EXPECT_EQ(late.error().revision, 1);
  EXPECT_THAT(late.error().error, is_fault(ErrorCode::conflict, {"eleni"}));
  EXPECT_FALSE(shelf.undo("archimedes-screw", 0, kNikos));
  EXPECT_FALSE(shelf.publish("archimedes-screw", 0, kNikos));
  EXPECT_FALSE(shelf.discard("archimedes-screw", 0));
  EXPECT_EQ(*shelf.text("archimedes-screw"), text);
  const json second = right(shelf.undo("archimedes-screw", 1, kNikos));
  EXPECT_EQ(second["revision"], 2);
  EXPECT_EQ(second["canRedo"], true);
  EXPECT_EQ(*shelf.text("archimedes-screw"), text_of(museum.screw()));
}

TEST(Shelf, AnotherGatewayGoesOnWhereTheFirstWasKilled) {
  const Museum museum;
  std::string text;
  {
    Shelf shelf = museum.shelf();
    right(shelf.begin("archimedes-screw", "exhibit:archimedes-screw", kEleni));
    right(shelf.change("archimedes-screw", command_list(0, kHalf), kEleni));
    text = *shelf.text("archimedes-screw");
  }
  Shelf shelf = museum.shelf();
  const json view = right(shelf.view("archimedes-screw"));
  EXPECT_EQ(view["revision"], 1);
  EXPECT_EQ(view["by"], "eleni");
  EXPECT_EQ(*shelf.text("archimedes-screw"), text);
  right(shelf.undo("archimedes-screw", 1, kEleni));
  EXPECT_EQ(*shelf.text("archimedes-screw"), text_of(museum.screw()));
}

TEST(Shelf, ARefusedCommandIsNamedAndNothingChanges) {
  const Museum museum;
  Shelf shelf = museum.shelf();
  right(shelf.begin("archimedes-screw", "exhibit:archimedes-screw", kEleni));
  const auto refused = shelf.change(
      "archimedes-screw",
      command_list(0, R"([{"op": "remove", "path": "effortScale"}, {"op": "remove", "path": "no-such"}])"), kEleni);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().command, 1U);
  EXPECT_EQ(right(shelf.view("archimedes-screw"))["revision"], 0);
}

TEST(Shelf, PublishesWhatHasNoErrorsAndKeepsTheFormer) {
  const Museum museum;
  Shelf shelf = museum.shelf();
  const std::string name = "archimedes-screw", before = text_of(museum.screw());
  right(shelf.begin(name, "exhibit:archimedes-screw", kEleni));
  const json broken =
      right(shelf.change(name, command_list(0, R"([{"op": "set", "path": "id", "value": ""}])"), kEleni));
  EXPECT_NE(broken["problems"].dump().find("error"), std::string::npos);
  const auto refused = shelf.publish(name, 1, kEleni);
  ASSERT_FALSE(refused);
  EXPECT_FALSE(refused.error().problems.empty());
  EXPECT_EQ(text_of(museum.screw()), before);
  right(shelf.undo(name, 1, kEleni));
  right(shelf.add_version(name, "Before Easter", kNikos));
  right(shelf.change(name, command_list(2, kHalf), kEleni));
  EXPECT_EQ(right(shelf.publish(name, 3, kEleni))["published"], true);
  EXPECT_EQ(text_of(museum.screw()), *shelf.text(name));
  const json versions = right(shelf.versions(name))["versions"];
  ASSERT_EQ(versions.size(), 2U) << "the named one, and what was published before";
  EXPECT_EQ(versions[1]["title"], "Before Easter");
  EXPECT_EQ(versions[1]["by"], "nikos");
  right(shelf.restore(name, 2, 3, kNikos));
  EXPECT_EQ(*shelf.text(name), before);
  right(shelf.undo(name, 4, kNikos));
  EXPECT_EQ(*shelf.text(name), text_of(museum.screw()));
  EXPECT_FALSE(shelf.restore(name, 9, 5, kNikos));
}

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}

TEST(Shelf, FilesComeInUnderTheirNamesAndNothingElse) {
  const Museum museum;
  Shelf shelf = museum.shelf();
  const std::string name = "archimedes-screw";
  right(shelf.begin(name, "exhibit:archimedes-screw", kEleni));
  for (const char* wrong :
       {"", "a", "a.exe", ".ply", "../a.ply", "a/b.ply", "-a.ply", "a b.ply", "\u00e4.ply", "a.PLY"}) {
    const auto refused = shelf.add_file(name, wrong, bytes_of("ply\n"), true);
    ASSERT_FALSE(refused) << wrong;
    EXPECT_EQ(refused.error().error.code, ErrorCode::invalid_value) << wrong;
  }
  for (const char* file : {"a.glb", "a.ogg", "a.wav", "a.flac"})
    EXPECT_FALSE(shelf.add_file(name, file, bytes_of("ply\n"), false)) << file << " of other bytes";
  EXPECT_FALSE(shelf.add_file("no-such", "a.ply", bytes_of("ply\n"), false));
  right(shelf.add_file(name, "a.ply", bytes_of("ply\n1"), false));
  right(shelf.add_file(name, "a.ply", bytes_of("ply\n1"), false));
  const auto other = shelf.add_file(name, "a.ply", bytes_of("ply\n2"), false);
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().error.code, ErrorCode::conflict);
  EXPECT_EQ(text_of(museum.state() / name / "files/a.ply"), "ply\n1");
  const json list = right(shelf.add_file(name, "a.ply", bytes_of("ply\n2"), true))["files"];
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0]["kind"], "mesh");
  EXPECT_EQ(list[0]["published"], false);
  EXPECT_TRUE(list[0]["uses"].empty());
}

TEST(Shelf, FilesThatAreUsedTravelWithTheExhibit) {
  const Museum museum;
  Shelf shelf = museum.shelf();
  const std::string name = "archimedes-screw", sound = "OggS a sound";
  right(shelf.begin(name, "exhibit:archimedes-screw", kEleni));
  right(shelf.add_file(name, "turn.ogg", bytes_of(sound), false));
  right(shelf.add_file(name, "unused.ogg", bytes_of("OggS"), false));
  right(shelf.change(
      name,
      command_list(0,
                   R"([{"op": "set", "path": "activities/use/steps/fill/text/audio.en", "value": "files/turn.ogg"}])"),
      kEleni));
  json list = right(shelf.files(name))["files"];
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0]["uses"].size(), 1U);
  EXPECT_GT(list[0]["uses"][0]["line"], 0);
  const fs::path trial = museum.screw().parent_path() / ".preview", folder = museum.screw().parent_path() / "files";
  const auto laid = shelf.lay_out(name, 1);
  ASSERT_TRUE(laid) << laid.error().error.to_string();
  EXPECT_NE(text_of(laid->file).find("\".preview/turn.ogg\""), std::string::npos);
  EXPECT_EQ(text_of(trial / "turn.ogg"), sound);
  EXPECT_FALSE(fs::exists(folder)) << "the museum's exhibit is as it was";
  remove_preview(laid->file);
  EXPECT_FALSE(fs::exists(trial));
  right(shelf.publish(name, 1, kEleni));
  EXPECT_EQ(text_of(folder / "turn.ogg"), sound);
  EXPECT_FALSE(fs::exists(folder / "unused.ogg"));
  list = right(shelf.files(name))["files"];
  EXPECT_EQ(list[0]["published"], true);
  EXPECT_FALSE(shelf.add_file(name, "turn.ogg", bytes_of("OggS another"), false)) << "the exhibit has this name";
  right(shelf.begin("second-screw", "exhibit:archimedes-screw", kEleni));
  EXPECT_EQ(text_of(museum.state() / "second-screw/files/turn.ogg"), sound);
}

TEST(Shelf, AFileIsDeletedThatNothingUses) {
  const Museum museum;
  Shelf shelf = museum.shelf();
  const std::string name = "archimedes-screw";
  const fs::path published = museum.screw().parent_path() / "files/turn.ogg";
  right(shelf.begin(name, "exhibit:archimedes-screw", kEleni));
  right(shelf.add_file(name, "turn.ogg", bytes_of("OggS"), false));
  right(shelf.add_file(name, "unused.ogg", bytes_of("OggS"), false));
  constexpr const char* kSound =
      R"([{"op": "set", "path": "activities/use/steps/fill/text/audio.en", "value": "files/turn.ogg"}])";
  right(shelf.change(name, command_list(0, kSound), kEleni));
  const auto used = shelf.remove_file(name, "turn.ogg");
  ASSERT_FALSE(used);
  EXPECT_THAT(used.error().error, is_fault(ErrorCode::conflict, {"turn.ogg"}));
  const json told = json::parse(fault_json(used.error()));
  ASSERT_EQ(told["uses"].size(), 1U) << told;
  EXPECT_GT(told["uses"][0]["line"], 0);
  right(shelf.publish(name, 1, kEleni));
  right(shelf.undo(name, 1, kEleni));
  const auto in_use = shelf.remove_file(name, "turn.ogg");
  ASSERT_FALSE(in_use) << "visitors hear it";
  EXPECT_EQ(in_use.error().uses.at(0).draft, false);
  EXPECT_TRUE(fs::exists(published));
  right(shelf.publish(name, 2, kEleni));
  json list = right(shelf.remove_file(name, "turn.ogg"))["files"];
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0]["name"], "unused.ogg");
  EXPECT_FALSE(fs::exists(published));
  const std::string whole = text_of(museum.screw());
  std::ofstream(museum.screw()) << "<X3D";
  EXPECT_FALSE(shelf.remove_file(name, "unused.ogg")) << "what visitors have may use it";
  std::ofstream(museum.screw()) << whole;
  list = right(shelf.remove_file(name, "unused.ogg"))["files"];
  EXPECT_TRUE(list.empty());
  for (const char* file : {"unused.ogg", "", "..", "../draft.x3d", "no-such.ply"})
    EXPECT_EQ(shelf.remove_file(name, file).error().error.code, ErrorCode::not_found) << file;
  EXPECT_TRUE(fs::exists(museum.state() / name / "draft.x3d"));
}

TEST(Shelf, AnotherExhibitIsAddedAsOneStepWithItsFiles) {
  const Museum museum;
  Shelf shelf = museum.shelf();
  constexpr const char* kSounds = R"([
    {"op": "set", "path": "activities/try/steps/first/text/audio.en", "value": "files/bell.ogg"},
    {"op": "set", "path": "activities/try/steps/first/text/audio.el", "value": "files/same.ogg"}])";
  for (const char* name : {"mine", "other"}) {
    right(shelf.begin(name, "template:empty", kNikos));
    right(shelf.add_file(name, "bell.ogg", bytes_of(std::string("OggS ") + name), false));
    right(shelf.add_file(name, "same.ogg", bytes_of("OggS"), false));
    right(shelf.change(name, command_list(0, kSounds), kNikos));
  }
  const json view = right(shelf.view("other"));
  const std::string before = *shelf.text("mine");
  const json both = right(shelf.merge("mine", 1, "draft:other", kEleni));
  EXPECT_EQ(both["revision"], 2);
  EXPECT_EQ(both["undoes"], "add other");
  EXPECT_EQ(both["bodies"].size(), 2 * view["bodies"].size());
  for (const json& problem : both["problems"])
    EXPECT_NE(problem["severity"], "error") << problem;
  ASSERT_FALSE(both["merged"].empty());
  EXPECT_EQ(both["merged"][0]["renamed"], true);
  EXPECT_EQ(both["merged"][0]["here"], both["merged"][0]["theirs"].get<std::string>() + "_2");
  EXPECT_EQ(text_of(museum.state() / "mine/files/bell-2.ogg"), "OggS other");
  EXPECT_EQ(text_of(museum.state() / "mine/files/bell.ogg"), "OggS mine");
  EXPECT_FALSE(fs::exists(museum.state() / "mine/files/same-2.ogg"));
  EXPECT_NE(shelf.text("mine")->find("\"files/bell-2.ogg\""), std::string::npos);
  right(shelf.undo("mine", 2, kEleni));
  EXPECT_EQ(*shelf.text("mine"), before);
}

TEST(Shelf, WhatIsPublishedIsAddedWithThePathsOfItsMeshes) {
  const Museum museum;
  Shelf shelf = museum.shelf();
  right(shelf.begin("mine", "template:empty", kEleni));
  const json both = right(shelf.merge("mine", 0, "exhibit:archimedes-screw", kEleni));
  for (const json& problem : both["problems"])
    EXPECT_NE(problem["severity"], "error") << problem;
  EXPECT_NE(shelf.text("mine")->find("\"../models/archimedes-screw.glb\""), std::string::npos);
  EXPECT_FALSE(fs::exists(museum.state() / "mine/files"));
  const auto fault = [&](std::int64_t revision, const std::string& from) {
    const auto refused = shelf.merge("mine", revision, from, kEleni);
    EXPECT_FALSE(refused) << from;
    return refused ? ErrorCode() : refused.error().error.code;
  };
  EXPECT_EQ(fault(0, "exhibit:archimedes-screw"), ErrorCode::conflict);
  EXPECT_EQ(fault(1, "exhibit:no-such"), ErrorCode::not_found);
  EXPECT_EQ(fault(1, "draft:archimedes-screw"), ErrorCode::not_found);
  EXPECT_EQ(fault(1, "exhibit:../mine"), ErrorCode::invalid_value);
  EXPECT_EQ(fault(1, "draft:mine"), ErrorCode::invalid_value);
  EXPECT_EQ(fault(1, "archimedes-screw"), ErrorCode::invalid_value);
  EXPECT_EQ(right(shelf.view("mine"))["revision"], 1);
}

TEST(PreviewFile, OnlyTheDraftsOwnFilesAreElsewhere) {
  const std::vector<std::string> own{"a.glb"};
  EXPECT_EQ(
      with_preview_files(R"(url='"files/a.glb#arm"' "files/b.glb" "files/a.glb.x3d" "../other/files/a.glb")", own),
      R"(url='".preview/a.glb#arm"' "files/b.glb" "files/a.glb.x3d" "../other/files/a.glb")");
  EXPECT_EQ(with_preview_files("files/a.glb &quot;files/a.glb&quot;", own), "files/a.glb &quot;.preview/a.glb&quot;");
}

TEST(Shelf, ACopyIsAnExhibitOfItsOwn) {
  const Museum museum;
  Shelf shelf = museum.shelf();
  const json view = right(shelf.begin("screw-2", "exhibit:archimedes-screw", kEleni));
  EXPECT_EQ(view["name"], "screw-2");
  EXPECT_NE(shelf.text("screw-2")->find("name='id' value='\"screw-2\"'"), std::string::npos);
  for (const json& problem : view["problems"])
    EXPECT_NE(problem["severity"], "error") << problem;
  right(shelf.publish("screw-2", 0, kEleni));
  EXPECT_TRUE(fs::exists(museum.scenarios() / "screw-2/screw-2.x3d"));
  EXPECT_THAT(shelf.begin("archimedes-screw", "template:empty", kEleni).error().error, is_fault(ErrorCode::conflict));
  EXPECT_THAT(shelf.begin("screw-2", "template:empty", kEleni).error().error, is_fault(ErrorCode::conflict));
  right(shelf.discard("screw-2", 0));
  EXPECT_THAT(shelf.view("screw-2").error().error, is_fault(ErrorCode::not_found));
  EXPECT_TRUE(fs::exists(museum.state() / "discarded/screw-2/draft.x3d"));
  right(shelf.begin("screw-2", "exhibit:screw-2", kEleni));
}

TEST(Shelf, NamesLeadNowhereElse) {
  const Museum museum;
  Shelf shelf = museum.shelf();
  for (const char* name : {"", "..", "../archimedes-screw", "a/b", "A", ".a", "-a", "a.b", "discarded", "αβγ",
                           "a-name-that-is-longer-than-it-may-be-here"}) {
    EXPECT_FALSE(shelf.begin(name, "template:empty", kEleni)) << name;
    EXPECT_FALSE(shelf.view(name)) << name;
    EXPECT_FALSE(shelf.begin("fine", std::string("exhibit:") + name, kEleni)) << name;
  }
  EXPECT_FALSE(fs::exists(museum.state() / "fine"));
}

TEST(Library, EveryTemplateAndPartIsWithoutProblems) {
  const Museum museum;
  Shelf shelf = museum.shelf();
  for (const Template& one : templates()) {
    const std::string name(one.name);
    const auto file = museum.folder.write(name + ".x3d", text_of(one, name));
    for (const x3d::Problem& problem : scenario::check(file))
      ADD_FAILURE() << x3d::to_string(problem);
    const json view = right(shelf.begin("my-" + name, "template:" + name, kEleni));
    EXPECT_EQ(view["problems"], json::array()) << name;
    EXPECT_EQ(right(shelf.publish("my-" + name, 0, kEleni))["published"], true);
  }
  json view = right(shelf.begin("parts", "template:empty", kEleni));
  double x = -0.4;
  for (const Part& part : parts()) {
    const std::string name = "MY-" + std::string(part.name);
    const json insert{{"op", "insert"}, {"part", part.name}, {"name", name}, {"position", {x += 0.1, 1, 0}}};
    view = right(shelf.change("parts", command_list(view["revision"], json::array({insert}).dump()), kEleni));
    EXPECT_EQ(view["added"], json::array({name}));
  }
  const auto file = museum.folder.write("all-parts.x3d", *shelf.text("parts"));
  for (const x3d::Problem& problem : scenario::check(file))
    ADD_FAILURE() << x3d::to_string(problem);
}

TEST(Schema, HasTheReadersTables) {
  const json schema = json::parse(schema_json());
  const auto named = [](const json& list, const std::string& name) {
    for (const json& one : list)
      if (one["name"] == name) return one;
    ADD_FAILURE() << "there is no " << name;
    return json();
  };
  const json scenario = named(schema["metadata"], "mechane:scenario");
  const json activity = named(named(scenario["sets"], "activities")["sets"], "*");
  const json step = named(named(named(activity["sets"], "steps")["sets"], "*")["sets"], "trigger:*");
  const json op = named(step["keys"], "op");
  EXPECT_THAT(op["choices"].dump(), ::testing::HasSubstr(">"));
  EXPECT_EQ(named(step["keys"], "quantity")["names"], "quantity");
  EXPECT_EQ(named(named(schema["agents"], "geometry.rope")["keys"], "diameter")["unit"], "m");
  EXPECT_EQ(named(named(schema["nodes"], "RigidBody")["keys"], "mass")["x3d"], "SFFloat");
  EXPECT_EQ(schema["parts"].size(), parts().size());
  // What must be written, or one of several of which one must, has no usual value.
  const json gear = named(schema["agents"], "geometry.gear");
  for (const char* key : {"ratio", "teeth", "radius"})
    EXPECT_FALSE(named(gear["keys"], key).contains("default")) << key;
  EXPECT_EQ(named(gear["keys"], "efficiency")["default"], 1);
}

TEST(Library, GearsMeshBesideAndAboveEachOther) {
  // How far the corner of a tooth that is nearest to the line between two axles is from it, counterclockwise.
  const auto reach = [](const Part& part, double toward) {
    const std::string text = text_of(part, "G", "0 0 0");
    const std::size_t begin = text.find("crossSection='") + 14;
    std::istringstream corners(text.substr(begin, text.find('\'', begin) - begin));
    double tooth = 9, x = 0, z = 0;
    int count = 0;
    for (; corners >> x >> z; ++count)
      if (const double turn = std::remainder(std::atan2(-z, x) - toward, 2 * std::numbers::pi);
          std::hypot(x, z) > 0.01 * part.teeth && std::abs(turn) < std::abs(tooth))
        tooth = turn;
    EXPECT_EQ(count, 4 * part.teeth + 1);
    EXPECT_THAT(text, ::testing::HasSubstr("name='collides' value='false'"));
    return tooth * 0.01 * part.teeth;  // m, along the circle where they meet
  };
  for (const Part& one : parts())
    for (const Part& other : parts())
      for (const double toward : {0.0, std::numbers::pi / 2, std::numbers::pi, -std::numbers::pi / 2})
        if (one.teeth > 0 && other.teeth > 0) {
          // The nearest corner of either tooth is on its own side of the line between the axles.
          EXPECT_GT(reach(one, toward), 0.004) << one.name;
          EXPECT_GT(reach(other, toward + std::numbers::pi), 0.004) << other.name;
        }
}

}  // namespace
}  // namespace mechane::studio
