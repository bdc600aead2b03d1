#include "server/collision/object_io.hpp"

#include <cstring>

#include <gtest/gtest.h>

#include "server/collision/samples.hpp"
#include "server/collision/superquadric_object.hpp"
#include "server/collision_build/object_builder.hpp"
#include "tests/support/shapes.hpp"

namespace mechane::collision {
namespace {

TEST(ObjectIo, ComesBackAsItWent) {
  const auto object = collision_build::build_object(test::crank(), {});
  ASSERT_TRUE(object);
  const std::vector<std::byte> bytes = write_object(*object);
  const auto read = read_object(bytes);
  ASSERT_TRUE(read) << read.error().to_string();
  // The same bytes again: nothing was lost that is written, and the queries read only what is written.
  EXPECT_EQ(write_object(*read), bytes);
  ASSERT_EQ(read->parts.size(), 3U);
  EXPECT_EQ(read->parts[2].name, "grip");
  EXPECT_EQ(sample_count(*read), sample_count(*object));
  const Vec3f p(0.001F, 0.002F, 0.003F);
  EXPECT_EQ(read->parts[1].map.evaluate(p).depth_m, object->parts[1].map.evaluate(p).depth_m);
}

TEST(ObjectIo, SaysWhatIsWrong) {
  geometry::Superquadric shape;
  shape.a = Vec3::Constant(0.01);
  const std::vector<std::byte> good = write_object(make_superquadric_object(shape, 0.005));
  EXPECT_NE(read_object({}).error().what.find("not a part file"), std::string::npos);
  std::vector<std::byte> version = good;
  version[8] = std::byte{99};
  EXPECT_NE(read_object(version).error().what.find("version 99"), std::string::npos);
  std::vector<std::byte> flipped = good;
  flipped[good.size() / 2] ^= std::byte{4};
  EXPECT_NE(read_object(flipped).error().what.find("checksum"), std::string::npos);
  std::vector<std::byte> count = good;  // four thousand million parts, sealed
  std::memset(count.data() + 12, 0xFF, 4);
  reseal(count);
  EXPECT_NE(read_object(count).error().what.find("cannot be"), std::string::npos);
  EXPECT_FALSE(read_object(count).error().remedy.empty());
}

}  // namespace
}  // namespace mechane::collision
