// The nine places at four moments of a visit, drawn from recorded scenes and held against the pictures that a person has accepted; and faults
// that must not go unseen. deploy/film --scenes records the scenes anew; to accept what is drawn now, run the whole program once with
// MECHANE_ACCEPT_GOLDEN=1, and look at the sheets of which it tells.
#include <filesystem>
#include <functional>
#include <iostream>

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "client-sdk/draw/gl_context.hpp"
#include "client-sdk/draw/renderer.hpp"
#include "tests/integration/pictures/reference_picture.hpp"
#include "tests/support/picture_likeness.hpp"
#include "tests/support/recorded_place.hpp"
#include "tests/support/source_folder.hpp"

namespace mechane::display {
namespace {

constexpr picture::PixelSize kPicture{320, 180};
constexpr picture::PixelSize kBothEyes{640, 180};
constexpr std::size_t kMoments = 4;  ///< start, middle, a telling one, end
/// So alike two drawings of one scene are, whoever's processor drew them. What a person sees at once is far below.
constexpr double kLeastMean = 0.985;
constexpr double kLeastWorst = 0.85;

const std::filesystem::path kRoot = mechane::test::source_folder();

bool accepts() {
  return std::getenv("MECHANE_ACCEPT_GOLDEN") != nullptr;
}

bool alike(const test::Likeness& likeness) {
  return likeness.mean >= kLeastMean && likeness.worst >= kLeastWorst;
}

std::filesystem::path reference_file(const std::string& name) {
  return kRoot / "tests/golden/pictures" / (name + ".jpg");
}

test::Likeness likeness_to(const picture::ImageData& reference, const picture::ImageData& drawn) {
  return test::likeness(reference, test::as_kept(drawn));
}

/// A place whose words are not drawn: they have tests of their own, and would hide the machine in so small a picture.
class Place {
 public:
  explicit Place(const std::string& name) : place_(name) {}
  picture::RenderScene scene(std::size_t moment) {
    picture::RenderScene out =
        place_.scene(static_cast<int>(moment), static_cast<double>(kPicture.width) / kPicture.height);
    out.overlay = {};
    return out;
  }
  [[nodiscard]] const picture::SceneAssets& assets() const { return place_.assets(); }

 private:
  mechane::test::RecordedPlace place_;
};

/// What was drawn, and what had been accepted before, one place a row: for eyes.
class Sheets : public testing::Environment {
 public:
  void add(const std::optional<picture::ImageData>& before, const picture::ImageData& now) {
    before_.push_back(
        before.value_or(picture::ImageData{now.width, now.height, std::vector<std::uint8_t>(now.rgba.size())}));
    now_.push_back(now);
  }
  void TearDown() override {
    if (!accepts() || now_.empty()) return;
    const std::filesystem::path folder = kRoot / "out/pictures";
    std::filesystem::create_directories(folder);
    for (const auto& [name, pictures] : {std::pair{"before", &before_}, std::pair{"accepted", &now_}}) {
      const std::string file = (folder / (std::string(name) + ".png")).string();
      ASSERT_TRUE(picture::write_png(sheet(*pictures), file));
      std::cout << "look at: " << file << "\n";
    }
  }

