// Exhibits as one file: what is written is read again; what is hostile is refused, and leaves nothing.
#include "client-sdk/studio/draft/archive.hpp"

#include <algorithm>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "client-sdk/studio/shelf/shelf.hpp"
#include "server/base/whole_file.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_files.hpp"
#include "tests/unit/studio/studio_fixture.hpp"

namespace mechane::studio {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ScratchFolder;
using test::source_folder;
using test::text_of;
using Files = std::map<std::string, std::string>;

const fs::path& hostile_folder() {
  static const fs::path folder = source_folder() / "tests/fuzz/corpus/archive";
  return folder;
}

Expected<ArchivedExhibit> read_into(Files& files, std::string_view archive) {
  return read_archive(std::as_bytes(std::span(archive)),
                      [&](const std::string& name, std::span<const std::byte> bytes) {
                        files[name] = std::string(as_text(bytes));
                        return Expected<void>();
                      });
}

TEST(Archive, IsReadAsItWasWrittenAndHasTheSameBytesEachTime) {
  const ScratchFolder folder;
  const std::vector<ArchiveSource> files{{"b.ply", folder.write("1", "ply\n1")}, {"a.glb", folder.write("2", "glTF")}};
  const auto first = write_archive("crane", "<X3D/>", files);
  ASSERT_TRUE(first) << first.error().to_string();
  fs::last_write_time(folder.path() / "1", fs::file_time_type::clock::now() - std::chrono::hours(100));
  fs::permissions(folder.path() / "1", fs::perms::owner_read);
  const std::vector<ArchiveSource> turned{files[1], files[0]};
  EXPECT_EQ(*write_archive("crane", "<X3D/>", turned), *first);
  Files read;
  const auto exhibit = read_into(read, *first);
  ASSERT_TRUE(exhibit) << exhibit.error().to_string();
  EXPECT_EQ(exhibit->name, "crane");
  EXPECT_EQ(exhibit->text, "<X3D/>");
  EXPECT_EQ(read, (Files{{"a.glb", "glTF"}, {"b.ply", "ply\n1"}}));
}

TEST(Archive, AFileThatIsGoneIsToldOf) {
  const std::vector<ArchiveSource> files{{"a.ply", "/no/such/file"}};
  EXPECT_THAT(write_archive("crane", "<X3D/>", files).error(), is_fault(ErrorCode::io_failure, {"/no/such/file"}));
}

TEST(Archive, HostileOnesAreRefused) {
  using enum ErrorCode;
  const std::map<std::string, ErrorCode> refused{{"nothing", invalid_value},
                                                 {"text", invalid_value},
                                                 {"cut_list", invalid_value},
                                                 {"cut_half", invalid_value},
                                                 {"wrong_checksum", invalid_value},
                                                 {"no_entries", missing},
                                                 {"no_x3d", missing},
                                                 {"two_x3d", invalid_value},
                                                 {"x3d_of_another_name", invalid_value},
                                                 {"two_folders", invalid_value},
                                                 {"doubled", duplicate},
                                                 {"doubled_x3d", duplicate},
                                                 {"up", invalid_value},
                                                 {"up_at_once", invalid_value},
                                                 {"absolute", invalid_value},
                                                 {"backslash", invalid_value},
                                                 {"nul", invalid_value},
                                                 {"not_utf8", invalid_value},
                                                 {"control", invalid_value},
                                                 {"program", invalid_value},
                                                 {"deeper", invalid_value},
                                                 {"beside", invalid_value},
                                                 {"at_top", invalid_value},
                                                 {"link", not_supported},
                                                 {"encrypted", not_supported},
                                                 {"bzip2", not_supported},
                                                 {"large_x3d_declared", too_large},
                                                 {"large_declared", too_large},
                                                 {"more_than_declared", invalid_value},
                                                 {"less_than_declared", invalid_value},
                                                 {"many", too_large},
                                                 {"many_folders", too_large}};
  std::size_t seen = 0;
  for (const auto& entry : fs::directory_iterator(hostile_folder())) {
    const std::string name = entry.path().stem().string();
    if (name.starts_with("found_")) continue;
    Files files;
    const auto exhibit = read_into(files, text_of(entry.path()));
    ++seen;
    if (name.starts_with("good")) {
      ASSERT_TRUE(exhibit) << name << ": " << exhibit.error().to_string();
      EXPECT_EQ(exhibit->name, "crane") << name;
      continue;
    }
    ASSERT_TRUE(refused.contains(name)) << name;
    ASSERT_FALSE(exhibit) << name;
    EXPECT_THAT(exhibit.error(), is_fault(refused.at(name))) << name << ": " << exhibit.error().to_string();
    EXPECT_EQ(exhibit.error().to_string().find('\x1b'), std::string::npos) << name;
  }
  EXPECT_EQ(seen, refused.size() + 4);
}

const Author kIrini{"irini", 1'700'000'000};

/// A museum with one exhibit that has a mesh file among those of the museum.
struct Hall {
  Hall() {
    fs::create_directories(scenarios());
    fs::copy(source_folder() / "scenarios/archimedes-screw", scenarios() / "archimedes-screw",
             fs::copy_options::recursive);
    fs::create_directory_symlink(source_folder() / "scenarios/models", scenarios() / "models");
  }
  [[nodiscard]] fs::path scenarios() const { return folder.path() / "scenarios"; }
  [[nodiscard]] fs::path state() const { return folder.path() / "state"; }
  [[nodiscard]] Shelf shelf() const { return {scenarios(), state()}; }
  /// Names in the folder of drafts.
  [[nodiscard]] std::vector<std::string> drafts() const {
    std::vector<std::string> names;
    std::error_code missing;
    for (const auto& entry : fs::directory_iterator(state(), missing))
      names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }

  ScratchFolder folder;
};

std::span<const std::byte> as_bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}

TEST(Unpack, AnExhibitComesOverWithItsMeshesAndSounds) {
  const Hall here;
  Shelf shelf = here.shelf();
  const std::string screw = "archimedes-screw", sound = "OggS a sound";
  const auto published = shelf.pack(screw);
  ASSERT_TRUE(published) << "without a draft";
  ASSERT_TRUE(shelf.begin(screw, "exhibit:" + screw, kIrini));
  EXPECT_TRUE(*shelf.pack(screw) == *published);
  ASSERT_TRUE(shelf.add_file(screw, "turn.ogg", as_bytes_of(sound), false));
  ASSERT_TRUE(shelf.add_file(screw, "unused.ogg", as_bytes_of("OggS"), false));
  const auto list = parse_command_list(R"({"revision": 0, "commands": [{"op": "set",
      "path": "activities/use/steps/fill/text/audio.en", "value": "files/turn.ogg"}]})");
  ASSERT_TRUE(shelf.change(screw, *list, kIrini));
  const auto archive = shelf.pack(screw);
  ASSERT_TRUE(archive);
  EXPECT_TRUE(*shelf.pack(screw) == *archive);

  const Hall there;
  fs::remove_all(there.scenarios());
  Shelf other = there.shelf();
  const auto view = other.unpack("my-screw", as_bytes_of(*archive), kIrini);
  ASSERT_TRUE(view) << view.error().error.to_string();
  const json seen = json::parse(*view);
  EXPECT_EQ(seen["name"], "my-screw");
  EXPECT_EQ(seen["revision"], 0);
  for (const json& problem : seen["problems"])
    EXPECT_NE(problem["severity"], "error") << problem;
  EXPECT_EQ(there.drafts(), std::vector<std::string>{"my-screw"});
  EXPECT_EQ(text_of(there.state() / "my-screw/files/turn.ogg"), sound);
  EXPECT_FALSE(fs::exists(there.state() / "my-screw/files/unused.ogg"));
  EXPECT_TRUE(text_of(there.state() / "my-screw/files/archimedes-screw.glb") ==
              text_of(here.scenarios() / "models/archimedes-screw.glb"));
  const std::string text = *other.text("my-screw");
  EXPECT_NE(text.find("url='\"files/archimedes-screw.glb\"'"), std::string::npos);
  EXPECT_NE(text.find("name='id' value='\"my-screw\"'"), std::string::npos);
  ASSERT_TRUE(other.unpack(screw, as_bytes_of(*archive), kIrini));
  EXPECT_TRUE(*other.pack(screw) == *archive) << "it comes back as it was";
  EXPECT_TRUE(other.publish(screw, 0, kIrini));
}

