#include "server/log/log.hpp"

#include <algorithm>
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/base/utf8.hpp"

namespace mechane::log {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

/// What is on stderr after one message.
std::string shown(std::string_view text) {
  testing::internal::CaptureStderr();
  start("test", Level::info);
  info(text);
  return testing::internal::GetCapturedStderr();
}

TEST(Log, ControlCharactersOfStrangersAreShownAndNotObeyed) {
  EXPECT_THAT(shown("kiosk \x1b[2J\x1b]0;mine\x07 joined\r"),
              EndsWith("test: kiosk \\x1b[2J\\x1b]0;mine\\x07 joined\\x0d\n"));
  EXPECT_THAT(shown("one byte \x9b and two \xc2\x9b, and \x7f"),
              EndsWith("one byte \\x9b and two \\xc2\\x9b, and \\x7f\n"));
  EXPECT_THAT(shown("Ο κοχλίας\tcosts 3 €, 𓂀"), EndsWith("Ο κοχλίας\tcosts 3 €, 𓂀\n"));
}

TEST(Log, ALineBreakDoesNotBeginAMessage) {
  EXPECT_THAT(shown("kiosk 'a\n2026-11-22 13:00:00.000 error   server: all is lost'"), HasSubstr("\n    2026-11-22"));
}

RC_GTEST_PROP(LogText, WhateverTheBytesALineIsPrintableUtf8, (const std::string& bytes)) {
  const std::string line = shown(bytes);
  RC_ASSERT(!first_bad_utf8(line));
  RC_ASSERT(std::none_of(line.begin(), line.end(),
                         [](char c) { return (c >= 0 && c < 0x20 && c != '\n' && c != '\t') || c == 0x7F; }));
}

TEST(Log, EqualWarningsAreShownOnceAndCountedAndEachCountsAsTrouble) {
  EXPECT_EXIT(
      {
        start("test", Level::info);
        for (int i = 0; i < 6436; ++i)
          warning("no room for kiosk 'a'");
        if (trouble().count != 6436) std::abort();
        std::exit(0);
      },
      testing::ExitedWithCode(0),
      "^[^\n]*no room for kiosk 'a'\n[^\n]*no room for kiosk 'a' .again 6435 times within 60 s.\n$");
}

TEST(Log, AWarningThatCameTwiceCameAgainOnce) {
  EXPECT_EXIT(
      {
        start("test", Level::info);
        warning("the device failed");
        warning("the device failed");
        std::exit(0);
      },
      testing::ExitedWithCode(0), "the device failed .again once within 60 s.\n$");
}

TEST(Log, MessagesThatAreNoWarningsAndOtherWarningsAreShownEachTime) {
  testing::internal::CaptureStderr();
  start("test", Level::info);
  for (int i = 0; i < 3; ++i) {
    info("here");
    warning("there " + std::to_string(i));
  }
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 6) << text;
}

}  // namespace
}  // namespace mechane::log