 private:
  /// Four pictures a row.
  static picture::ImageData sheet(const std::vector<picture::ImageData>& pictures) {
    const auto rows = static_cast<std::uint32_t>((pictures.size() + kMoments - 1) / kMoments);
    picture::ImageData out{kMoments * kPicture.width, rows * kPicture.height, {}};
    out.rgba.resize(std::size_t{4} * out.width * out.height);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      for (std::size_t row = 0; row < kPicture.height; ++row) {
        const auto* from = pictures[i].rgba.data() + 4 * row * kPicture.width;
        std::copy_n(
            from, 4 * kPicture.width,
            out.rgba.data() + 4 * ((i / kMoments * kPicture.height + row) * out.width + i % kMoments * kPicture.width));
      }
    }
    return out;
  }
  std::vector<picture::ImageData> before_;
  std::vector<picture::ImageData> now_;
};

Sheets& sheets() {
  static auto* const kSheets = static_cast<Sheets*>(testing::AddGlobalTestEnvironment(new Sheets));
  return *kSheets;
}
[[maybe_unused]] const Sheets& kSheetsAreMade = sheets();

class PlacePictures : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    auto context = draw::make_offscreen_context(kPicture);
    ASSERT_TRUE(context.has_value()) << context.error().to_string();
    context_ = std::move(*context);
    renderer_ = make_renderer();
  }
  // The renderer's objects go before their context.
  void TearDown() override {
    renderer_.reset();
    context_.reset();
  }

  static std::unique_ptr<draw::Renderer> make_renderer(draw::Quality quality = draw::Quality::high) {
    draw::RendererSettings settings;
    settings.quality = quality;
    auto renderer = draw::Renderer::create(settings);
    EXPECT_TRUE(renderer.has_value()) << renderer.error().to_string();
    return renderer ? std::move(*renderer) : nullptr;
  }

  picture::ImageData draw(const picture::SceneAssets& assets, const picture::RenderScene& scene,
                          picture::Stereo stereo = picture::Stereo::mono, picture::PixelSize size = kPicture) {
    renderer_->upload(assets);
    const Expected<void> drawn = renderer_->draw(scene, stereo, size);
    EXPECT_TRUE(drawn.has_value()) << drawn.error().to_string();
    return renderer_->read_picture();
  }

  /// Held against what was accepted, or accepted.
  static void compare(const std::string& name, const picture::ImageData& drawn) {
    const std::optional<picture::ImageData> reference = test::read_reference(reference_file(name));
    if (accepts()) {
      if (drawn.width == kPicture.width) sheets().add(reference, drawn);
      ASSERT_TRUE(test::write_reference(drawn, reference_file(name)));
      return;
    }
    ASSERT_TRUE(reference) << "there is no picture " << reference_file(name);
    const test::Likeness likeness = likeness_to(*reference, drawn);
    if (std::getenv("MECHANE_TEST_LIKENESS") != nullptr)
      std::cout << name << ": " << likeness.mean << ", worst " << likeness.worst << "\n";
    if (alike(likeness)) return;
    const std::filesystem::path folder = kRoot / "out/pictures";
    std::filesystem::create_directories(folder);
    const std::string file = (folder / (name + ".png")).string();
    EXPECT_TRUE(picture::write_png(drawn, file));
    ADD_FAILURE() << name << " looks other than accepted: likeness " << likeness.mean << ", in places "
                  << likeness.worst << "; compare " << file << " with " << reference_file(name)
                  << "; if it was meant, run this program once, whole, with MECHANE_ACCEPT_GOLDEN=1";
  }

  std::unique_ptr<draw::GlContext> context_;
  std::unique_ptr<draw::Renderer> renderer_;
};

TEST_P(PlacePictures, look_as_they_were_accepted) {
  Place place(GetParam());
  for (std::size_t moment = 0; moment < kMoments; ++moment) {
    const picture::RenderScene scene = place.scene(moment);
    compare(std::string(GetParam()) + "-" + std::to_string(moment + 1), draw(place.assets(), scene));
  }
}

const auto kPlaces = testing::Values("village", "archimedes-screw", "ktesibios-pump", "pulley-crane",
                                     "compound-pulley-crane", "catapult", "crossbow", "aiolos-sphere", "odometer");

