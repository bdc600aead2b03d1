#include "client-sdk/display/picture_folder.hpp"

#include <fstream>
#include <iterator>
#include <thread>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "client-sdk/picture/image_file.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::display {
namespace {

picture::ImageData plain_picture(std::uint8_t grey) {
  return {8, 4, std::vector<std::uint8_t>(std::size_t{4} * 8 * 4, grey), true};
}

std::uint8_t grey_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::vector<char> text{std::istreambuf_iterator<char>(in), {}};
  const auto image = picture::decode_image(std::as_bytes(std::span(text)), file.string());
  return image && !image->rgba.empty() ? image->rgba.front() : 0;
}

TEST(PictureFolder, a_slow_disk_holds_up_nobody_and_in_the_end_all_is_written_in_order) {
  const test::ScratchFolder folder;
  // Nobody reads what is written to it: as slow as a disk can be.
  const std::string pipe = (folder.path() / "first-mono.png").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  PictureFolder pictures(folder.path().string(), picture::Stereo::mono);
  pictures.write(plain_picture(10), "first");
  for (std::uint8_t i = 1; i < PictureFolder::kMostWaiting; ++i)
    pictures.write(plain_picture(20 + i), "next-" + std::to_string(i));
  EXPECT_TRUE(pictures.take_written().empty());
  std::jthread disk([&] { std::ifstream(pipe, std::ios::binary).ignore(1 << 20); });
  pictures.write(plain_picture(90), "last");  // waits for the first
  const auto written = pictures.finish();
  ASSERT_EQ(written.size(), PictureFolder::kMostWaiting + 1);
  EXPECT_TRUE(written.front().path.ends_with("/first-mono.png"));
  EXPECT_TRUE(written.back().path.ends_with("/last-mono.png"));
  for (const PictureFolder::Written& picture : written)
    EXPECT_TRUE(picture.result.has_value() && !picture.requested) << picture.path;
  EXPECT_EQ(grey_of(written[1].path), 21);
  EXPECT_EQ(grey_of(written.back().path), 90);
  EXPECT_TRUE(pictures.finish().empty()) << "told once";
}

TEST(PictureFolder, what_a_person_asks_for_takes_a_new_name_and_errors_are_told_to_who_asked) {
  const test::ScratchFolder folder;
  folder.write("request-001-mono.png", "of yesterday");
  PictureFolder pictures(folder.path().string(), picture::Stereo::mono);
  pictures.write_requested(plain_picture(7), {41, 42});
  const auto written = pictures.finish();
  ASSERT_EQ(written.size(), 1U);
  EXPECT_TRUE(written.front().path.ends_with("/request-002-mono.png"));
  EXPECT_TRUE(written.front().requested);
  EXPECT_EQ(written.front().requests, (std::vector<std::uint64_t>{41, 42}));
  EXPECT_EQ(grey_of(written.front().path), 7);

  std::filesystem::remove_all(folder.path());
  pictures.write_requested(plain_picture(8), {43});
  const auto failed = pictures.finish();
  ASSERT_EQ(failed.size(), 1U);
  ASSERT_FALSE(failed.front().result.has_value());
  EXPECT_EQ(failed.front().requests, std::vector<std::uint64_t>{43});
  EXPECT_THAT(failed.front().result.error(), test::is_error(ErrorCode::io_failure, 0, {failed.front().path}));
}

TEST(PictureFolder, without_a_folder_nothing_is_written) {
  PictureFolder pictures("", picture::Stereo::mono);
  EXPECT_FALSE(pictures.wanted());
  pictures.write(plain_picture(1), "frame");
  EXPECT_TRUE(pictures.finish().empty());
}

}  // namespace
}  // namespace mechane::display