TEST(Unpack, ATakenNameIsAConflict) {
  const Hall hall;
  Shelf shelf = hall.shelf();
  const auto archive = shelf.pack("archimedes-screw");
  ASSERT_TRUE(archive);
  const auto conflict = [&](const std::string& name) {
    return shelf.unpack(name, as_bytes_of(*archive), kIrini).error().error.code == ErrorCode::conflict;
  };
  EXPECT_TRUE(conflict("archimedes-screw")) << "an exhibit has it";
  ASSERT_TRUE(shelf.begin("mine", "template:empty", kIrini));
  const std::string text = *shelf.text("mine");
  EXPECT_TRUE(conflict("mine"));
  EXPECT_EQ(*shelf.text("mine"), text);
  for (const char* name : {"", "..", "../up", "A", ".incoming", "discarded"})
    EXPECT_FALSE(shelf.unpack(name, as_bytes_of(*archive), kIrini)) << name;
  EXPECT_EQ(hall.drafts(), std::vector<std::string>{"mine"});
}

TEST(Unpack, WhatIsRefusedLeavesNothing) {
  const Hall hall;
  Shelf shelf = hall.shelf();
  for (const auto& entry : fs::directory_iterator(hostile_folder())) {
    // The good ones, too: their text is no exhibit.
    EXPECT_FALSE(shelf.unpack("mine", as_bytes_of(text_of(entry.path())), kIrini)) << entry.path();
    EXPECT_TRUE(hall.drafts().empty()) << entry.path();
  }
  const std::string text = text_of(hall.scenarios() / "archimedes-screw/archimedes-screw.x3d");
  const std::vector<ArchiveSource> files{{"a.glb", hall.folder.write("no.glb", "not glTF")}};
  const auto wrong_kind = write_archive("mine", text, files);
  ASSERT_TRUE(wrong_kind);
  const auto refused = shelf.unpack("mine", as_bytes_of(*wrong_kind), kIrini);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().error, is_fault(ErrorCode::invalid_value, {"a.glb"}));
  EXPECT_TRUE(hall.drafts().empty());
}

TEST(Unpack, ADiskThatDoesNotTakeItLeavesNothing) {
  const Hall hall;
  Shelf shelf = hall.shelf();
  const auto archive = shelf.pack("archimedes-screw");
  ASSERT_TRUE(archive);
  hall.folder.write("state", "a file where the folder of drafts should be");
  const auto refused = shelf.unpack("mine", as_bytes_of(*archive), kIrini);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().error.code, ErrorCode::io_failure);
  fs::remove(hall.state());
  // What an earlier program left behind is no hindrance.
  fs::create_directories(hall.state() / ".incoming/files");
  EXPECT_TRUE(shelf.unpack("mine", as_bytes_of(*archive), kIrini));
  EXPECT_EQ(hall.drafts(), std::vector<std::string>{"mine"});
}

}  // namespace
}  // namespace mechane::studio
