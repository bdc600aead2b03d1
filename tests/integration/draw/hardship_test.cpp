// What a display may be asked to draw, and survives.
#include <algorithm>

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include "server/log/log.hpp"
#include "tests/integration/draw/drawn_picture.hpp"
#include "tests/support/error_like.hpp"

namespace mechane::draw {
namespace {

/// White boxes in rows before the eye, each of some pixels.
picture::RenderScene many_boxes(int columns, int rows) {
  picture::RenderScene scene;
  scene.camera.p_WC = Vec3(0, 0, 3);
  scene.camera.p_WT = Vec3(0, 0, 0);
  scene.shadow_box_W = Eigen::AlignedBox3f(Vec3f(-2, -1, -0.2F), Vec3f(2, 1, 0.2F));
  for (int i = 0; i < columns * rows; ++i) {
    const auto at = [](int k, int of) { return 2 * (static_cast<float>(k) + 0.5F) / static_cast<float>(of) - 1; };
    add_instance(scene, 0, 0, Vec3f(1.6F * at(i % columns, columns), 0.9F * at(i / columns, rows), 0));
  }
  return scene;
}

picture::SceneAssets one_box(double half_m) {
  picture::SceneAssets assets;
  assets.meshes.push_back(picture::box_mesh(Vec3::Constant(half_m)));
  picture::MaterialData glowing;
  glowing.emissive = Vec3f(1, 1, 1);
  assets.materials.push_back(glowing);
  return assets;
}

TEST_F(DrawnPicture, a_size_that_the_driver_does_not_have_is_refused_and_the_next_is_drawn) {
  const picture::SceneAssets assets = one_box(0.5);
  const picture::RenderScene scene = many_boxes(1, 1);
  renderer_->upload(assets);
  for (const picture::Stereo stereo : {picture::Stereo::mono, picture::Stereo::anaglyph}) {
    const Expected<void> drawn = renderer_->draw(scene, stereo, {1'000'000, 16});
    ASSERT_FALSE(drawn.has_value());
    EXPECT_THAT(drawn.error(), test::is_error(ErrorCode::too_large, 0, {"smaller --size"}));
    const picture::ImageData picture = draw(assets, scene, stereo);
    EXPECT_GT(mean(picture, kSize.width / 2.0, kSize.height / 2.0, 3), 200);
  }
}

TEST_F(DrawnPicture, ten_thousand_objects_are_all_drawn) {
  const picture::ImageData picture = draw(one_box(0.008), many_boxes(125, 80));
  // Each box is an island of light of more than two pixels: its middle pixel is all light.
  const picture::RenderScene scene = many_boxes(125, 80);
  int lit = 0;
  for (const picture::Instance& box : scene.instances) {
    const Eigen::Vector2d at = pixel_of(scene, box.X_WM.translation().cast<double>());
    lit += brightness(picture, at.x(), at.y()) > 200 ? 1 : 0;
  }
  EXPECT_EQ(lit, 10'000);
}

/// While there is one, the driver says of every mesh and image of over 100 kB that it has no memory.
class SmallCard {
 public:
  SmallCard() {
    (void)glGetError();  // epoxy looks a function up at its first call, and would take the planted one's place
    real_buffer_data = epoxy_glBufferData;
    real_tex_image = epoxy_glTexImage2D;
    real_get_error = epoxy_glGetError;
    epoxy_glBufferData = [](GLenum target, GLsizeiptr size, const void* data, GLenum usage) {
      if (is_full(size)) return;
      real_buffer_data(target, size, data, usage);
    };
    epoxy_glTexImage2D = [](GLenum target, GLint level, GLint kept, GLsizei width, GLsizei height, GLint border,
                            GLenum format, GLenum type, const void* data) {
      if (data != nullptr && is_full(GLsizeiptr{4} * width * height)) return;  // what is drawn into has none
      real_tex_image(target, level, kept, width, height, border, format, type, data);
    };
    epoxy_glGetError = [] {
      return std::exchange(full, false) ? static_cast<GLenum>(GL_OUT_OF_MEMORY) : real_get_error();
    };
  }
  SmallCard(const SmallCard&) = delete;
  SmallCard& operator=(const SmallCard&) = delete;
  ~SmallCard() {
    epoxy_glBufferData = real_buffer_data;
    epoxy_glTexImage2D = real_tex_image;
    epoxy_glGetError = real_get_error;
  }

 private:
  static bool is_full(GLsizeiptr bytes) {
    full = full || bytes > 100'000;
    return bytes > 100'000;
  }
  static inline PFNGLBUFFERDATAPROC real_buffer_data = nullptr;
  static inline PFNGLTEXIMAGE2DPROC real_tex_image = nullptr;
  static inline PFNGLGETERRORPROC real_get_error = nullptr;
  static inline bool full = false;
};

/// What the log told last.
log::Trouble trouble() {
  static const bool kCounts = [] {
    log::start("gl_display", log::Level::warning);
    return true;
  }();
  return kCounts ? log::trouble() : log::Trouble{};
}

/// A ball of many triangles on the left, a box on the right, in the dark.
struct BallAndBox {
  picture::SceneAssets assets = one_box(0.3);
  picture::RenderScene scene = many_boxes(0, 0);

  BallAndBox() {
    assets.meshes.push_back(picture::sphere_mesh(0.8, 200, 300));
    assets.meshes.back().name = "huge.glb#BALL";
    scene.sky = false;
    scene.sun.irradiance = Vec3f::Zero();
    add_instance(scene, 1, 0, Vec3f(-1, 0, 0));
    add_instance(scene, 0, 0, Vec3f(1, 0, 0));
  }
};

TEST_F(DrawnPicture, a_mesh_that_the_card_has_no_room_for_is_a_box_and_said_once) {
  const BallAndBox huge;
  const auto lit = [&](const picture::ImageData& picture, double x) {
    const Eigen::Vector2d at = pixel_of(huge.scene, Vec3(x, 0, 0));
    return mean(picture, at.x(), at.y(), 1) > 200;
  };
  {
    const SmallCard card;
    const std::uint64_t before = trouble().count;
    (void)draw(huge.assets, huge.scene);
    const picture::ImageData picture = draw(huge.assets, huge.scene);
    EXPECT_TRUE(lit(picture, 1)) << "it goes on with what there is room for";
    EXPECT_TRUE(lit(picture, -1));
    EXPECT_FALSE(lit(picture, -0.6));
    EXPECT_THAT(renderer_->refused(), testing::ElementsAre("huge.glb#BALL"));
    EXPECT_EQ(trouble().count, before + 1);
    EXPECT_THAT(trouble().last, testing::AllOf(testing::HasSubstr("huge.glb#BALL"), testing::HasSubstr("no room"),
                                               testing::HasSubstr("simplify"), testing::HasSubstr("plain box")));
  }
  renderer_->forget_assets();
  EXPECT_TRUE(lit(draw(huge.assets, huge.scene), -0.6));
  EXPECT_TRUE(renderer_->refused().empty());
}

TEST_F(DrawnPicture, an_image_that_the_card_does_not_take_is_left_out) {
  BallAndBox dark;
  dark.assets.meshes[1] = picture::sphere_mesh(0.8, 12, 16);
  picture::MaterialData& material = dark.assets.materials[0];
  material.emissive_image = 0;
  const auto brightness_with = [&](picture::PixelSize size) {
    dark.assets.images = {
        {size.width, size.height, std::vector<std::uint8_t>(std::size_t{4} * size.width * size.height), true, "soot"}};
    renderer_->forget_assets();
    const Eigen::Vector2d at = pixel_of(dark.scene, Vec3(-1, 0, 0));
    return mean(draw(dark.assets, dark.scene), at.x(), at.y(), 1);
  };
  const std::uint64_t before = trouble().count;
  EXPECT_LT(brightness_with({256, 256}), 100);
  EXPECT_TRUE(renderer_->refused().empty());
  EXPECT_EQ(trouble().count, before);
  EXPECT_GT(brightness_with({1'000'000, 1}), 200) << "wider than the driver has them";
  EXPECT_THAT(renderer_->refused(), testing::ElementsAre("soot"));
  EXPECT_THAT(trouble().last, testing::AllOf(testing::HasSubstr("1000000 x 1"), testing::HasSubstr("smaller")));
  const SmallCard card;
  EXPECT_GT(brightness_with({256, 256}), 200);
  EXPECT_THAT(renderer_->refused(), testing::ElementsAre("soot"));
  EXPECT_THAT(trouble().last, testing::HasSubstr("no room for an image of 256 x 256"));
  EXPECT_EQ(trouble().count, before + 2);
}

}  // namespace
}  // namespace mechane::draw
