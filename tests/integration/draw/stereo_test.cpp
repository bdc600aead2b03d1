#include <cmath>

#include "tests/integration/draw/drawn_picture.hpp"
#include "tests/integration/draw/lamp.hpp"

namespace mechane::draw {
namespace {

/// A scene that looks different to each eye everywhere: near and far things, a sky, words and a close-up.
struct Parted {
  picture::SceneAssets assets;
  picture::RenderScene scene;

  Parted() {
    assets.meshes.push_back(picture::box_mesh(Vec3(0.15, 0.15, 0.15)));
    for (const Vec3f& colour : {Vec3f(0.7F, 0.1F, 0.1F), Vec3f(0.1F, 0.6F, 0.2F), Vec3f(0.7F, 0.7F, 0.7F)}) {
      picture::MaterialData material;
      material.base_colour = Eigen::Vector4f(colour.x(), colour.y(), colour.z(), 1);
      assets.materials.push_back(material);
    }
    for (std::uint32_t i = 0; i < 3; ++i) {
      picture::Instance box;
      box.material = i;
      box.X_WM.translation() = Vec3f(-0.5F + 0.5F * static_cast<float>(i), 0.3F, -1.0F + static_cast<float>(i));
      scene.instances.push_back(box);
    }
    scene.shadow_box_W = Eigen::AlignedBox3f(Vec3f(-2, 0, -2), Vec3f(2, 1, 2));
    scene.camera.p_WC = Vec3(0, 0.6, 2.6);
    scene.camera.p_WT = Vec3(0, 0.3, 0);
    scene.camera.eye_distance_m = 0.12;
    scene.ground_height_m = 0.0F;
    scene.overlay.title = "The screw";
    scene.inset = picture::Inset{scene.camera, "Near"};
  }
};

class StereoPicture : public DrawnPicture {
 protected:
  picture::ImageData one(const Parted& parted, picture::Stereo stereo, picture::PixelSize size) {
    renderer_->upload(parted.assets);
    const Expected<void> drawn = renderer_->draw(parted.scene, stereo, size);
    EXPECT_TRUE(drawn.has_value()) << drawn.error().to_string();
    picture::ImageData picture = renderer_->read_picture();
    keep(picture);
    return picture;
  }
  void make_renderer(const RendererSettings& settings) {
    auto renderer = Renderer::create(settings);
    ASSERT_TRUE(renderer.has_value());
    renderer_ = std::move(*renderer);
  }
};

/// How many bytes of colour differ between a part of the whole and an eye's own picture.
std::size_t differing(const picture::ImageData& whole, std::uint32_t x0, std::uint32_t y0,
                      const picture::ImageData& eye) {
  std::size_t out = 0;
  for (std::uint32_t y = 0; y < eye.height; ++y) {
    for (std::uint32_t i = 0; i < 4 * eye.width; ++i) {
      out +=
          whole.rgba[4 * (std::size_t{y0 + y} * whole.width + x0) + i] != eye.rgba[4 * std::size_t{y} * eye.width + i]
              ? 1
              : 0;
    }
  }
  return out;
}

TEST_F(StereoPicture, halves_are_each_eyes_own_picture) {
  const Parted parted;
  const picture::PixelSize wide{kSize.width / 2, kSize.height};
  const picture::ImageData left = one(parted, picture::Stereo::left_eye, wide);
  const picture::ImageData right = one(parted, picture::Stereo::right_eye, wide);
  EXPECT_GT(differing(left, 0, 0, right), left.rgba.size() / 20) << "else a swap would pass";
  const picture::ImageData both = one(parted, picture::Stereo::side_by_side, kSize);
  EXPECT_EQ(differing(both, 0, 0, left), 0U);
  EXPECT_EQ(differing(both, wide.width, 0, right), 0U);

  const picture::PixelSize flat{kSize.width, kSize.height / 2};
  const picture::ImageData upper = one(parted, picture::Stereo::left_eye, flat);
  const picture::ImageData lower = one(parted, picture::Stereo::right_eye, flat);
  const picture::ImageData stacked = one(parted, picture::Stereo::top_bottom, kSize);
  EXPECT_EQ(differing(stacked, 0, 0, upper), 0U);
  EXPECT_EQ(differing(stacked, 0, flat.height, lower), 0U);
}

/// A 3D television stretches each half: a point of an eye's full picture lies at half its x, or y, in the squeezed one.
TEST_F(StereoPicture, squeezed_halves_are_each_eyes_full_picture_at_half_its_width_or_height) {
  const Parted parted;
  for (const picture::Stereo mode : {picture::Stereo::side_by_side_squeezed, picture::Stereo::top_bottom_squeezed}) {
    const bool beside = mode == picture::Stereo::side_by_side_squeezed;
    const picture::ImageData both = one(parted, mode, kSize);
    for (const picture::Stereo eye : {picture::Stereo::left_eye, picture::Stereo::right_eye}) {
      const picture::ImageData full = one(parted, eye, kSize);
      const std::uint32_t x0 = beside && eye == picture::Stereo::right_eye ? kSize.width / 2 : 0;
      const std::uint32_t y0 = !beside && eye == picture::Stereo::right_eye ? kSize.height / 2 : 0;
      const std::uint32_t across = beside ? 2 : 1, down = beside ? 1 : 2;
      double off = 0;
      for (std::uint32_t y = 0; y < kSize.height / down; ++y) {
        for (std::uint32_t x = 0; x < kSize.width / across; ++x) {
          for (std::size_t c = 0; c < 3; ++c) {
            const auto at = [c](const picture::ImageData& image, std::uint32_t i, std::uint32_t j) {
              return static_cast<double>(image.rgba[4 * (std::size_t{j} * image.width + i) + c]);
            };
            const double stretched =
                (at(full, across * x, down * y) + at(full, across * x + across - 1, down * y + down - 1)) / 2;
            off += std::abs(at(both, x0 + x, y0 + y) - stretched);
          }
        }
      }
      off /= 3.0 * kSize.width * kSize.height / 2;
      EXPECT_LT(off, 2.5) << picture::stereo_name(mode) << ", " << picture::stereo_name(eye);
    }
  }
}

TEST_F(StereoPicture, rows_are_the_screens_and_not_the_windows) {
  const Parted parted;
  const picture::ImageData even = one(parted, picture::Stereo::row_interleaved, kSize);
  renderer_->begin_at_row(101);
  const picture::ImageData odd = one(parted, picture::Stereo::row_interleaved, kSize);
  RendererSettings settings;
  settings.shadow_map_size = 1024;
  settings.right_eye_first = true;
  make_renderer(settings);
  EXPECT_EQ(one(parted, picture::Stereo::row_interleaved, kSize).rgba, odd.rgba);
  EXPECT_NE(even.rgba, odd.rgba);
  renderer_->begin_at_row(-1);
  EXPECT_EQ(one(parted, picture::Stereo::row_interleaved, kSize).rgba, even.rgba)
      << "a window that hangs over the upper edge";
}

TEST_F(StereoPicture, rows_take_turns_and_a_setting_says_which_eye_begins) {
  const Parted parted;
  const picture::ImageData left = one(parted, picture::Stereo::left_eye, kSize);
  const picture::ImageData right = one(parted, picture::Stereo::right_eye, kSize);
  for (const bool right_first : {false, true}) {
    RendererSettings settings;
    settings.shadow_map_size = 1024;
    settings.right_eye_first = right_first;
    make_renderer(settings);
    const picture::ImageData rows = one(parted, picture::Stereo::row_interleaved, kSize);
    const std::size_t row = std::size_t{4} * kSize.width;
    for (std::uint32_t y = 0; y < kSize.height; ++y) {
      const picture::ImageData& eye = (y % 2 == 0) == right_first ? right : left;
      ASSERT_TRUE(
          std::equal(rows.rgba.begin() + row * y, rows.rgba.begin() + row * (y + 1), eye.rgba.begin() + row * y))
          << "row " << y;
    }
  }
}

double to_linear(double c) {
  c /= 255;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double to_srgb(double c) {
  c = std::clamp(c, 0.0, 1.0);
  return 255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055);
}

TEST_F(StereoPicture, an_anaglyph_is_dubois_mixture_of_both_eyes) {
  const Parted parted;
  const picture::ImageData left = one(parted, picture::Stereo::left_eye, kSize);
  const picture::ImageData right = one(parted, picture::Stereo::right_eye, kSize);
  const picture::ImageData mixed = one(parted, picture::Stereo::anaglyph, kSize);
  Mat3 L;
  L << 0.4561, 0.500484, 0.176381, -0.0400822, -0.0378246, -0.0157589, -0.0152161, -0.0205971, -0.00546856;
  Mat3 R;
  R << -0.0434706, -0.0879388, -0.00155529, 0.378476, 0.73364, -0.0184503, -0.0721527, -0.112961, 1.2264;
  double worst = 0;
  for (std::size_t i = 0; i < mixed.rgba.size(); i += 4) {
    Vec3 l, r;
    for (std::size_t c = 0; c < 3; ++c) {
      l(static_cast<Eigen::Index>(c)) = to_linear(left.rgba[i + c]);
      r(static_cast<Eigen::Index>(c)) = to_linear(right.rgba[i + c]);
    }
    const Vec3 out = L * l + R * r;
    for (std::size_t c = 0; c < 3; ++c)
      worst = std::max(worst, std::abs(mixed.rgba[i + c] - to_srgb(out(static_cast<Eigen::Index>(c)))));
  }
  EXPECT_LT(worst, 1.6);
}

TEST_F(StereoPicture, a_quad_buffer_gets_a_full_picture_for_each_eye) {
  const Parted parted;
  const picture::ImageData left = one(parted, picture::Stereo::left_eye, kSize);
  const picture::ImageData right = one(parted, picture::Stereo::right_eye, kSize);
  (void)one(parted, picture::Stereo::quad_buffer, kSize);
  EXPECT_EQ(renderer_->read_picture(picture::Eye::left).rgba, left.rgba);
  EXPECT_EQ(renderer_->read_picture(picture::Eye::right).rgba, right.rgba);
}

TEST_F(StereoPicture, a_lamp_is_where_geometry_says_in_every_mode) {
  constexpr std::uint32_t kHalfHeight = kSize.height / 2;
  for (const Vec3& p : {Vec3(0.05, 0.10, -0.8), Vec3(-0.15, -0.20, -3.0), Vec3(0.10, 0.05, -1.5)}) {
    const Lamp lamp(p);
    const double fov = lamp.scene.camera.field_of_view_rad;
    const auto predicted = [&](picture::Eye eye, std::uint32_t height) {
      return seen_at(p, eye == picture::Eye::left ? -0.05 : 0.05, 1.5, fov, kSize.width, height);
    };
    renderer_->forget_assets();
    const picture::ImageData stacked = draw(lamp.assets, lamp.scene, picture::Stereo::top_bottom);
    EXPECT_LT(
        (blob(stacked, {0, 0, kSize.width, kHalfHeight}).middle - predicted(picture::Eye::left, kHalfHeight)).norm(),
        1);
    EXPECT_LT(
        (blob(stacked, {0, kHalfHeight, kSize.width, kHalfHeight}).middle - predicted(picture::Eye::right, kHalfHeight))
            .norm(),
        1);
    const picture::ImageData rows = draw(lamp.assets, lamp.scene, picture::Stereo::row_interleaved);
    EXPECT_LT(
        (blob(rows, {0, 0, kSize.width, kSize.height}, 2).middle - predicted(picture::Eye::left, kSize.height)).norm(),
        1.2);
    EXPECT_LT((blob(rows, {0, 1, kSize.width, kSize.height - 1}, 2).middle + Eigen::Vector2d(0, 1) -
               predicted(picture::Eye::right, kSize.height))
                  .norm(),
              1.2);
    // Red is the left eye's; blue the right eye's.
    const picture::ImageData mixed = draw(lamp.assets, lamp.scene, picture::Stereo::anaglyph);
    const PixelRectangle all{0, 0, kSize.width, kSize.height};
    EXPECT_LT((blob(mixed, all, 1, 0).middle - predicted(picture::Eye::left, kSize.height)).norm(), 1);
    EXPECT_LT((blob(mixed, all, 1, 2).middle - predicted(picture::Eye::right, kSize.height)).norm(), 1);
    (void)draw(lamp.assets, lamp.scene, picture::Stereo::quad_buffer);
    for (const picture::Eye eye : {picture::Eye::left, picture::Eye::right})
      EXPECT_LT((blob(renderer_->read_picture(eye), all).middle - predicted(eye, kSize.height)).norm(), 1);
  }
}

TEST_F(StereoPicture, before_a_known_screen_parallax_is_what_eyes_would_see_through_a_window) {
  // A screen 1.2 m wide, seen from 2 m, eyes 64 mm apart: a lamp as far behind the screen as the eyes are before it has half their distance
  // of parallax, 32 mm of the screen's 1.2 m.
  const picture::ScreenSetup setup{1.2, 2.0, 0.064};
  Lamp lamp(Vec3(0, 0, -1.5));
  const double aspect = static_cast<double>(kSize.width) / kSize.height;
  const double world_m = 2 * 1.5 * std::tan(lamp.scene.camera.field_of_view_rad / 2) * aspect;
  const double scale = world_m / setup.width_m;
  lamp.scene.camera = picture::for_screen(lamp.scene.camera, setup, nullptr, aspect);
  lamp.scene.instances[0].X_WM.translation() = Vec3f(0, 0, -1.5F - static_cast<float>(2.0 * scale));
  const PixelRectangle all{0, 0, kSize.width, kSize.height};
  const double left = blob(draw(lamp.assets, lamp.scene, picture::Stereo::left_eye), all).middle.x();
  const double right = blob(draw(lamp.assets, lamp.scene, picture::Stereo::right_eye), all).middle.x();
  EXPECT_NEAR(right - left, 0.032 / 1.2 * kSize.width, 0.5);
  // In the plane of the screen nothing has moved.
  lamp.scene.instances[0].X_WM.translation() = Vec3f(0.2F, 0.1F, -1.5F);
  const Eigen::Vector2d at = blob(draw(lamp.assets, lamp.scene), all).middle;
  EXPECT_LT((at - seen_at(Vec3(0.2, 0.1, -1.5), 0, 1.5, picture::Camera{}.field_of_view_rad, kSize.width, kSize.height))
                .norm(),
            1);
}

TEST_F(StereoPicture, a_button_is_pressed_where_it_is_seen_in_every_kind) {
  Lamp lamp(Vec3(0, 0, -1.5));
  for (const auto& [name, kind] : picture::stereo_names()) {
    lamp.scene.overlay.corner.clear();
    const picture::ImageData bare = draw(lamp.assets, lamp.scene, kind);
    const picture::OverlayAction home{picture::OverlayAction::Kind::home, ""};
    lamp.scene.overlay.corner = {{home, "Home"}};
    const picture::ImageData with = draw(lamp.assets, lamp.scene, kind);
    const OverlayLayout& layout = renderer_->overlay();
    EXPECT_EQ(layout.size, picture::seen_size(kind, kSize));
    std::size_t seen = 0;
    for (std::uint32_t y = 0; y < kSize.height; y += 3) {
      for (std::uint32_t x = 0; x < kSize.width; x += 3) {
        if (std::abs(brightness(with, x, y) - brightness(bare, x, y)) < 20) continue;
        ++seen;
        const picture::EyePlace at = picture::eye_at(kind, kSize, {x + 0.5, y + 0.5});
        // A pixel of a squeezed picture is two of what is seen.
        bool pressed = false;
        for (const double off : {-2.0, 0.0, 2.0}) {
          pressed = pressed || action_at(layout, (1 + at.x) / 2 * layout.size.width + off,
                                         (1 - at.y) / 2 * layout.size.height + off) == home;
        }
        EXPECT_TRUE(pressed) << picture::stereo_name(kind) << " " << x << " " << y;
      }
    }
    EXPECT_GT(seen, 30U) << picture::stereo_name(kind);
  }
}

TEST_F(StereoPicture, a_head_that_moves_sees_what_is_behind_the_screen_move_with_it) {
  const picture::ScreenSetup setup{1.2, 2.0, 0.064};
  const double aspect = static_cast<double>(kSize.width) / kSize.height;
  Lamp lamp(Vec3(0, 0, -1.5));
  const picture::Camera from = lamp.scene.camera;
  const double scale = 2 * 1.5 * std::tan(from.field_of_view_rad / 2) * aspect / setup.width_m;
  lamp.scene.instances[0].X_WM.translation() = Vec3f(0, 0, -1.5F - static_cast<float>(2.0 * scale));
  const PixelRectangle all{0, 0, kSize.width, kSize.height};
  // As far behind the screen as the head is before it: by similar triangles it moves half as far as the head, over the screen.
  const picture::HeadPlace head{Vec3(0.30, 0.10, 2.0), Vec3::UnitX()};
  lamp.scene.camera = picture::for_screen(from, setup, &head, aspect);
  const Eigen::Vector2d middle(0.5 * kSize.width, 0.5 * kSize.height);
  const Eigen::Vector2d moved = blob(draw(lamp.assets, lamp.scene), all).middle - middle;
  EXPECT_NEAR(moved.x(), 0.15 / 1.2 * kSize.width, 0.5);
  EXPECT_NEAR(moved.y(), -0.05 / 1.2 * kSize.width, 0.5);
  // Nearer to the screen by half, it moves two thirds of the head's way: it is twice as far behind as the head is before.
  const picture::HeadPlace nearer{Vec3(0.30, 0, 1.0), Vec3::UnitX()};
  lamp.scene.camera = picture::for_screen(from, setup, &nearer, aspect);
  EXPECT_NEAR(blob(draw(lamp.assets, lamp.scene), all).middle.x() - middle.x(), 0.20 / 1.2 * kSize.width, 0.5);
  // With the head on one side, eyes one above the other see it apart from each other along that line.
  const picture::HeadPlace tilted{Vec3(0, 0, 2.0), Vec3(0.6, 0.8, 0)};
  lamp.scene.camera = picture::for_screen(from, setup, &tilted, aspect);
  const Eigen::Vector2d apart = blob(draw(lamp.assets, lamp.scene, picture::Stereo::right_eye), all).middle -
                                blob(draw(lamp.assets, lamp.scene, picture::Stereo::left_eye), all).middle;
  EXPECT_NEAR(apart.x(), 0.6 * 0.032 / 1.2 * kSize.width, 0.5);
  EXPECT_NEAR(apart.y(), -0.8 * 0.032 / 1.2 * kSize.width, 0.5);
}

}  // namespace
}  // namespace mechane::draw
