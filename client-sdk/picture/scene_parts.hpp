// What a scene is made of: meshes in their places, water, ropes, hands, particles. W is the world (y up, metres), M a mesh's own frame.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Dense>

#include "client-sdk/picture/scene_assets.hpp"
#include "server/base/math.hpp"

namespace mechane::picture {

struct Instance {
  std::uint32_t mesh = 0;      ///< into SceneAssets::meshes
  std::uint32_t material = 0;  ///< into SceneAssets::materials
  Eigen::Affine3f X_WM = Eigen::Affine3f::Identity();
  bool casts_shadow = true;
  std::optional<std::uint32_t> object{};  ///< of the manifest, where somebody may click on it
  bool near = true;                       ///< false: too far away to hide what somebody points at
};

/// A surface of water: drawn after all that is opaque, with ripples of its own normals.
struct WaterInstance {
  std::uint32_t mesh = 0;
  Eigen::Affine3f X_WM = Eigen::Affine3f::Identity();
  float clearness = 0.5F;        ///< 0 deep and muddy .. 1 a thin clear sheet
  float ripple = 1;              ///< slope of the waves against a calm basin's
  Vec3f flow_W = Vec3f::Zero();  ///< m/s, level: what is seen of its ripples goes with it
  float width_m = 0;             ///< over 0: uv's x is the share of the way across, and its sides end softly
};

/// Falling water: a parabola from where it leaves, with any velocity, to where it lands.
struct WaterStream {
  Vec3f p_WS = Vec3f::Zero();  ///< where it leaves
  Vec3f v_W = Vec3f::Zero();   ///< with what velocity, m/s
  float landing_height_m = 0;  ///< y in W where it ends
  float width_m = 0;           ///< 0: none
  bool jet = false;            ///< out of a nozzle: round, and falling apart into drops on its way
};

/// A rope where its points are, drawn as a tube of laid hemp that throws a shadow. Made for some eight of up to 200 points each.
struct RenderRope {
  std::vector<Vec3f> points_W;  ///< from end to end, taut between them
  float radius_m = 0;           ///< 0: none
};

/// What changes its shape from picture to picture: a hand's skin. In W.
struct SoftBody {
  MeshData mesh_W;
  std::uint32_t material = 0;
};

/// Where steam leaves a nozzle, a fire burns, dust is whirled up. Follows from the scene's time alone: see particles.hpp.
struct ParticleEffect {
  enum class Kind : std::uint8_t { steam, smoke, fire, dust, spray };
  Kind kind = Kind::steam;
  Vec3f p_W = Vec3f::Zero();           ///< the middle of where it leaves
  Vec3f direction_W = Vec3f::UnitY();  ///< unit
  float intensity = 0;                 ///< 0 none .. 1
  float size_m = 0.05F;                ///< radius of where it leaves: nozzle, hearth; particles grow from it
  float speed_m_per_s = 0;             ///< with which it leaves
};

}  // namespace mechane::picture
