#include "client-sdk/draw/low_renderer.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include <epoxy/gl.h>

#include "client-sdk/draw/passes/particles.hpp"
#include "client-sdk/picture/box_corners.hpp"
#include "client-sdk/picture/procedural_mesh.hpp"
#include "server/base/assert.hpp"

namespace mechane::draw {
namespace {

constexpr std::uint32_t kStillMap = 2048;
constexpr std::uint32_t kMoverMap = 1024;
/// So many times its size away, a fire's light is a hundredth of the sky's.
constexpr float kFireReach_sizes = 40;
/// How far surfaces may be off in the picture, and in the shadow maps, so that fewer triangles are drawn.
constexpr float kCoarseness_px = 0.5F;
constexpr float kCoarseness_texels = 0.5F;

template <class Target, class... Use>
Expected<void> fit(std::optional<Target>& target, picture::PixelSize size, Use... use) {
  if (target && target->size == size) return {};
  target.reset();
  Expected<Target> made = Target::create(size, use...);
  if (!made) return tl::unexpected(made.error());
  target.emplace(std::move(*made));
  return {};
}

picture::PixelSize half_of(picture::PixelSize size) {
  return {std::max((size.width + 1) / 2, 1U), std::max((size.height + 1) / 2, 1U)};
}

Eigen::AlignedBox3f box_of(std::uint32_t mesh, const Eigen::Affine3f& X_WM, const GpuAssets& assets) {
  Eigen::AlignedBox3f box_W;
  const GpuAssets::Level whole = assets.level(mesh);
  for (const MeshPiece& piece : std::span(assets.pieces(mesh)).first(whole.end)) {
    box_W.extend(picture::moved(piece.box_M, X_WM));
  }
  return box_W;
}

template <class Points>
Eigen::AlignedBox3f box_of_points(const Points& points_W, float margin_m) {
  Eigen::AlignedBox3f box_W;
  for (const Vec3f& p_W : points_W)
    box_W.extend(p_W);
  if (!box_W.isEmpty()) box_W = {box_W.min().array() - margin_m, box_W.max().array() + margin_m};
  return box_W;
}

/// Boxes of a scene's particles, one for each of their sources.
void append_particle_boxes(const picture::RenderScene& scene, std::vector<Eigen::AlignedBox3f>& out) {
  std::vector<Particle> particles;
  const auto close_box = [&] {
    Eigen::AlignedBox3f& box_W = out.emplace_back();
    for (const Particle& particle : particles) {
      const Vec3f reach = Vec3f::Constant(2 * particle.radius_m);  // flames are stretched
      box_W.extend(Eigen::AlignedBox3f(particle.p_W - reach, particle.p_W + reach));
    }
    particles.clear();
  };
  for (std::uint32_t i = 0; i < scene.effects.size(); ++i) {
    append_particles(scene.effects[i], i, scene.wind_W, scene.time_s, particles);
    close_box();
  }
  for (std::uint32_t i = 0; i < scene.streams.size(); ++i) {
    append_drops(scene.streams[i], scene.time_s, particles);
    append_splash(scene.streams[i], i, scene.time_s, particles);
    close_box();
  }
}

/// What a fire visibly lights.
Eigen::AlignedBox3f lit_box(const FireKey& fire) {
  const Vec3f middle(fire.p_W[0], fire.p_W[1], fire.p_W[2]);
  const Vec3f reach = Vec3f::Constant(kFireReach_sizes * fire.size_m);
  return {middle - reach, middle + reach};
}

std::vector<Vec3f> corners_of(const Eigen::AlignedBox3f& box_W) {
  std::vector<Vec3f> out;
  for (int i = 0; !box_W.isEmpty() && i < 8; ++i)
    out.push_back(box_W.corner(static_cast<Eigen::AlignedBox3f::CornerType>(i)));
  return out;
}

float lowest_m(const picture::RenderScene& scene) {
  const float floor_m = scene.shadow_box_W.isEmpty() ? -1.0F : scene.shadow_box_W.min().y();
  return std::min(floor_m, scene.ground_height_m.value_or(floor_m)) - 0.01F;
}

/// How far a shadow's soft edge may reach, with the lift of what it falls on: texels of its map.
constexpr float kEdgeOfStill = 6;
constexpr float kEdgeOfMovers = 2;

float edge_m(const ShadowSetup& setup, const ShadowTarget& map, float texels) {
  return setup.cascades.empty() ? 0 : texels * setup.cascades.back().texel_m(map.size);
}

/// The pixels of a box and of its shadow, whose edge reaches edge_m farther.
ScreenRegion region_with_shadow(Eigen::AlignedBox3f box_W, float edge_m, const picture::RenderScene& scene,
                                const picture::EyeView& view, picture::PixelSize size) {
  if (box_W.isEmpty()) return {};
  box_W = {box_W.min().array() - edge_m, box_W.max().array() + edge_m};
  const std::vector<Vec3f> corners_W = corners_with_shadow(box_W, scene.sun.to_sun_W.normalized(), lowest_m(scene));
  return corners_W.empty() ? whole_region(size) : region_of(view.P * view.V_CW, corners_W, size);
}

/// All numbers on which the picture of what stands still depends, but for its things.
std::vector<float> numbers_of(const picture::RenderScene& scene, const picture::EyeView& view,
                              picture::PixelSize size) {
  std::vector<float> out{static_cast<float>(size.width), static_cast<float>(size.height), scene.sky ? 1.0F : 0.0F,
                         scene.ground_height_m.value_or(-1e6F), static_cast<float>(scene.land_material.value_or(0))};
  const auto add = [&out](const auto& matrix) { out.insert(out.end(), matrix.data(), matrix.data() + matrix.size()); };
  add(view.V_CW);
  add(view.P);
  add(scene.sun.to_sun_W);
  add(scene.sun.irradiance);
  for (const Eigen::AlignedBox3f& box_W : {scene.shadow_box_W, scene.focus_box_W}) {
    add(box_W.min());
    add(box_W.max());
  }
  return out;
}

/// How far an edge's smoothing reaches, pixels.
constexpr int kSmoothed = 5;

ScreenRegion grown(const ScreenRegion& region, picture::PixelSize size) {
  const ScreenRegion whole = whole_region(size);
  return {std::max(region.left - kSmoothed, 0), std::max(region.bottom - kSmoothed, 0),
          std::min(region.right + kSmoothed, whole.right), std::min(region.top + kSmoothed, whole.top)};
}

/// A column: each has some of the sky and some of the ground.
ScreenRegion slice_of(picture::PixelSize size, std::uint32_t number) {
  const auto edge = [&](std::uint32_t k) { return static_cast<int>(size.width * k / LowRenderer::kSlices); };
  return {edge(number), 0, edge(number + 1), static_cast<int>(size.height)};
}

/// While it lives, only pixels of the region are drawn, in an area whose lower left corner is (x, y).
class Scissor {
 public:
  Scissor(const ScreenRegion& region, int x, int y) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(x + region.left, y + region.bottom, region.right - region.left, region.top - region.bottom);
  }
  Scissor(const Scissor&) = delete;
  Scissor& operator=(const Scissor&) = delete;
  ~Scissor() { glDisable(GL_SCISSOR_TEST); }
};

void begin_full_picture() {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
}

/// The scene without anything in it: its camera, its light and its land.
picture::RenderScene empty_of(const picture::RenderScene& scene) {
  picture::RenderScene out;
  out.effects = scene.effects;  // fires give light
  out.shadow_box_W = scene.shadow_box_W;
  out.focus_box_W = scene.focus_box_W;
  out.camera = scene.camera;
  out.sun = scene.sun;
  out.sky = scene.sky;
  out.wind_W = scene.wind_W;
  out.time_s = scene.time_s;
  return out;
}

}  // namespace

