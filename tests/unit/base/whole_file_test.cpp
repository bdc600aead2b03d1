#include "server/base/whole_file.hpp"

#include <csignal>
#include <fstream>
#include <iterator>
#include <string_view>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/support/error_like.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane {
namespace {

namespace fs = std::filesystem;
using test::is_error;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Expected<void> write(const fs::path& file, std::string_view text, WholeFile how) {
  return write_whole(file, std::as_bytes(std::span(text)), how);
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
}

TEST(WholeFile, IsWrittenAndReplacedWithNothingLeftBesideIt) {
  const test::ScratchFolder folder;
  for (const auto& [how, rights] : {std::pair(WholeFile::shared, 0600), std::pair(WholeFile::durable, 0640),
                                    std::pair(WholeFile::document, 0666)}) {
    const fs::path file = folder.path() / "a";
    fs::remove(file);
    ASSERT_TRUE(write(file, "first", how));
    ASSERT_TRUE(write(file, "", how));
    EXPECT_EQ(text_of(file), "");
    ASSERT_TRUE(write(file, "second", how));
    EXPECT_EQ(text_of(file), "second");
    EXPECT_EQ(static_cast<int>(fs::status(file).permissions()) & ~rights, 0);
    EXPECT_EQ(files_in(folder.path()), 1U);
  }
}

TEST(WholeFile, ADocumentLeavesLinksAndDevicesWhatTheyAre) {
  const test::ScratchFolder folder;
  const fs::path file = folder.write("file", "old");
  const fs::path link = folder.path() / "link";
  fs::create_symlink("file", link);
  ASSERT_TRUE(write(link, "new", WholeFile::document));
  EXPECT_EQ(text_of(file), "new");
  EXPECT_TRUE(fs::is_symlink(link));
  fs::create_symlink("/dev/full", folder.path() / "full");
  EXPECT_THAT(write(folder.path() / "full", "text", WholeFile::document).error(),
              is_error(ErrorCode::io_failure, 0, {"full", "No space left"}));
}

TEST(WholeFile, OnlyASharedOneMakesItsFolder) {
  const test::ScratchFolder folder;
  EXPECT_TRUE(write(folder.path() / "made/here/a", "text", WholeFile::shared));
  EXPECT_THAT(write(folder.path() / "absent/a", "text", WholeFile::durable).error(),
              is_error(ErrorCode::io_failure, 0, {"absent/a", "No such file or directory"}));
  EXPECT_THAT(write(folder.write("file", "no folder") / "a", "text", WholeFile::shared).error(),
              is_error(ErrorCode::io_failure, 0, {"file/a", "Not a directory"}));
}

TEST(WholeFile, AFullDiskLeavesWhatWasThereAndSaysSo) {
  const test::ScratchFolder folder;
  for (const WholeFile how : {WholeFile::shared, WholeFile::durable}) {
    const fs::path file = folder.path() / "a";
    ASSERT_TRUE(write(file, "small", how));
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{1000, before.rlim_max};
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    const auto written = write(file, std::string(2000, 'x'), how);
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    ASSERT_FALSE(written);
    EXPECT_THAT(written.error(), is_error(ErrorCode::io_failure, 0, {file.string(), "make room on the disk"}));
    EXPECT_EQ(text_of(file), "small");
    EXPECT_EQ(files_in(folder.path()), 1U) << "a draft was left behind";
  }
}

TEST(WholeFile, SeveralWritersOfASharedOneLeaveOneWholeFile) {
  const test::ScratchFolder folder;
  const fs::path file = folder.path() / "a";
  {
    std::vector<std::jthread> writers;
    for (const char letter : {'a', 'b', 'c'}) {
      writers.emplace_back([&file, text = std::string(100'000, letter)] {
        for (int i = 0; i < 20; ++i)
          EXPECT_TRUE(write(file, text, WholeFile::shared));
      });
    }
  }
  const std::string text = text_of(file);
  EXPECT_EQ(text.size(), 100'000U);
  EXPECT_EQ(text.find_first_not_of(text.front()), std::string::npos);
  EXPECT_EQ(files_in(folder.path()), 1U);
}

TEST(WholeFile, IsReadUpToALimit) {
  const test::ScratchFolder folder;
  const fs::path file = folder.write("a", "text");
  const auto bytes = read_whole(file, 4);
  ASSERT_TRUE(bytes) << bytes.error().to_string();
  EXPECT_EQ(std::string_view(reinterpret_cast<const char*>(bytes->data()), bytes->size()), "text");
  EXPECT_THAT(read_whole(file, 3).error(), is_error(ErrorCode::too_large, 0, {file.string(), "4 bytes"}));
  EXPECT_EQ(read_whole(folder.write("empty", ""), 0).value().size(), 0U);
  EXPECT_THAT(read_whole(folder.path() / "absent", 4).error(), is_error(ErrorCode::not_found, 0, {"absent"}));
  EXPECT_THAT(read_whole(folder.path(), 4).error(),
              is_error(ErrorCode::io_failure, 0, {folder.path().string(), "Is a directory"}));
}

}  // namespace
}  // namespace mechane
