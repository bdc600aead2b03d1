#include "client-sdk/gateway/http/request_path.hpp"

#include <fstream>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "client-sdk/gateway/http/security_headers.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::gateway {
namespace {

TEST(RequestTarget, IsDecoded) {
  const auto target = parse_target("/kiosk/a%20b?token=x%2By+z&empty&again=1&again=2");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->path, "/kiosk/a b");
  EXPECT_EQ(target->query.at("token"), "x+y z");
  EXPECT_EQ(target->query.at("empty"), "");
  EXPECT_EQ(target->query.at("again"), "1");
}

TEST(RequestTarget, WhatIsNoTextIsRefused) {
  for (const char* target : {"", "kiosk", "*", "/%", "/%4", "/%zz", "/%00", "/a%0Ab", "/%ff", "/?a=%"})
    EXPECT_EQ(parse_target(target).error().code, ErrorCode::invalid_value) << target;
}

TEST(ByteRangeHeader, GivesThePart) {
  const auto part = [](const char* header) { return **parse_range(header, 100); };
  EXPECT_EQ(part("bytes=0-9").from, 0U);
  EXPECT_EQ(part("bytes=0-9").size, 10U);
  EXPECT_EQ(part("bytes=90-").size, 10U);
  EXPECT_EQ(part("bytes=-5").from, 95U);
  EXPECT_EQ(part("bytes=50-1000").size, 50U);
  EXPECT_EQ(part("bytes=-1000").size, 100U);
}

TEST(ByteRangeHeader, WhatIsNotUnderstoodGivesTheWholeFile) {
  for (const char* header : {"", "bytes", "bytes=", "bytes=-", "bytes=a-b", "bytes=9-1", "bytes=0-1,3-4", "lines=1-2",
                             "bytes=99999999999999999999-"})
    EXPECT_FALSE(*parse_range(header, 100)) << header;
}

TEST(ByteRangeHeader, WhatDoesNotExistIsRefused) {
  for (const char* header : {"bytes=100-", "bytes=100-101", "bytes=-0"})
    EXPECT_EQ(parse_range(header, 100).error().code, ErrorCode::too_large) << header;
  EXPECT_FALSE(parse_range("bytes=0-", 0));
}

RC_GTEST_PROP(ByteRangeHeader, IsAlwaysWithinTheFile, ()) {
  const auto first = *rc::gen::inRange<std::size_t>(0, 200), last = *rc::gen::inRange<std::size_t>(0, 200);
  const auto whole = *rc::gen::inRange<std::size_t>(0, 150);
  const auto range = parse_range("bytes=" + std::to_string(first) + "-" + std::to_string(last), whole);
  if (!range || !*range) return;
  RC_ASSERT((*range)->size > 0);
  RC_ASSERT((*range)->from + (*range)->size <= whole);
}

TEST(EntityTags, AreFoundInALine) {
  EXPECT_TRUE(names_tag("\"a\", W/\"b\"", "\"b\""));
  EXPECT_TRUE(names_tag("*", "\"b\""));
  EXPECT_FALSE(names_tag("\"a\"", "\"b\""));
  EXPECT_FALSE(names_tag("", "\"b\""));
}

class FileWithin : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder() / "exhibit/sounds");
    std::ofstream(folder() / "exhibit/sounds/one.ogg") << "sound";
    std::ofstream(folder() / "secret.json") << "secret";
    std::filesystem::create_symlink(folder() / "secret.json", folder() / "exhibit/away.json");
    std::filesystem::create_symlink("sounds/one.ogg", folder() / "exhibit/here.ogg");
    std::filesystem::create_symlink(folder(), folder() / "exhibit/up");
  }
  [[nodiscard]] const std::filesystem::path& folder() const { return scratch_.path(); }
  [[nodiscard]] auto within(const char* path) const { return file_within(folder() / "exhibit", path); }

 private:
  test::ScratchFolder scratch_;
};

TEST_F(FileWithin, FindsFilesAndLinksInside) {
  EXPECT_EQ(*within("sounds/one.ogg"), folder() / "exhibit/sounds/one.ogg");
  EXPECT_EQ(*within("here.ogg"), folder() / "exhibit/sounds/one.ogg");
}

TEST_F(FileWithin, NoPathLeadsOut) {
  for (const char* path : {"../secret.json", "sounds/../../secret.json", "/etc/passwd", "", "sounds//one.ogg",
                           "./sounds", ".git", "sounds\\one.ogg", "away.json", "up/secret.json", "sounds/"})
    EXPECT_FALSE(within(path)) << path;
  EXPECT_EQ(within("sounds").error().code, ErrorCode::not_found) << "a folder is no file";
  EXPECT_EQ(within("nothing.ogg").error().code, ErrorCode::not_found);
}

TEST(OwnOrigin, IsTheHostItself) {
  EXPECT_TRUE(is_own_origin("http://Museum:8480", "museum:8480", false));
  EXPECT_TRUE(is_own_origin("https://[::1]:8480", "[::1]:8480", true));
  EXPECT_FALSE(is_own_origin("http://museum:8480", "museum:8480", true));
  EXPECT_FALSE(is_own_origin("", "museum", false));
  EXPECT_FALSE(is_own_origin("null", "museum", false));
  EXPECT_FALSE(is_own_origin("http://", "", false));
  EXPECT_FALSE(is_own_origin("http://museum.example", "museum", false));
}

TEST(SecurityHeaders, WhatCannotBeAHostStaysOut) {
  for (const auto& [name, value] : security_headers(true, "a; script-src *", false, 0))
    EXPECT_EQ(value.find("script-src *"), std::string::npos) << name;
}

TEST(SecurityHeaders, APageMayTalkToOneProgramBesideIt) {
  const auto policy = [](std::uint16_t program) {
    return security_headers(true, "museum", false, program).front().second;
  };
  EXPECT_NE(policy(8765).find("connect-src 'self' blob: wss://museum ws://127.0.0.1:8765;"), std::string::npos);
  EXPECT_EQ(policy(0).find("127.0.0.1"), std::string::npos);
}

}  // namespace
}  // namespace mechane::gateway
