#include "client-sdk/display/display_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/error_like.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::display {
namespace {

namespace fs = std::filesystem;
using test::is_error;

SourceOptions play_and_record(const fs::path& play, const fs::path& record) {
  SourceOptions options;
  options.play = play.string();
  options.record = record.string();
  return options;
}

TEST(DisplaySource, what_is_read_is_not_recorded_to_by_whatever_name) {
  const test::ScratchFolder scratch;
  const fs::path visit = scratch.write("visit.seen", "a recording");
  fs::create_directory(scratch.path() / "more");
  fs::create_symlink("visit.seen", scratch.path() / "soft.seen");
  fs::create_hard_link(visit, scratch.path() / "hard.seen");
  fs::create_directory_symlink(".", scratch.path() / "around");
  for (const char* name :
       {"visit.seen", "./visit.seen", "more/../visit.seen", "soft.seen", "hard.seen", "around/visit.seen"}) {
    const fs::path record = scratch.path() / name;
    const auto played = check_recordings(play_and_record(visit, record), "");
    ASSERT_FALSE(played) << name;
    EXPECT_THAT(played.error(), is_error(ErrorCode::conflict, 0, {"--play", "--record"}));
    const auto invites = check_recordings(play_and_record("", record), visit.string());
    ASSERT_FALSE(invites) << name;
    EXPECT_THAT(invites.error(), is_error(ErrorCode::conflict, 0, {"--attract", "--record"}));
  }
}

TEST(DisplaySource, any_other_file_may_be_recorded_to) {
  const test::ScratchFolder scratch;
  const fs::path visit = scratch.write("visit.seen", "a recording");
  const fs::path other = scratch.write("other.seen", "a recording");  // as long, and of the same bytes
  EXPECT_TRUE(check_recordings(play_and_record(visit, other), visit.string()));
  EXPECT_TRUE(check_recordings(play_and_record(visit, scratch.path() / "new.seen"), ""));
  EXPECT_TRUE(check_recordings(play_and_record(visit, ""), visit.string()));
  EXPECT_TRUE(check_recordings(play_and_record("", other), ""));
}

}  // namespace
}  // namespace mechane::display