std::string test_name_of(const testing::TestParamInfo<const char*>& place) {
  std::string name = place.param;
  std::ranges::replace(name, '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, PlacePictures, kPlaces, test_name_of);

/// A visit goes on from its third moment to its last, in front of a view that stays: hands, parts, water and shadows are
/// elsewhere then.
class KeptPictures : public PlacePictures {
 protected:
  void open(const std::string& name) {
    place_.emplace(name);
    first_ = place_->scene(2);
    last_ = place_->scene(3);
    last_.camera = first_.camera;
    last_.inset = first_.inset;
  }

  /// The last moment, in this quality.
  [[nodiscard]] picture::ImageData last_moment(draw::Quality quality) const {
    const std::unique_ptr<draw::Renderer> renderer = make_renderer(quality);
    renderer->upload(place_->assets());
    // Until what stands still is known and kept; then in motion.
    const auto turns = static_cast<int>(draw::LowRenderer::kStill + draw::LowRenderer::kSlices) + 2;
    for (int turn = 0; turn < turns; ++turn)
      EXPECT_TRUE(renderer->draw(first_, picture::Stereo::mono, kPicture));
    for (int turn = 0; turn < 2; ++turn)  // a close-up is drawn in one of them
      EXPECT_TRUE(renderer->draw(last_, picture::Stereo::mono, kPicture));
    if (quality == draw::Quality::cached) {
      EXPECT_GT(renderer->low()->times_kept(), 0U);
    }
    return renderer->read_picture();
  }

  /// The share of pixels that differ by more than a hundredth of the range.
  static double differing(const picture::ImageData& a, const picture::ImageData& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
      int most = 0;
      for (std::size_t channel = 0; channel < 3; ++channel)
        most = std::max(most, std::abs(int{a.rgba[i + channel]} - int{b.rgba[i + channel]}));
      count += most > 3 ? 1 : 0;
    }
    return static_cast<double>(count) / (static_cast<double>(a.rgba.size()) / 4);
  }
  static constexpr double kMostDiffering = 0.0005;

 private:
  std::optional<Place> place_;
  picture::RenderScene first_;
  picture::RenderScene last_;
};

TEST_P(KeptPictures, are_in_motion_as_if_all_had_been_drawn_anew) {
  open(GetParam());
  const picture::ImageData whole = last_moment(draw::Quality::low);
  const picture::ImageData kept = last_moment(draw::Quality::cached);
  const double share = differing(whole, kept);
  std::cout << GetParam() << ": " << 1e3 * share << " of a thousand pixels differ\n";
  if (const char* folder = std::getenv("MECHANE_TEST_PICTURES"); folder != nullptr) {
    EXPECT_TRUE(picture::write_png(whole, std::string(folder) + "/" + GetParam() + "-low.png"));
    EXPECT_TRUE(picture::write_png(kept, std::string(folder) + "/" + GetParam() + "-cached.png"));
  }
  EXPECT_LT(share, kMostDiffering);
}

INSTANTIATE_TEST_SUITE_P(All, KeptPictures, kPlaces, test_name_of);

PFNGLBLITFRAMEBUFFERPROC real_blit = nullptr;
PFNGLSCISSORPROC real_scissor = nullptr;
using KeptFaults = KeptPictures;

TEST_F(KeptFaults, a_depth_that_is_not_restored_is_seen) {
  open("odometer");
  const picture::ImageData whole = last_moment(draw::Quality::low);
  real_blit = epoxy_glBlitFramebuffer;
  epoxy_glBlitFramebuffer = [](GLint x0, GLint y0, GLint x1, GLint y1, GLint tx0, GLint ty0, GLint tx1, GLint ty1,
                               GLbitfield what, GLenum filter) {
    real_blit(x0, y0, x1, y1, tx0, ty0, tx1, ty1, what & ~static_cast<GLbitfield>(GL_DEPTH_BUFFER_BIT), filter);
  };
  const picture::ImageData faulty = last_moment(draw::Quality::cached);
  epoxy_glBlitFramebuffer = real_blit;
  EXPECT_GT(differing(whole, faulty), kMostDiffering);
}

TEST_F(KeptFaults, regions_that_are_too_small_are_seen) {
  open("odometer");
  const picture::ImageData whole = last_moment(draw::Quality::low);
  real_scissor = epoxy_glScissor;
  epoxy_glScissor = [](GLint x, GLint y, GLsizei width, GLsizei height) {
    const bool all = width == static_cast<GLsizei>(kPicture.width);
    real_scissor(x, y, all ? width : width / 2, height);
  };
  const picture::ImageData faulty = last_moment(draw::Quality::cached);
  epoxy_glScissor = real_scissor;
  EXPECT_GT(differing(whole, faulty), kMostDiffering);
}

/// Draws the telling moment of a place well, and with a fault; both against what was accepted.
class PlantedFault : public PlacePictures {
 protected:
  void expect_seen(const std::string& name,
                   const std::function<picture::ImageData(Place&, picture::RenderScene)>& draw_faulty) {
    if (accepts()) GTEST_SKIP() << "the pictures are being accepted";
    Place place(name);
    const picture::RenderScene scene = place.scene(2);
    const std::optional<picture::ImageData> reference = test::read_reference(reference_file(name + "-3"));
    ASSERT_TRUE(reference);
    ASSERT_TRUE(alike(likeness_to(*reference, draw(place.assets(), scene)))) << "without the fault it is as accepted";
    const test::Likeness faulty = likeness_to(*reference, draw_faulty(place, scene));
    EXPECT_FALSE(alike(faulty)) << faulty.mean << ", worst " << faulty.worst;
    std::cout << "with the fault: likeness " << faulty.mean << ", in places " << faulty.worst << "\n";
  }
};

PFNGLENABLEPROC real_enable = nullptr;

TEST_F(PlantedFault, a_missing_depth_buffer_is_seen) {
  expect_seen("odometer", [this](Place& place, const picture::RenderScene& scene) {
    // The renderer enables the test of depth in each pass; so the driver must not hear of it.
    real_enable = epoxy_glEnable;
    epoxy_glEnable = [](GLenum what) {
      if (what != GL_DEPTH_TEST) real_enable(what);
    };
    glDisable(GL_DEPTH_TEST);
    picture::ImageData picture = draw(place.assets(), scene);
    epoxy_glEnable = real_enable;
    return picture;
  });
}

TEST_F(PlantedFault, metal_that_mirrors_nothing_is_seen) {
  expect_seen("aiolos-sphere", [this](Place& place, const picture::RenderScene& scene) {
    picture::SceneAssets black = place.assets();
    std::size_t metals = 0;
    for (picture::MaterialData& material : black.materials) {
      if (material.metallic < 0.5F) continue;
      material.base_colour.head<3>().setZero();
      ++metals;
    }
    EXPECT_GT(metals, 0U);
    renderer_->forget_assets();
    return draw(black, scene);
  });
}

TEST_F(PlantedFault, the_loss_of_the_sky_s_light_is_seen) {
  expect_seen("ktesibios-pump", [this](Place& place, picture::RenderScene scene) {
    scene.sky = false;
    return draw(place.assets(), scene);
  });
}

TEST_F(PlantedFault, lost_shadows_are_seen) {
  expect_seen("pulley-crane", [this](Place& place, picture::RenderScene scene) {
    for (picture::Instance& instance : scene.instances)
      instance.casts_shadow = false;
    return draw(place.assets(), scene);
  });
}

TEST_F(PlantedFault, a_river_that_ends_in_the_land_is_seen) {
  expect_seen("archimedes-screw", [this](Place& place, picture::RenderScene scene) {
    EXPECT_EQ(std::erase_if(scene.waters, [](const picture::WaterInstance& water) { return water.width_m > 0; }), 2U);
    return draw(place.assets(), scene);
  });
}

TEST_F(PlantedFault, water_that_mirrors_nothing_is_seen) {
  expect_seen("village", [this](Place& place, picture::RenderScene scene) {
    // A little askew it is not a mirror any more; elsewhere nobody would see it.
    for (picture::WaterInstance& water : scene.waters)
      water.X_WM.prerotate(Eigen::AngleAxisf(0.002F, Vec3f::UnitX()));
    return draw(place.assets(), scene);
  });
}

/// The place's meshes in materials that lack an image. Earth keeps its own: without them it would be no earth.
picture::SceneAssets without(const picture::SceneAssets& assets,
                             std::optional<std::uint32_t> picture::MaterialData::*image) {
  picture::SceneAssets out = assets;
  std::size_t had = 0;
  for (picture::MaterialData& material : out.materials) {
    if (material.land || !(material.*image)) continue;
    (material.*image).reset();
    ++had;
  }
  EXPECT_GT(had, 0U);
  return out;
}

TEST_F(PlantedFault, the_loss_of_the_normal_images_is_seen) {
  expect_seen("village", [this](Place& place, const picture::RenderScene& scene) {
    renderer_->forget_assets();
    return draw(without(place.assets(), &picture::MaterialData::normal_image), scene);
  });
}

TEST_F(PlantedFault, the_loss_of_the_metallic_roughness_images_is_seen) {
  expect_seen("aiolos-sphere", [this](Place& place, const picture::RenderScene& scene) {
    renderer_->forget_assets();
    return draw(without(place.assets(), &picture::MaterialData::metallic_roughness_image), scene);
  });
}

TEST_F(PlantedFault, steps_at_edges_are_seen) {
  expect_seen("crossbow", [this](Place& place, const picture::RenderScene& scene) {
    draw::RendererSettings settings;
    settings.samples = 1;
    renderer_ = draw::Renderer::create(settings).value();
    return draw(place.assets(), scene);
  });
}

PFNGLSHADERSOURCEPROC real_shader_source = nullptr;

TEST_F(PlantedFault, air_without_haze_is_seen) {
  expect_seen("catapult", [this](Place& place, const picture::RenderScene& scene) {
    // No scene asks for it: so the driver is given other shaders.
    static const std::string kHaze = "mix(light, haze_colour(), ";
    static int found = 0;
    real_shader_source = epoxy_glShaderSource;
    epoxy_glShaderSource = [](GLuint shader, GLsizei, const GLchar* const* texts, const GLint*) {
      std::string text = *texts;
      if (const std::size_t at = text.find(kHaze); at != std::string::npos) {
        text.insert(at + kHaze.size(), "0.0 * ");
        ++found;
      }
      const char* other = text.c_str();
      real_shader_source(shader, 1, &other, nullptr);
    };
    renderer_ = draw::Renderer::create({}).value();
    epoxy_glShaderSource = real_shader_source;
    EXPECT_GT(found, 0);
    return draw(place.assets(), scene);
  });
}

TEST_F(PlantedFault, a_missing_close_up_is_seen) {
  expect_seen("pulley-crane", [this](Place& place, picture::RenderScene scene) {
    EXPECT_TRUE(scene.inset);
    scene.inset.reset();
    return draw(place.assets(), scene);
  });
}

/// The two halves of a picture side by side.
picture::ImageData halves_swapped(const picture::ImageData& picture) {
  picture::ImageData out = picture;
  const std::size_t half = picture.width / 2;
  for (std::size_t row = 0; row < picture.height; ++row) {
    for (std::size_t x = 0; x < picture.width; ++x) {
      const std::size_t from = row * picture.width + (x + half) % picture.width;
      std::copy_n(picture.rgba.data() + 4 * from, 4, out.rgba.data() + 4 * (row * picture.width + x));
    }
  }
  return out;
}

TEST_F(PlantedFault, swapped_eyes_are_seen) {
  Place place("archimedes-screw");
  const picture::ImageData drawn = draw(place.assets(), place.scene(2), picture::Stereo::side_by_side, kBothEyes);
  compare("archimedes-screw-3-sbs", drawn);
  if (accepts()) return;
  const std::optional<picture::ImageData> reference = test::read_reference(reference_file("archimedes-screw-3-sbs"));
  ASSERT_TRUE(reference);
  const test::Likeness swapped = likeness_to(*reference, halves_swapped(drawn));
  EXPECT_FALSE(alike(swapped)) << swapped.mean << ", worst " << swapped.worst;
  std::cout << "with the fault: likeness " << swapped.mean << ", in places " << swapped.worst << "\n";
}

picture::ImageData grey(std::uint32_t side, const std::function<int(std::uint32_t, std::uint32_t)>& level) {
  picture::ImageData out{side, side, {}};
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const auto value = static_cast<std::uint8_t>(std::clamp(level(x, y), 0, 255));
      out.rgba.insert(out.rgba.end(), {value, value, value, 255});
    }
  }
  return out;
}