Expected<LowRenderer> LowRenderer::create() {
  Expected<ShadowPass> still_shadow = ShadowPass::create(kStillMap, kCoarseness_texels);
  if (!still_shadow) return tl::unexpected(still_shadow.error());
  Expected<ShadowPass> mover_shadow = ShadowPass::create(kMoverMap, kCoarseness_texels);
  if (!mover_shadow) return tl::unexpected(mover_shadow.error());
  Expected<OpaquePass> opaque = OpaquePass::create(Shading::screen);
  if (!opaque) return tl::unexpected(opaque.error());
  Expected<SkyPass> sky = SkyPass::create(Shading::screen);
  if (!sky) return tl::unexpected(sky.error());
  Expected<WaterPass> water = WaterPass::create(Shading::screen);
  if (!water) return tl::unexpected(water.error());
  Expected<ClearPass> clear = ClearPass::create(Shading::screen);
  if (!clear) return tl::unexpected(clear.error());
  Expected<ParticlePass> particle = ParticlePass::create(Shading::screen);
  if (!particle) return tl::unexpected(particle.error());
  Expected<Program> relight = Program::link({"fullscreen.vert"}, {"low.glsl", "tone.glsl", "relight.frag"});
  if (!relight) return tl::unexpected(relight.error());
  Expected<Program> smooth = Program::link({"fullscreen.vert"}, {"fxaa.frag"});
  if (!smooth) return tl::unexpected(smooth.error());
  return LowRenderer(Passes{std::move(*still_shadow), std::move(*mover_shadow), std::move(*opaque), std::move(*sky),
                            std::move(*water), std::move(*clear), std::move(*particle), std::move(*relight),
                            std::move(*smooth), make_vertex_array()});
}

