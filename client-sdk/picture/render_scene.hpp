// What the renderer draws, as plain data, made for each frame, without DDS, files or OpenGL. W is the world (y up,
// metres). Colours are linear unless stated otherwise.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "client-sdk/picture/camera.hpp"
#include "client-sdk/picture/named_thing.hpp"
#include "client-sdk/picture/overlay_content.hpp"
#include "client-sdk/picture/scene_parts.hpp"
#include "server/base/math.hpp"

namespace mechane::picture {

struct Sun {
  Vec3f to_sun_W = Vec3f(0.58F, 0.60F, 0.46F).normalized();
  Vec3f irradiance =
      Vec3f(4.6F, 3.85F, 2.8F);  ///< on a surface that faces the sun; the sky's own radiance is about 0.5
};

/// A sphere that darkens nearby surfaces: contact shading of the hand.
struct Occluder {
  Vec3f p_WO = Vec3f::Zero();
  float radius_m = 0;
};

/// What visitors look at while they work: a hand, what it holds or can take, where that belongs. Words do not cover it.
struct SeenThing {
  std::vector<Vec3f> points_W;     ///< its outline lies within these,
  float around_m = 0;              ///< enlarged by this
  std::optional<Vec3f> about_W{};  ///< of a large thing only what is near this point
};

/// A close-up in a corner of the picture, for what the main view shows too small. Flat: the same for both eyes.
struct Inset {
  Camera camera;
  std::string caption;
};

inline constexpr std::size_t kMaxOccluders = 32;

struct RenderScene {
  std::vector<Instance> instances;
  std::vector<WaterInstance> waters;
  std::vector<WaterStream> streams;
  std::vector<RenderRope> ropes;
  std::vector<SoftBody> soft_bodies;
  std::vector<ParticleEffect> effects;
  Vec3f wind_W = Vec3f(0.32F, 0, 0.10F);  ///< m/s; smoke drifts with it
  std::vector<Occluder> occluders;        ///< the first kMaxOccluders count
  Eigen::AlignedBox3f shadow_box_W;       ///< contains all that casts shadows
  Eigen::AlignedBox3f focus_box_W;        ///< where shadows are sharpest; empty: everywhere equally sharp
  Camera camera;
  Eigen::AlignedBox3d work_W;   ///< where hands work in this step; empty: nowhere
  std::vector<SeenThing> seen;  ///< the most important first
  Sun sun;
  bool sky = true;                             ///< false: a black sky, and only the sun's light
  std::optional<float> ground_height_m;        ///< an endless plain of dry earth at this height
  std::optional<std::uint32_t> land_material;  ///< its images give the plain its texture; none: a plain without texture
  double time_s = 0;  ///< the world's time, for ripples: from the frame's tick, never the client's clock
  std::vector<NamedThing> named;
  std::optional<Touched> near_hand;  ///< the named thing that a free hand is about to touch
  OverlayContent overlay;
  std::optional<Inset> inset;
};

}  // namespace mechane::picture
