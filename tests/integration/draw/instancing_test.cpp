// Many instances of one mesh are drawn together, and look as if they were not.
#include <epoxy/gl.h>

#include "tests/integration/draw/drawn_picture.hpp"

namespace mechane::draw {
namespace {

/// Counts what draws solid things, while there is one.
class DrawCalls {
 public:
  DrawCalls() {
    real_multi = epoxy_glMultiDrawElements;
    real_instanced = epoxy_glDrawElementsInstanced;
    count_ = 0;
    epoxy_glMultiDrawElements = [](GLenum mode, const GLsizei* counts, GLenum type, const void* const* places,
                                   GLsizei ranges) {
      ++count_;
      real_multi(mode, counts, type, places, ranges);
    };
    epoxy_glDrawElementsInstanced = [](GLenum mode, GLsizei indices, GLenum type, const void* place,
                                       GLsizei instances) {
      ++count_;
      real_instanced(mode, indices, type, place, instances);
    };
  }
  DrawCalls(const DrawCalls&) = delete;
  DrawCalls& operator=(const DrawCalls&) = delete;
  ~DrawCalls() {
    epoxy_glMultiDrawElements = real_multi;
    epoxy_glDrawElementsInstanced = real_instanced;
  }
  [[nodiscard]] static int count() { return count_; }

 private:
  static inline PFNGLMULTIDRAWELEMENTSPROC real_multi = nullptr;
  static inline PFNGLDRAWELEMENTSINSTANCEDPROC real_instanced = nullptr;
  static inline int count_ = 0;
};

constexpr std::uint32_t kBalls = 70;  // more than one call draws

/// Eggs of two colours, each turned and drawn out in its own way, over a pool that mirrors them and a floor that they shade; the picture's edges
/// cut some. Of one mesh, or of one each.
struct Eggs {
  picture::SceneAssets assets;
  picture::RenderScene scene;

  explicit Eggs(bool one_mesh) {
    assets.meshes = {picture::box_mesh(Vec3(4, 0.05, 4)), picture::disc_mesh(3, 24)};
    for (std::uint32_t i = 0; i < (one_mesh ? 1 : kBalls); ++i)
      assets.meshes.push_back(picture::sphere_mesh(0.1, 24, 48));
    assets.materials.resize(3);
    assets.materials[1].base_colour = Eigen::Vector4f(0.7F, 0.2F, 0.1F, 1);
    assets.materials[1].roughness = 0.3F;
    assets.materials[2].base_colour = Eigen::Vector4f(0.1F, 0.3F, 0.6F, 1);
    add_instance(scene, 0, 0, Vec3f(0, -0.35F, 0));
    for (std::uint32_t i = 0; i < kBalls; ++i) {
      const auto at = static_cast<float>(i);
      add_instance(scene, one_mesh ? 2 : 2 + i, 1 + i % 2,
                   Vec3f(0.45F * (at / 7 - 5), 0.25F, 0.3F * (std::fmod(at, 7.0F) - 3)));
      scene.instances.back().X_WM.rotate(Eigen::AngleAxisf(at, Vec3f(1, 2, 3).normalized()));
      scene.instances.back().X_WM.scale(Vec3f(1, 1.6F, 0.5F + 0.01F * at));
    }
    picture::WaterInstance pool;
    pool.mesh = 1;
    scene.waters.push_back(pool);
    scene.shadow_box_W = Eigen::AlignedBox3f(Vec3f(-4, -0.4F, -4), Vec3f(4, 0.6F, 4));
    scene.camera.p_WC = Vec3(0, 0.9, 3.2);
  }
};

TEST_F(DrawnPicture, many_instances_of_a_mesh_are_drawn_together_and_look_the_same) {
  const auto draw_eggs = [this](bool one_mesh) {
    const Eggs eggs(one_mesh);
    renderer_->forget_assets();
    (void)draw(eggs.assets, eggs.scene);  // epoxy looks functions up at their first calls
    renderer_->forget_assets();           // its shadows, too, are drawn again
    const DrawCalls calls;
    picture::ImageData picture = draw(eggs.assets, eggs.scene);
    return std::pair(std::move(picture), DrawCalls::count());
  };
  const auto [together, few] = draw_eggs(true);
  const auto [apart, many] = draw_eggs(false);
  EXPECT_EQ(together.rgba, apart.rgba);
  EXPECT_GT(many, 3 * kBalls) << "in shadow, mirror and picture";
  EXPECT_LT(few, many / 4);
}

}  // namespace
}  // namespace mechane::draw
