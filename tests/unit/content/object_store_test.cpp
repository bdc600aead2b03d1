#include "server/content/object_store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/collision/object_io.hpp"
#include "tests/support/error_like.hpp"
#include "tests/unit/content/model_files.hpp"

namespace mechane::content {
namespace {

using test::is_error;
using testing::SizeIs;

class ObjectStoreTest : public testing::Test {
 protected:
  ObjectStoreTest() : model_(folder_.write("cube.glb", cube_glb())), cache_(folder_.path() / "made/when/needed") {
    config_.map_resolution = 16;
    config_.sample_spacing_m = 0.2;
  }
  /// Loads with a new store, as after a restart. Counts the builds.
  Expected<std::shared_ptr<const collision::Object>> load(const std::string& node) {
    ObjectStore store(cache_);
    store.on_progress([this](const std::string&, std::size_t parts) {
      ++builds_;
      parts_ = parts;
    });
    return store.load(model_, node, config_);
  }
  [[nodiscard]] std::vector<std::filesystem::path> kept() const {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(cache_)) {
      if (entry.path().extension() == ".part") files.push_back(entry.path());
    }
    return files;
  }

  ScratchFolder folder_;
  std::filesystem::path model_;
  std::filesystem::path cache_;
  collision_build::BuildConfig config_;
  int builds_ = 0;
  std::size_t parts_ = 0;
};

TEST_F(ObjectStoreTest, BuildsOnceAndThenFindsTheSameObject) {
  const auto first = load("BODY");
  ASSERT_TRUE(first) << first.error().to_string();
  EXPECT_THAT((*first)->parts, SizeIs(1));
  EXPECT_EQ((*first)->parts[0].name, "part_block");
  const auto second = load("BODY");
  ASSERT_TRUE(second);
  EXPECT_EQ(builds_, 1);
  EXPECT_EQ(parts_, 1U);
  EXPECT_EQ(collision::write_object(**first), collision::write_object(**second));
  EXPECT_THAT(kept(), SizeIs(1));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(cache_), {}), 2) << "a draft was left behind";
}

TEST_F(ObjectStoreTest, OneStoreGivesOneObject) {
  ObjectStore store(cache_);
  const auto a = store.load(model_, "BODY", config_);
  const auto b = store.load(model_, "BODY", config_);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(*a, *b);
}

TEST_F(ObjectStoreTest, WhateverChangesTheObjectChangesTheFile) {
  ObjectStore store(cache_);
  std::vector<std::string> names;
  const auto note = [&](const std::string& node) {
    names.push_back(store.cache_file(model_, node, config_)->string());
  };
  note("BODY");
  note("trimming");
  config_.sample_spacing_m += 1e-12;
  note("BODY");
  config_.seed = 7;
  note("BODY");
  folder_.write("cube.glb", cube_glb(-1.001F));
  note("BODY");
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
}

TEST_F(ObjectStoreTest, AnotherColourBuildsNothing) {
  ASSERT_TRUE(load("BODY"));
  folder_.write("cube.glb", cube_glb(-1, R"("emissiveFactor":[1,0,0],)"));
  ASSERT_TRUE(load("BODY"));
  EXPECT_EQ(builds_, 1);
  folder_.write("cube.glb", cube_glb(-1.001F, R"("emissiveFactor":[1,0,0],)"));
  ASSERT_TRUE(load("BODY"));
  EXPECT_EQ(builds_, 2) << "a corner lies elsewhere";
}

TEST_F(ObjectStoreTest, WhatIsKnownIsNotEvenImported) {
  ASSERT_TRUE(load("BODY"));
  ImportLimits without_helper;
  without_helper.helper = folder_.path() / "absent";
  EXPECT_TRUE(ObjectStore(cache_, without_helper).load(model_, "BODY", config_));
  EXPECT_FALSE(ObjectStore(cache_, without_helper).load(model_, "trimming", config_));
}

TEST_F(ObjectStoreTest, ADamagedFileIsBuiltAgain) {
  ASSERT_TRUE(load("BODY"));
  const auto file = kept().at(0);
  const auto size = std::filesystem::file_size(file);
  for (const std::uintmax_t left : {std::uintmax_t{0}, size / 2}) {
    std::filesystem::resize_file(file, left);
    const auto again = load("BODY");
    ASSERT_TRUE(again) << again.error().to_string();
    EXPECT_EQ(std::filesystem::file_size(file), size);
  }
  EXPECT_EQ(builds_, 3);
}

TEST_F(ObjectStoreTest, ACacheThatCannotBeWrittenOnlyCostsTime) {
  cache_ = folder_.write("file", "not a folder") / "below";
  EXPECT_TRUE(load("BODY"));
  EXPECT_TRUE(load("BODY"));
  EXPECT_EQ(builds_, 2);
}

TEST_F(ObjectStoreTest, SaysWhatIsMissing) {
  EXPECT_THAT(load("ABSENT").error(), is_error(ErrorCode::unknown_name, 0, {"cube.glb", "ABSENT"}));
  model_ = folder_.path() / "missing.glb";
  EXPECT_THAT(load("BODY").error(), is_error(ErrorCode::not_found, 0, {"missing.glb"}));
}

}  // namespace
}  // namespace mechane::content
