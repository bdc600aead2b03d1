// What a scene is made of: meshes in their places, water, ropes, hands, particles. W is the world (y up, metres), M a
// mesh's own frame.
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
  std::optional<std::uint32_t> object{};  ///< its index in the manifest; none: it cannot be clicked on
  bool near = true;                       ///< false: too far away to hide what a pointer is on
};

/// A surface of water: drawn after all that is opaque, with ripples of its own normals.
struct WaterInstance {
  std::uint32_t mesh = 0;
  Eigen::Affine3f X_WM = Eigen::Affine3f::Identity();
  float clearness = 0.5F;        ///< 0 deep and muddy .. 1 a thin clear sheet
  float ripple = 1;              ///< slope of the waves against a calm basin's
  Vec3f flow_W = Vec3f::Zero();  ///< horizontal, m/s: the ripples move with it
  float width_m = 0;             ///< over 0: uv's x is the share of the way across, and its sides end softly
};

/// Falling water: a parabola from where it leaves, with any velocity, to where it lands.
struct WaterStream {
  Vec3f p_WS = Vec3f::Zero();  ///< where it leaves
  Vec3f v_W = Vec3f::Zero();   ///< with what velocity, m/s
  float landing_height_m = 0;  ///< y in W where it ends
  float width_m = 0;           ///< 0: none
  bool jet = false;            ///< from a nozzle: round, and breaking up into drops
};

/// A rope through its points, drawn as a tube of laid hemp that casts a shadow. Meant for about eight of up to 200
/// points each.
struct RenderRope {
  std::vector<Vec3f> points_W;  ///< from end to end, taut between them
  float radius_m = 0;           ///< 0: none
};

/// A mesh that changes its shape from picture to picture: a hand's skin. In W.
struct SoftBody {
  MeshData mesh_W;
  std::uint32_t material = 0;
};

/// A source of particles: steam from a nozzle, a fire, dust. Its particles depend on the scene's time alone: see
/// particles.hpp.
struct ParticleEffect {
  enum class Kind : std::uint8_t { steam, smoke, fire, dust, spray };
  Kind kind = Kind::steam;
  Vec3f p_W = Vec3f::Zero();           ///< the source's middle
  Vec3f direction_W = Vec3f::UnitY();  ///< unit
  float intensity = 0;                 ///< 0 none .. 1
  float size_m = 0.05F;                ///< the source's radius: nozzle, hearth; particles grow from it
  float speed_m_per_s = 0;             ///< at the source
};

}  // namespace mechane::picture