void LowRenderer::forget() {
  stillness_.forget();
  evenness_.forget();
  fires_.clear();
  pictures_ = 0;
  kept_.clear();
  passes_.still_shadow.forget();
  passes_.mover_shadow.forget();
  for (View& view : views_) {
    view.slices = 0;
    view.drawn_in = 0;
  }
}

void LowRenderer::begin(const LowScene& low) {
  stillness_.see(std::span(low.scene.instances));
  evenness_.see(std::span(low.scene.effects));
  ++picture_;
  pictures_ = std::min(pictures_ + 1, kStill);
  let_go(low.assets);
  keep_what_rests(low);
  part(low);
  draw_shadows(low);
}

/// What is kept there must be drawn anew.
void LowRenderer::spoil(const Eigen::AlignedBox3f& box_W) {
  for (View& view : views_) {
    if (view.begun()) view.spoilt.push_back(box_W);
  }
}

/// What has moved, or is gone, leaves the kept pictures.
void LowRenderer::let_go(const GpuAssets& assets) {
  for (auto one = kept_.begin(); one != kept_.end();) {
    if (stillness_.pictures(*one) > 0) {
      ++one;
      continue;
    }
    spoil(box_of(one->mesh, one->pose(), assets));
    one = kept_.erase(one);
  }
  std::erase_if(fires_, [this](const FireKey& fire) {
    const bool gone = evenness_.pictures(fire) == 0;
    if (gone) spoil(lit_box(fire));
    return gone;
  });
}

/// What stands still joins the kept pictures: at once where there are none, else only after a while, for they must be
/// drawn anew where it stands.
void LowRenderer::keep_what_rests(const LowScene& low) {
  const std::uint32_t enough = std::ranges::none_of(views_, &View::begun) ? kStill : kSettled;
  for (const picture::Instance& instance : low.scene.instances) {
    // Glass must be drawn over what moves behind it; but nothing moves behind the shade of far trees.
    if (low.assets.is_clear(instance.material) && instance.near) continue;
    const InstanceKey key(instance);
    if (stillness_.pictures(key) >= enough && kept_.insert(key).second)
      spoil(box_of(key.mesh, instance.X_WM, low.assets));
  }
  keep_even_fires(low.scene, enough);
}

