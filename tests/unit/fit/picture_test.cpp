#include "client-sdk/fit/picture.hpp"

#include <set>

#include <gtest/gtest.h>

#include "client-sdk/fit/map_image.hpp"
#include "tests/unit/fit/fitted_things.hpp"

namespace mechane::fit {
namespace {

/// The share of covered pixels that are closest, in direction from black, to a colour.
double share_of(const Image& image, const Colour& colour) {
  std::size_t covered = 0;
  std::size_t like = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    if (image.rgba[i + 3] < 255) continue;
    ++covered;
    const Colour c =
        from_srgb(static_cast<std::uint32_t>(image.rgba[i] << 16 | image.rgba[i + 1] << 8 | image.rgba[i + 2]));
    if (c.matrix().normalized().dot(colour.matrix().normalized()) > 0.999F) ++like;
  }
  return covered == 0 ? 0 : static_cast<double>(like) / static_cast<double>(covered);
}

TEST(Pictures, EachPartIsSeenInItsColourOnTransparentGround) {
  const FittedObject& crank = fitted_crank();
  const Surface surface(crank);
  const Row row = Pictures(surface, crank.object, 600, 200).parts();
  int width = 0;
  for (const Image& image : row) {
    EXPECT_EQ(image.rgba[3], 0) << "the corner is empty";
    EXPECT_LE(image.height, 200);
    width += image.width;
    double all = 0;
    for (const Colour& colour : part_colours(crank.object)) {
      EXPECT_GT(share_of(image, colour), 0.03);
      all += share_of(image, colour);
    }
    EXPECT_GT(all, 0.9);
  }
  EXPECT_LE(width, 603);
  EXPECT_GT(width, 300);
}

TEST(Pictures, ErrorsShowPaleWhereTrueAndInTheirOwnColourWhereNothingIsFelt) {
  FittedObject box = fitted_box();
  const Surface good(box);
  const ErrorRow true_row = Pictures(good, box.object, 300, 120).errors();
  EXPECT_LT(share_of(true_row.images[0], not_felt_colour()), 0.001);  // a pixel on the very corner
  EXPECT_LE(true_row.scale_mm, 2);
  box.object.parts[0].X_OQ.p.x() += 1;
  const Surface bad(box);
  EXPECT_GT(share_of(Pictures(bad, box.object, 300, 120).errors().images[0], not_felt_colour()), 0.9);
}

TEST(Pictures, TheMapOfABoxUnderItsSuperquadricIsFlatInTheMiddleOfItsFaces) {
  const FittedObject& box = fitted_box();
  const MapPicture map = draw_map(box.object, 0, 16);
  EXPECT_EQ(map.image.width, 64);
  EXPECT_EQ(map.image.height, 48);
  EXPECT_EQ(map.covered_share, 0);
  EXPECT_LT(map.no_hit_share, 0.05);
  // The superquadric bounds the box: at most a tenth of it lies between them.
  EXPECT_LT(map.deepest_mm, 20);
  EXPECT_EQ(map.image.rgba[4 * 20 + 3], 0) << "beside +z the net is empty";
  EXPECT_EQ(map.image.rgba[4 * (20 * 64 + 20) + 3], 255);
}

TEST(Palette, ScalesDarkenAllTheWayAndNeighboursDiffer) {
  for (const Scale scale : {Scale::error, Scale::depth}) {
    double last = 2;
    for (int i = 0; i <= 50; ++i) {
      const Colour c = colour_at(scale, i / 50.0);
      const double luminance = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
      EXPECT_LT(luminance, last);
      last = luminance;
    }
    EXPECT_NE(css_gradient(scale).find(css(colour_at(scale, 1))), std::string::npos);
  }
  const auto colours = part_colours(fitted(test::barrel(12, 0.1, 0.12, 0.2)).object);
  for (std::size_t i = 0; i < colours.size(); ++i)
    EXPECT_NE(css(colours[i]), css(colours[(i + 1) % colours.size()])) << i;
}

TEST(Image, Base64AsInItsStandard) {
  // RFC 4648, section 10.
  const auto encoded = [](std::string_view text) { return base64(std::as_bytes(std::span(text))); };
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace mechane::fit