TEST(PictureLikeness, tells_what_eyes_see_from_what_they_do_not) {
  const auto pattern = [](std::uint32_t x, std::uint32_t y) { return static_cast<int>(60 + (x / 5 + y / 7) % 3 * 60); };
  const picture::ImageData picture = grey(64, pattern);
  const test::Likeness same = test::likeness(picture, picture);
  EXPECT_NEAR(same.mean, 1, 1e-9);
  EXPECT_NEAR(same.worst, 1, 1e-9);
  const auto noise =
      grey(64, [&](auto x, auto y) { return pattern(x, y) + static_cast<int>((x * 7 + y * 13) % 5) - 2; });
  EXPECT_TRUE(alike(test::likeness(picture, noise)));
  const auto spot = grey(64, [&](auto x, auto y) { return x < 10 && y < 10 ? 20 : pattern(x, y); });
  const test::Likeness spotted = test::likeness(picture, spot);
  EXPECT_GT(spotted.mean, 0.9) << "the mean of the picture hides it";
  EXPECT_LT(spotted.worst, 0.5);
  EXPECT_FALSE(alike(test::likeness(picture, grey(64, [&](auto x, auto y) { return pattern(x, y) / 2; }))));
  EXPECT_EQ(test::likeness(picture, grey(32, pattern)).mean, 0);
}

}  // namespace
}  // namespace mechane::display