/// Fires that move, or grow, light only what moves: for their sake all would be drawn anew in each picture.
void LowRenderer::keep_even_fires(const picture::RenderScene& scene, std::uint32_t enough) {
  for (const picture::ParticleEffect& effect : scene.effects) {
    const FireKey key(effect);
    if (effect.kind == picture::ParticleEffect::Kind::fire && evenness_.pictures(key) >= enough &&
        fires_.insert(key).second)
      spoil(lit_box(key));
  }
}

void LowRenderer::part(const LowScene& low) {
  const picture::RenderScene& scene = low.scene;
  still_ = empty_of(scene);
  std::erase_if(still_.effects, [this](const picture::ParticleEffect& effect) {
    return !fires_.contains(FireKey(effect));  // no other effect gives light
  });
  still_.ground_height_m = scene.ground_height_m;
  still_.land_material = scene.land_material;
  moving_ = empty_of(scene);
  moving_.focus_box_W.setEmpty();  // its one shadow map has the same sharpness everywhere
  casters_W_.clear();
  others_W_.clear();
  for (const picture::Instance& instance : scene.instances) {
    const bool stands = kept_.contains(InstanceKey(instance));
    (stands ? still_ : moving_).instances.push_back(instance);
    if (stands) continue;
    const bool casts = instance.casts_shadow && !low.assets.is_clear(instance.material);
    (casts ? casters_W_ : others_W_).push_back(box_of(instance.mesh, instance.X_WM, low.assets));
  }
  for (const picture::RenderRope& rope : scene.ropes)
    casters_W_.push_back(box_of_points(rope.points_W, rope.radius_m));
  for (const picture::SoftBody& body : scene.soft_bodies)
    casters_W_.push_back(box_of_points(body.mesh_W.positions, 0));
  moving_.waters = scene.waters;
  moving_.streams = scene.streams;
  moving_.ropes = scene.ropes;
  moving_.soft_bodies = scene.soft_bodies;
  for (const picture::WaterInstance& water : scene.waters)
    others_W_.push_back(box_of(water.mesh, water.X_WM, low.assets));
  for (const picture::WaterStream& stream : scene.streams) {
    if (stream.width_m > 0) others_W_.push_back(box_of_points(picture::stream_mesh(stream).positions, 0));
  }
  append_particle_boxes(scene, others_W_);
}

void LowRenderer::draw_shadows(const LowScene& low) {
  still_setup_ = passes_.still_shadow.draw(still_, low.assets, no_ropes_, {});
  if (casters_W_.empty()) return;
  moving_.shadow_box_W.setEmpty();
  for (const Eigen::AlignedBox3f& box_W : casters_W_)
    moving_.shadow_box_W.extend(box_W);
  mover_setup_ = passes_.mover_shadow.draw(moving_, low.assets, low.ropes, low.soft_bodies);
}

PassInput LowRenderer::input_of(const LowScene& low, const picture::RenderScene& scene, const picture::EyeView& view,
                                const ScreenTarget& target, bool movers) const {
  PassInput input{scene,       low.assets,       movers ? low.ropes : no_ropes_, low.soft_bodies,
                  view,        low.sky,          passes_.still_shadow.maps(),    still_setup_,
                  target.size, target.depth_copy};
  input.low = LowLight{low.exposure, nullptr, nullptr, movers};
  input.coarseness_px = kCoarseness_px;
  return input;
}

