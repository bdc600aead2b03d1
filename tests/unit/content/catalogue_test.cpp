#include "server/content/catalogue.hpp"

#include <csignal>
#include <future>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>
#include <sys/resource.h>

#include "server/content/content_hash.hpp"
#include "tests/support/error_like.hpp"
#include "tests/unit/content/catalogue_files.hpp"

namespace mechane::content {
namespace {

using test::is_error;
using testing::ElementsAre;
using testing::SizeIs;

/// Any bytes: a title need not be valid text.
std::string any_text() {
  return *rc::gen::container<std::string>(rc::gen::arbitrary<char>());
}

std::vector<std::string> any_sorted_texts() {
  const auto texts = *rc::gen::container<std::set<std::string>>(rc::gen::nonEmpty<std::string>());
  return {texts.begin(), texts.end()};
}

CatalogueEntry any_entry(std::size_t number) {
  CatalogueEntry entry;
  entry.path = fmt::format("folder {}/αρχείο'\"-{}.glb", number, number);
  entry.kind = static_cast<ContentKind>(*rc::gen::inRange(0, static_cast<int>(kContentKinds)));
  entry.name = any_text();
  entry.hash = content_hash(std::as_bytes(std::span(entry.path)));
  entry.bytes = *rc::gen::inRange<std::uint64_t>(0, std::uint64_t{1} << 62U);
  entry.credits = {any_text(), any_text(), any_text(), any_text()};
  entry.titles[any_text()] = any_text();
  entry.languages = any_sorted_texts();
  entry.tags = any_sorted_texts();
  entry.refers_to = any_sorted_texts();
  entry.wordings[any_text()] = any_sorted_texts();
  entry.wordings["said in no language"] = {};
  return entry;
}

Catalogue opened(const std::filesystem::path& file, Catalogue::Access access = Catalogue::Access::write) {
  auto catalogue = Catalogue::open(file, access);
  EXPECT_TRUE(catalogue) << catalogue.error().to_string();
  return std::move(*catalogue);
}

/// Empty where it opens after all.
Error error_of(const std::filesystem::path& file, Catalogue::Access access = Catalogue::Access::read) {
  const auto catalogue = Catalogue::open(file, access);
  return catalogue ? Error{} : catalogue.error();
}

RC_GTEST_PROP(Catalogue, WhatIsPutComesBack, ()) {
  const ScratchFolder folder(folder_in_memory());
  std::vector<CatalogueEntry> entries;
  for (std::size_t i = 0, n = *rc::gen::inRange<std::size_t>(0, 5); i < n; ++i)
    entries.push_back(any_entry(i));
  RC_ASSERT(opened(folder.path() / "c.db").put(entries).value().added.size() == entries.size());
  Catalogue again = opened(folder.path() / "c.db");
  RC_ASSERT(again.entries().value() == entries);
  const auto changes = again.put(entries).value();
  RC_ASSERT(changes.same == entries.size());
  RC_ASSERT(changes.added.empty());
  RC_ASSERT(changes.changed.empty());
  for (const CatalogueEntry& entry : entries)
    RC_ASSERT(again.files_of(entry.hash).value() == std::vector{again.folder() / entry.path});
}

RC_GTEST_PROP(Catalogue, APutReplacesAndARemoveForgetsAllOfAnEntry, ()) {
  const ScratchFolder folder(folder_in_memory());
  Catalogue catalogue = opened(folder.path() / "c.db");
  const std::vector<CatalogueEntry> first{any_entry(1), any_entry(2)};
  (void)catalogue.put(first).value();
  const std::vector<CatalogueEntry> second{any_entry(1)};
  const auto changes = catalogue.put(second).value();
  const bool other_bytes = first[0].hash != second[0].hash;
  RC_ASSERT(changes.changed.size() == (other_bytes ? 1U : 0U));
  RC_ASSERT(changes.retold.size() == (other_bytes || first[0] == second[0] ? 0U : 1U));
  RC_ASSERT(catalogue.entries().value() == (std::vector{second[0], first[1]}));
  const std::vector<std::string> both{second[0].path, first[1].path, "absent"};
  RC_ASSERT(catalogue.remove(both).value() == 2U);
  (void)catalogue.put(std::vector{plain_entry(second[0].path)}).value();
  RC_ASSERT(catalogue.entries().value() == std::vector{plain_entry(second[0].path)});
}

TEST(Catalogue, OrderAndRepetitionOfValuesAreNothing) {
  const ScratchFolder folder;
  Catalogue catalogue = opened(folder.path() / "c.db");
  CatalogueEntry entry = plain_entry("a.glb");
  entry.tags = {"bronze", "wood"};
  ASSERT_TRUE(catalogue.put(std::vector{entry}));
  entry.tags = {"wood", "bronze", "wood"};
  EXPECT_EQ(catalogue.put(std::vector{entry})->same, 1U);
}

TEST(Catalogue, ASecondOpenerSeesWhatWasWrittenAndMayWriteToo) {
  const ScratchFolder folder;
  Catalogue first = opened(folder.path() / "c.db");
  const Catalogue reader = opened(folder.path() / "c.db", Catalogue::Access::read);
  Catalogue second = opened(folder.path() / "c.db");
  ASSERT_TRUE(first.put(std::vector{plain_entry("a.glb")}));
  ASSERT_TRUE(second.put(std::vector{plain_entry("b.glb")}));
  EXPECT_THAT(*reader.entries(), SizeIs(2));
}

TEST(Catalogue, WritersAtOnceLoseNothing) {
  const ScratchFolder folder;
  const auto write = [&](int writer) {
    Catalogue own = opened(folder.path() / "c.db");  // the first of them makes it
    for (int i = 0; i < 5; ++i) {
      const auto put = own.put(std::vector{plain_entry(fmt::format("{}-{}.glb", writer, i))});
      EXPECT_TRUE(put) << put.error().to_string();
    }
  };
  std::vector<std::future<void>> writers;
  for (int w = 0; w < 3; ++w)
    writers.push_back(std::async(std::launch::async, write, w));
  for (std::future<void>& writer : writers)
    writer.get();
  EXPECT_THAT(*opened(folder.path() / "c.db").entries(), SizeIs(15));
}

TEST(Catalogue, AFileThatIsNotACatalogueIsAnErrorWithARemedy) {
  const ScratchFolder folder;
  EXPECT_THAT(error_of(folder.path() / "absent.db"), is_error(ErrorCode::not_found, 0, {"absent.db", "content add"}));
  EXPECT_THAT(error_of(folder.path()), is_error(ErrorCode::invalid_value, 0, {folder.path().string(), "--catalogue"}));
  EXPECT_THAT(error_of(folder.write("text.db", std::string(5000, 'x'))),
              is_error(ErrorCode::damaged, 0, {"text.db", "--catalogue", "content add"}));
  EXPECT_THAT(error_of(folder.write("empty.db", "")), is_error(ErrorCode::not_found, 0, {"empty.db", "content add"}));
  EXPECT_THAT(error_of(folder.path() / "no/such/folder/c.db", Catalogue::Access::write),
              is_error(ErrorCode::io_failure, 0, {"no/such/folder/c.db"}));
}

TEST(Catalogue, AnotherProgramsDatabaseIsLeftAlone) {
  const ScratchFolder folder;
  { const Catalogue made = opened(folder.path() / "c.db"); }
  std::string bytes = bytes_of(folder.path() / "c.db");
  bytes.replace(68, 4, "ABCD");  // PRAGMA application_id
  for (const auto access : {Catalogue::Access::read, Catalogue::Access::write})
    EXPECT_THAT(error_of(folder.write("foreign.db", bytes), access),
                is_error(ErrorCode::invalid_value, 0, {"foreign.db", "another program"}));
  EXPECT_EQ(bytes_of(folder.path() / "foreign.db"), bytes);
}

TEST(Catalogue, ANewerOneIsLeftAlone) {
  const ScratchFolder folder;
  { const Catalogue made = opened(folder.path() / "c.db"); }
  std::string bytes = bytes_of(folder.path() / "c.db");
  bytes[63] = 2;  // PRAGMA user_version, see SQLite's file format, 1.3
  for (const auto access : {Catalogue::Access::read, Catalogue::Access::write})
    EXPECT_THAT(error_of(folder.write("new.db", bytes), access),
                is_error(ErrorCode::wrong_version, 0, {"new.db", "format 2"}));
  EXPECT_EQ(bytes_of(folder.path() / "new.db"), bytes);
}

TEST(Catalogue, DamageIsSaidAndNeverRead) {
  const ScratchFolder folder;
  {
    Catalogue catalogue = opened(folder.path() / "c.db");
    std::vector<CatalogueEntry> entries;
    for (int i = 0; i < 200; ++i)
      entries.push_back(plain_entry(fmt::format("{}.glb", i)));
    ASSERT_TRUE(catalogue.put(entries));
  }
  const std::string whole = bytes_of(folder.path() / "c.db");
  EXPECT_THAT(error_of(folder.write("half.db", whole.substr(0, whole.size() / 2))),
              is_error(ErrorCode::damaged, 0, {"half.db", "content add"}));
  std::string holes = whole;
  std::fill(holes.begin() + 4096, holes.end() - 4096, '\xff');
  EXPECT_THAT(error_of(folder.write("holes.db", holes)), is_error(ErrorCode::damaged, 0, {"holes.db", "content add"}));
  std::string path_out = whole;
  for (std::size_t at = path_out.find("77.glb"); at != std::string::npos; at = path_out.find("77.glb", at))
    path_out.replace(at, 6, "../..g");
  const auto lying = Catalogue::open(folder.write("lying.db", path_out), Catalogue::Access::read);
  EXPECT_FALSE(lying && lying->entries()) << "an entry outside the folder was given out";
}

TEST(Catalogue, APutThatFailsHalfWayLeavesWhatWasThere) {
  const ScratchFolder folder;
  Catalogue catalogue = opened(folder.path() / "c.db");
  ASSERT_TRUE(catalogue.put(std::vector{plain_entry("a.glb")}));
  CatalogueEntry large = plain_entry("large.glb");
  large.titles["en"] = std::string(1U << 20U, 'x');
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{100'000, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const auto put = catalogue.put(std::vector{plain_entry("b.glb"), large});
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(put);
  EXPECT_THAT(put.error(), is_error(ErrorCode::io_failure, 0, {"the catalogue is as it was"}));
  EXPECT_EQ(*opened(folder.path() / "c.db").entries(), std::vector{plain_entry("a.glb")});
  EXPECT_TRUE(catalogue.put(std::vector{plain_entry("b.glb")})) << "and it goes on";
}

TEST(Catalogue, NothingLeavesTheFolder) {
  for (const char* path : {"", "/etc/passwd", "../a.glb", "a/../../b.glb", "a//b.glb", "./a.glb", "a/", ".", ".."})
    EXPECT_FALSE(is_inside(path)) << path;
  for (const char* path : {"a.glb", "a/b c/d.glb", "..a/b.glb", ".a.glb"})
    EXPECT_TRUE(is_inside(path)) << path;
  const ScratchFolder folder;
  EXPECT_EQ(path_inside(folder.path(), folder.path() / "x/../a.glb"), "a.glb");
  EXPECT_THAT(path_inside(folder.path() / "below", folder.path() / "a.glb").error(),
              is_error(ErrorCode::conflict, 0, {"a.glb", (folder.path() / "below").string()}));
  EXPECT_THAT(opened(folder.path() / "c.db").put(std::vector{plain_entry("../a.glb")}).error(),
              is_error(ErrorCode::invalid_value, 0, {"../a.glb"}));
}

TEST(Catalogue, FindsByPathByNameAndByHash) {
  std::vector<CatalogueEntry> entries{plain_entry("screw/screw.x3d"), plain_entry("screw.glb"),
                                      plain_entry("pump.glb")};
  EXPECT_THAT(find_entries(entries, "screw"), SizeIs(2));
  EXPECT_THAT(find_entries(entries, "screw.glb"), ElementsAre(entries[1]));
  EXPECT_THAT(find_entries(entries, entries[2].hash), ElementsAre(entries[2]));
  EXPECT_THAT(find_entries(entries, entries[2].hash.substr(0, 6)), ElementsAre(entries[2]));
  EXPECT_THAT(find_entries(entries, entries[2].hash.substr(0, 3)), SizeIs(0));
}

TEST(Catalogue, KindsByEnding) {
  EXPECT_EQ(kind_of_file("a/B.GLB"), ContentKind::model);
  EXPECT_EQ(kind_of_file("a.x3d"), ContentKind::scenario);
  EXPECT_FALSE(kind_of_file("a.py"));
  EXPECT_FALSE(kind_of_file("glb"));
  for (std::size_t i = 0; i < kContentKinds; ++i) {
    const auto kind = static_cast<ContentKind>(i);
    EXPECT_EQ(kind_of_word(word_of(kind)), kind);
  }
}

}  // namespace
}  // namespace mechane::content
