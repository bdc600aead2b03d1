#include "server/content/catalogue_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/content/catalogue_export.hpp"
#include "tests/support/error_like.hpp"
#include "tests/unit/content/catalogue_files.hpp"

namespace mechane::content {
namespace {

using test::is_error;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using Fault = CatalogueFault;
namespace fs = std::filesystem;

/// A scenario in two languages with a model, a sound each, and a page.
class CatalogueCheckTest : public testing::Test {
 protected:
  CatalogueCheckTest() : catalogue_(*Catalogue::open(folder_.path() / "catalogue.db", Catalogue::Access::write)) {
    for (const char* path : {"crane.x3d", "crane.glb", "take.el.ogg", "take.en.ogg", "crane.md"})
      add(path);
    entries_[0].languages = {"el", "en"};
    entries_[0].refers_to = {"crane.glb", "crane.md", "take.el.ogg", "take.en.ogg"};
    entries_[0].wordings = {{"title", {"el", "en"}}, {"step take, audio", {"el", "en"}}};
    put();
  }
  void add(const std::string& path) {
    CatalogueEntry entry = plain_entry(path);
    entry.hash = *content_hash(folder_.write(path, "bytes of " + path));
    entry.credits.licence = "Apache-2.0";
    entries_.push_back(entry);
  }
  void put() { ASSERT_TRUE(catalogue_.put(entries_)); }
  /// "path: kind", and nothing else is wrong.
  [[nodiscard]] std::vector<std::string> faults() const {
    std::vector<std::string> lines;
    const auto found = verify(catalogue_);
    for (const Fault& fault : *found) {
      EXPECT_FALSE(fault.remedy.empty()) << fault.what;
      lines.push_back(fmt::format("{}: {}", fault.path, word_of(fault.kind)));
      last_ = fault.what;
      last_remedy_ = fault.remedy;
    }
    return lines;
  }
  [[nodiscard]] bool exports(const fs::path& to) const { return export_content(catalogue_, entries_, to).has_value(); }
  /// Empty where the export is done after all.
  [[nodiscard]] Error export_error(const fs::path& to) const {
    const auto done = export_content(catalogue_, entries_, to);
    return done ? Error{} : done.error();
  }
  [[nodiscard]] std::vector<std::string> names_beside() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(target_.path()))
      names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }

  ScratchFolder folder_;
  ScratchFolder target_;
  Catalogue catalogue_;
  std::vector<CatalogueEntry> entries_;
  mutable std::string last_;
  mutable std::string last_remedy_;
};

TEST_F(CatalogueCheckTest, NothingIsWrongAtFirst) {
  EXPECT_THAT(faults(), IsEmpty());
}

TEST_F(CatalogueCheckTest, AChangedByteAndAMissingFile) {
  folder_.write("crane.glb", "bytes of crane.glB");
  fs::remove(folder_.path() / "take.el.ogg");
  EXPECT_THAT(faults(), ElementsAre("crane.glb: changed", "take.el.ogg: gone"));
}

TEST_F(CatalogueCheckTest, AReferenceToAFileThatIsNotAnEntry) {
  ASSERT_EQ(*catalogue_.remove(std::vector<std::string>{"crane.glb"}), 1U);
  EXPECT_THAT(faults(), ElementsAre("crane.glb: unknown", "crane.x3d: missing"));
  EXPECT_THAT(last_, HasSubstr("crane.glb"));
  EXPECT_THAT(last_remedy_, HasSubstr("content add")) << "the file exists";
  fs::remove(folder_.path() / "crane.glb");
  EXPECT_THAT(faults(), ElementsAre("crane.x3d: missing"));
  EXPECT_THAT(last_, HasSubstr("crane.glb"));
  EXPECT_THAT(last_remedy_, HasSubstr("make the file"));
}

TEST_F(CatalogueCheckTest, ALanguageThatWordsLack) {
  entries_[0].wordings["step take, hint"] = {"el"};
  put();
  EXPECT_THAT(faults(), ElementsAre("crane.x3d: language"));
  EXPECT_THAT(last_, AllOf(HasSubstr("'en'"), HasSubstr("step take, hint")));
  entries_[0].wordings.erase("step take, hint");
  entries_[0].languages = {"de", "el", "en"};
  put();
  EXPECT_THAT(faults(), ElementsAre("crane.x3d: language"));
  EXPECT_THAT(last_, HasSubstr("and 1 more"));
}

TEST_F(CatalogueCheckTest, APageThatSaysItsLanguageNeedsTheOthers) {
  entries_[4].languages = {"en"};
  put();
  EXPECT_THAT(faults(), ElementsAre("crane.x3d: language"));
  EXPECT_THAT(last_, HasSubstr("not in 'el'"));
}