Expected<void> LowRenderer::draw_view(const LowScene& low, std::size_t index, const picture::EyeView& view,
                                      picture::PixelSize size, bool keeps) {
  View& of = views_[index];
  of.drawn_in = picture_;
  std::vector<float> seen = numbers_of(low.scene, view, size);
  const bool same = seen == of.seen && pictures_ == kStill;
  if (!keeps || !same) of.slices = 0;
  if (!of.begun()) of.spoilt.clear();
  of.seen = std::move(seen);
  if (keeps && same) {
    if (auto ok = fit(of.kept, size, ScreenTarget::Use::kept); !ok) return ok;
    if (auto ok = fit(of.smooth, size); !ok) return ok;
    mend(low, of, view);
  }
  if (!of.whole()) {
    std::optional<ScreenTarget>& target = keeps ? of.half : of.drawn;
    if (auto ok = fit(target, keeps ? half_of(size) : size, ScreenTarget::Use::drawn); !ok) return ok;
    target->bind();
    draw_still(low, view, *target, whole_region(target->size), true);
    of.shown = &*target;
  } else {
    if (auto ok = fit(of.drawn, size, ScreenTarget::Use::drawn); !ok) return ok;
    of.drawn->copy_from(*of.kept);
    of.drawn->bind();
    relight(low, of, view);
    of.shown = &*of.drawn;
    of.changed = changed_regions(low.scene, view, size);
  }
  draw_moving(low, view, *of.shown);
  return {};
}

Expected<void> LowRenderer::draw_at_half_rate(const LowScene& low, std::size_t index, const picture::EyeView& view,
                                              picture::PixelSize size, bool keeps) {
  const View& of = views_[index];
  const bool will_do =
      of.drawn_in + 1 == picture_ && (of.whole() || !keeps) && numbers_of(low.scene, view, size) == of.seen;
  return will_do ? Expected<void>() : draw_view(low, index, view, size, keeps);
}

/// Makes another slice of the kept picture; once it has all, makes it as the scene has it now.
void LowRenderer::mend(const LowScene& low, View& of, const picture::EyeView& view) {
  const picture::PixelSize size = of.kept->size;
  if (!of.whole()) {
    draw_kept(low, of, view, slice_of(size, of.slices));
    ++of.slices;
    times_kept_ += of.whole() ? 1 : 0;
  }
  if (!of.whole()) return;
  std::vector<ScreenRegion> regions;
  const float reach_m = edge_m(still_setup_, passes_.still_shadow.maps(), kEdgeOfStill);
  for (const Eigen::AlignedBox3f& box_W : std::exchange(of.spoilt, {}))
    regions.push_back(region_with_shadow(box_W, reach_m, low.scene, view, size));
  regions = merged(std::move(regions));
  times_mended_ += regions.size();
  for (const ScreenRegion& region : regions)
    draw_kept(low, of, view, region);
}

/// Draws what stands still into the kept picture, and smooths its edges.
void LowRenderer::draw_kept(const LowScene& low, const View& of, const picture::EyeView& view,
                            const ScreenRegion& region) {
  if (region.empty()) return;
  of.kept->bind();
  draw_still(low, view, *of.kept, region, false);
  PictureArea{of.smooth->framebuffer, 0, 0, of.kept->size}.bind();
  const Scissor scissor(grown(region, of.kept->size), 0, 0);
  smooth(of.kept->colour);
}

