#include <gtest/gtest.h>

#include "client-sdk/display/display_app.hpp"
#include "tests/support/error_like.hpp"

namespace mechane::display {
namespace {

TEST(ParseSize, takes_sizes_and_tells_what_is_none) {
  EXPECT_EQ(parse_size("1280x720").value(), (picture::PixelSize{1280, 720}));
  for (const char* bad : {"", "x", "1280", "1280x", "x720", "1280x720x", "-5x10", "99999x10", "12 x 9", "0x0"}) {
    const auto size = parse_size(bad);
    ASSERT_FALSE(size.has_value()) << bad;
    EXPECT_THAT(size.error(), test::is_error(ErrorCode::invalid_value, 0, {bad}));
  }
}

}  // namespace
}  // namespace mechane::display