TEST_F(CatalogueCheckTest, AnOrphanAndAFileThatNobodyAdded) {
  add("left.glb");
  put();
  folder_.write("new.ogg", "sound");
  folder_.write("README.md", "no content: no scenario of this name");
  folder_.write("crane.py", "no content");
  folder_.write(".hidden.glb", "no content");
  EXPECT_THAT(faults(), ElementsAre("left.glb: orphan", "new.ogg: unknown"));
}

TEST_F(CatalogueCheckTest, TwoScenariosOfOneId) {
  add("copy.x3d");
  for (CatalogueEntry& entry : entries_) {
    if (entry.path == "crane.x3d") entry.name = "copy";
  }
  put();
  EXPECT_THAT(faults(), ElementsAre("crane.x3d: twice"));
  EXPECT_THAT(last_, AllOf(HasSubstr("'copy'"), HasSubstr("copy.x3d")));
}

TEST_F(CatalogueCheckTest, AMissingLicenceIsANote) {
  entries_[1].credits.licence.clear();
  put();
  ASSERT_THAT(faults(), ElementsAre("crane.glb: no licence"));
  EXPECT_TRUE(verify(catalogue_)->front().is_note());
}

TEST_F(CatalogueCheckTest, AnExportIsWholeAndVerifies) {
  const fs::path to = target_.path() / "kiosk";
  const auto done = export_content(catalogue_, entries_, to);
  ASSERT_TRUE(done) << done.error().to_string();
  EXPECT_EQ(done->files, 5U);
  const auto copy = Catalogue::open(to / kCatalogueFileName, Catalogue::Access::read);
  ASSERT_TRUE(copy) << copy.error().to_string();
  EXPECT_EQ(*copy->entries(), *catalogue_.entries());
  EXPECT_THAT(*verify(*copy), IsEmpty());
  EXPECT_EQ(bytes_of(to / "crane.glb"), "bytes of crane.glb");
  EXPECT_THAT(names_beside(), ElementsAre("kiosk"));
}

TEST_F(CatalogueCheckTest, AnOlderExportIsReplacedAndNothingElse) {
  const fs::path to = target_.path() / "kiosk";
  ASSERT_TRUE(exports(to));
  folder_.write("crane.glb", "newer bytes");
  entries_[1].hash = *content_hash(folder_.path() / "crane.glb");
  put();
  ASSERT_TRUE(exports(to / ""));
  EXPECT_EQ(bytes_of(to / "crane.glb"), "newer bytes");
  EXPECT_THAT(names_beside(), ElementsAre("kiosk"));
  std::ofstream(to / "notes.txt") << "of a person";
  EXPECT_THAT(export_error(to), is_error(ErrorCode::conflict, 0, {"notes.txt"}));
  EXPECT_TRUE(fs::exists(to / "notes.txt"));
  EXPECT_THAT(export_error(folder_.path() / "crane.md"),
              is_error(ErrorCode::conflict, 0, {"outside " + folder_.path().string()}));
  std::ofstream(target_.path() / "file") << "of a person";
  EXPECT_THAT(export_error(target_.path() / "file"), is_error(ErrorCode::conflict, 0, {"a file of this name"}));
  ASSERT_EQ(fs::remove(to / kCatalogueFileName), true);
  EXPECT_THAT(export_error(to), is_error(ErrorCode::conflict, 0, {"an older export"}));
}

TEST_F(CatalogueCheckTest, AnExportOfAChangedFileLeavesNothingBehind) {
  folder_.write("take.en.ogg", "other bytes");
  EXPECT_THAT(export_error(target_.path() / "kiosk"), is_error(ErrorCode::conflict, 0, {"take.en.ogg"}));
  fs::remove(folder_.path() / "take.en.ogg");
  EXPECT_THAT(export_error(target_.path() / "kiosk"), is_error(ErrorCode::not_found, 0, {"take.en.ogg"}));
  EXPECT_THAT(names_beside(), IsEmpty());
}

TEST_F(CatalogueCheckTest, WhatAScenarioNeedsInAllSteps) {
  entries_[1].refers_to = {"crane.md", "crane.x3d", "absent.png"};
  EXPECT_THAT(with_all_referred(entries_, {entries_[1]}), SizeIs(5)) << "through a circle, once each";
  EXPECT_THAT(with_all_referred(entries_, {entries_[2]}), SizeIs(1));
}

}  // namespace
}  // namespace mechane::content