void LowRenderer::draw_still(const LowScene& low, const picture::EyeView& view, const ScreenTarget& target,
                             const ScreenRegion& region, bool with_movers_shadows) {
  PassInput input = input_of(low, still_, view, target, false);
  if (with_movers_shadows && !casters_W_.empty()) {
    input.low->mover_shadow = &passes_.mover_shadow.maps();
    input.low->mover_setup = &mover_setup_;
  }
  const Scissor scissor(region, 0, 0);
  input.crop = crop_to(region, target.size);
  glDepthMask(GL_TRUE);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  passes_.opaque.draw(input);
  passes_.sky.draw(input);
  // What is blended has no light of its own that a mover's shadow could take away.
  for (const GLuint light : {1U, 2U})
    glColorMaski(light, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  passes_.clear.draw(input);
  for (const GLuint light : {1U, 2U})
    glColorMaski(light, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void LowRenderer::draw_moving(const LowScene& low, const picture::EyeView& view, const ScreenTarget& target) {
  PassInput input = input_of(low, moving_, view, target, true);
  if (!casters_W_.empty()) {
    input.low->mover_shadow = &passes_.mover_shadow.maps();
    input.low->mover_setup = &mover_setup_;
  }
  passes_.opaque.draw(input);
  target.copy_depth();
  passes_.water.draw(input);
  passes_.clear.draw(input);
  passes_.particle.draw(input);
}

/// Where shadows of what moves may fall.
std::vector<ScreenRegion> LowRenderer::shaded_regions(const picture::RenderScene& scene, const picture::EyeView& view,
                                                      picture::PixelSize size) const {
  std::vector<ScreenRegion> out;
  const float reach_m = edge_m(mover_setup_, passes_.mover_shadow.maps(), kEdgeOfMovers);
  for (const Eigen::AlignedBox3f& box_W : casters_W_)
    out.push_back(region_with_shadow(box_W, reach_m, scene, view, size));
  return covered(out, size);
}

/// Where the picture may differ from the kept one, once its edges are smooth.
std::vector<ScreenRegion> LowRenderer::changed_regions(const picture::RenderScene& scene, const picture::EyeView& view,
                                                       picture::PixelSize size) const {
  std::vector<ScreenRegion> out = shaded_regions(scene, view, size);
  for (const Eigen::AlignedBox3f& box_W : others_W_)
    out.push_back(region_of(view.P * view.V_CW, corners_of(box_W), size));
  for (ScreenRegion& region : out) {
    if (!region.empty()) region = grown(region, size);
  }
  return covered(out, size);
}

/// Puts the shadows of what moves on the copy of the kept picture.
void LowRenderer::relight(const LowScene& low, const View& of, const picture::EyeView& view) const {
  if (casters_W_.empty()) return;
  begin_full_picture();
  const Program& program = passes_.relight;
  program.use();
  set_low_light(program, {low.exposure, &passes_.mover_shadow.maps(), &mover_setup_, false});
  program.set("X_WP", Eigen::Matrix4f((view.P * view.V_CW).inverse()));
  constexpr std::array<const char*, 3> kNames{"kept_depth", "kept_all_light", "kept_sun_light"};
  const std::array<const TextureName*, 3> textures{&of.kept->depth, &of.kept->all_light, &of.kept->sun_light};
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    program.set(kNames[k], static_cast<int>(k));
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(k));
    glBindTexture(GL_TEXTURE_2D, textures[k]->get());
  }
  glBindVertexArray(passes_.no_vertices.get());
  for (const ScreenRegion& region : shaded_regions(low.scene, view, of.kept->size)) {
    const Scissor scissor(region, 0, 0);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
}

void LowRenderer::smooth(const TextureName& picture) const {
  begin_full_picture();
  passes_.smooth.use();
  passes_.smooth.set("picture", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, picture.get());
  glBindVertexArray(passes_.no_vertices.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void LowRenderer::show(std::size_t index, const PictureArea& into) const {
  const View& of = views_[index];
  MECHANE_ASSERT(of.shown != nullptr);
  if (!of.whole()) {
    into.bind();
    smooth(of.shown->colour);
    return;
  }
  const auto width = static_cast<GLint>(into.size.width);
  const auto height = static_cast<GLint>(into.size.height);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, of.smooth->framebuffer.get());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, into.framebuffer.get());
  glBlitFramebuffer(0, 0, width, height, into.x, into.y, into.x + width, into.y + height, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
  into.bind();
  for (const ScreenRegion& region : of.changed) {
    const Scissor scissor(region, into.x, into.y);
    smooth(of.shown->colour);
  }
}

}  // namespace mechane::draw
