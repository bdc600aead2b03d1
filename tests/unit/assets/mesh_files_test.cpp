#include "client-sdk/assets/mesh_files.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/content/content_hash.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::assets {
namespace {

namespace fs = std::filesystem;
using content::Catalogue;
using testing::ElementsAre;
using testing::IsEmpty;

/// A server's folder and a kiosk's, with one model in each, and the kiosk's catalogue.
class MeshFilesTest : public testing::Test {
 protected:
  MeshFilesTest() {
    fs::create_directories(top_ / "server");
    fs::create_directories(top_ / "kiosk/models");
    write("server/screw.glb", "the server's");
    write("kiosk/models/screw.glb", "the server's");
    hash_ = *content::content_hash(top_ / "server/screw.glb");
    catalogue_.emplace(*Catalogue::open(top_ / "kiosk/catalogue.db", Catalogue::Access::write));
    content::CatalogueEntry entry;
    entry.path = "models/screw.glb";
    entry.hash = hash_;
    EXPECT_TRUE(catalogue_->put(std::vector{entry}));
  }
  void write(const char* path, const char* bytes) const { std::ofstream(top_ / path) << bytes; }
  /// Where the file is found, from the top; or "nowhere".
  std::string find(const Catalogue* catalogue, const std::string& hash, const char* folder = "server") {
    MeshFiles files(top_ / folder, catalogue);
    files.expect("screw.glb", hash);
    const auto found = files.find("screw.glb");
    differing_ = files.differing();
    return found ? fs::weakly_canonical(*found).lexically_relative(fs::weakly_canonical(top_)).string() : "nowhere";
  }

  const test::ScratchFolder scratch_;
  const fs::path& top_ = scratch_.path();
  std::string hash_;
  std::optional<Catalogue> catalogue_;
  std::set<std::string> differing_;
};

TEST_F(MeshFilesTest, TheCatalogueComesFirstAndNeedsNoFolderOfTheServer) {
  EXPECT_EQ(find(&*catalogue_, hash_), "kiosk/models/screw.glb");
  EXPECT_EQ(find(&*catalogue_, hash_, "not on this machine"), "kiosk/models/screw.glb");
  EXPECT_THAT(differing_, IsEmpty());
}

TEST_F(MeshFilesTest, WithoutACatalogueOrAHashTheFolderIsTaken) {
  EXPECT_EQ(find(nullptr, hash_), "server/screw.glb");
  EXPECT_EQ(find(&*catalogue_, ""), "server/screw.glb");
  EXPECT_THAT(differing_, IsEmpty());
}

TEST_F(MeshFilesTest, AChangedFileOfTheCatalogueIsPassedOver) {
  write("kiosk/models/screw.glb", "something else");
  EXPECT_EQ(find(&*catalogue_, hash_), "server/screw.glb");
  EXPECT_THAT(differing_, IsEmpty());
}

TEST_F(MeshFilesTest, OtherBytesThanTheServersAreShownAndSaid) {
  write("server/screw.glb", "something else");
  EXPECT_EQ(find(nullptr, hash_), "server/screw.glb");
  EXPECT_THAT(differing_, ElementsAre("screw.glb"));
  write("kiosk/models/screw.glb", "something else again");
  EXPECT_EQ(find(&*catalogue_, hash_, "not on this machine"), "kiosk/models/screw.glb");
  EXPECT_THAT(differing_, ElementsAre("screw.glb"));
}

TEST_F(MeshFilesTest, WhatIsNowhereIsAnError) {
  EXPECT_EQ(find(nullptr, hash_, "not on this machine"), "nowhere");
  EXPECT_EQ(find(&*catalogue_, std::string(32, 'a'), "not on this machine"), "nowhere");
  const auto found = MeshFiles(top_ / "not on this machine", nullptr).find("screw.glb");
  ASSERT_FALSE(found.has_value());
  EXPECT_THAT(found.error(), test::is_error(ErrorCode::not_found, 0, {"screw.glb"}));
}

TEST(MeshFiles, WhereAFolderIsRelativeTheRemedyBeginsWithTheServersFolder) {
  const auto remedy = [](const char* folder) { return MeshFiles(folder, nullptr).find("screw.glb").error().remedy; };
  EXPECT_THAT(remedy("scenarios/of-nobody"),
              testing::StartsWith("start the display in the server's folder, or give --assets FOLDER, or --catalogue"));
  EXPECT_THAT(remedy("/of-nobody"), testing::StartsWith("give --assets FOLDER"));
}

}  // namespace
}  // namespace mechane::assets
