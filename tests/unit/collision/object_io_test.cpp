#include "server/collision/object_io.hpp"

#include <cstring>
#include <span>

#include <gtest/gtest.h>

#include "server/base/random.hpp"
#include "server/collision/samples.hpp"
#include "server/collision/superquadric_object.hpp"
#include "server/collision_build/object_builder.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/fields.hpp"
#include "tests/support/scratch_folder.hpp"
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

TEST(ObjectIo, AFieldComesBackAndOnlyItsFilesHaveTheNewVersion) {
  const auto version_of = [](const std::vector<std::byte>& bytes) {
    std::uint32_t version = 0;
    std::memcpy(&version, &bytes[8], sizeof version);
    return version;
  };
  Random random(6);
  for (int i = 0; i < 20; ++i) {
    const Object object = mechane::test::object_of(mechane::test::any_field(random));
    const std::vector<std::byte> bytes = write_object(object);
    EXPECT_EQ(version_of(bytes), kFieldFileVersion);
    const auto read = read_object(bytes);
    ASSERT_TRUE(read) << read.error().to_string();
    ASSERT_NE(read->parts[0].map.field(), nullptr);
    EXPECT_EQ(write_object(*read), bytes);
    EXPECT_EQ(read->parts[0].map.name(), object.parts[0].map.name());
    std::vector<std::byte> older = bytes;
    older[8] = std::byte{kFieldFileVersion - 1};
    reseal(older);
    EXPECT_TRUE(read_object(older)) << "its layout is the same";
  }
  geometry::Superquadric shape;
  shape.a = Vec3::Constant(0.01);
  EXPECT_EQ(version_of(write_object(make_superquadric_object(shape, 0.005))), kPartFileVersion);
}

TEST(ObjectIo, SaysWhatIsWrong) {
  using mechane::test::is_error;
  geometry::Superquadric shape;
  shape.a = Vec3::Constant(0.01);
  const std::vector<std::byte> good = write_object(make_superquadric_object(shape, 0.005));
  const auto error_of = [](std::span<const std::byte> bytes) {
    const auto read = read_object(bytes);
    return read ? Error{} : read.error();
  };
  EXPECT_THAT(error_of({}), is_error(ErrorCode::damaged, 0));
  std::vector<std::byte> version = good;
  version[8] = std::byte{99};
  EXPECT_THAT(error_of(version), is_error(ErrorCode::wrong_version, 0, {"version 99"}));
  std::vector<std::byte> flipped = good;
  flipped[good.size() / 2] ^= std::byte{4};
  EXPECT_THAT(error_of(flipped), is_error(ErrorCode::damaged, 0, {"checksum"}));
  std::vector<std::byte> count = good;  // four thousand million parts, sealed
  std::memset(count.data() + 12, 0xFF, 4);
  reseal(count);
  EXPECT_THAT(error_of(count), is_error(ErrorCode::damaged, 0, {"values"}));
}

TEST(ObjectIo, AMissingFileIsNotFoundAndADamagedOneIsNamed) {
  using mechane::test::is_error;
  const mechane::test::ScratchFolder folder;
  EXPECT_THAT(load_object(folder.path() / "lid.part").error(), is_error(ErrorCode::not_found, 0, {"lid.part"}));
  EXPECT_THAT(load_object(folder.write("lid.part", "no part")).error(), is_error(ErrorCode::damaged, 0, {"lid.part"}));
}

}  // namespace
}  // namespace mechane::collision
