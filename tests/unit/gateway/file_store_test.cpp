#include "client-sdk/gateway/file_store.hpp"

#include <span>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "server/content/content_hash.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::gateway {
namespace {

constexpr std::string_view kBox =
    "<X3D version='4.0'><Scene><Transform DEF='STONE'><Shape><Box size='1 2 3'/></Shape></Transform></Scene></X3D>";

std::string hash_of(std::string_view text) {
  return content::content_hash(std::as_bytes(std::span(text)));
}

/// A folder with stone.x3d, and a store that has read nothing yet.
class FileStoreTest : public testing::Test {
 protected:
  FileStoreTest() { folder_.write("stone.x3d", kBox); }

  const test::ScratchFolder folder_;
  const std::string hash_ = hash_of(kBox);
  FileStore store_;
};

TEST_F(FileStoreTest, GivesBrowsersAnotherMeshFileAsGlb) {
  const HttpAnswer answer = store_.answer({folder_.path(), "stone.x3d", hash_, true});
  ASSERT_EQ(answer.status, 200U);
  EXPECT_EQ(answer.content_type, "model/gltf-binary");
  ASSERT_EQ(answer.body->size(), answer.size);
  EXPECT_TRUE(answer.body->starts_with("glTF"));
  EXPECT_NE(answer.body->find(R"("name":"STONE")"), std::string::npos) << "the page finds a thing by its DEF";
  EXPECT_EQ(store_.answer({folder_.path(), "stone.x3d", hash_, true}).body, answer.body) << "it is read once";
}

TEST_F(FileStoreTest, GivesNoOtherContentThanWasAskedFor) {
  EXPECT_EQ(store_.answer({folder_.path(), "stone.x3d", std::string(32, '0'), true}).status, 404U);
  EXPECT_EQ(store_.answer({folder_.path(), "stone.x3d"}).status, 403U) << "an exhibit's text is no file for visitors";
  EXPECT_EQ(store_.answer({folder_.path(), "../stone.x3d", hash_, true}).status, 404U);
}

TEST_F(FileStoreTest, AHiddenNameIsServedOnlyWhereAWorldNamesItsContent) {
  folder_.write(".preview.x3d", kBox);
  folder_.write(".secret.json", "{}");
  EXPECT_EQ(store_.answer({folder_.path(), ".preview.x3d", hash_, true}).status, 200U);
  EXPECT_EQ(store_.answer({folder_.path(), ".secret.json"}).status, 404U);
}

TEST_F(FileStoreTest, TellsWhatIsWrongWithAFaultyMesh) {
  constexpr std::string_view kCut = "<X3D version='4.0'><Scene><Shape>";
  folder_.write("cut.x3d", kCut);
  const HttpAnswer answer = store_.answer({folder_.path(), "cut.x3d", hash_of(kCut), true});
  EXPECT_GE(answer.status, 400U);
  EXPECT_NE(answer.body->find("remedy"), std::string::npos);
}

}  // namespace
}  // namespace mechane::gateway
