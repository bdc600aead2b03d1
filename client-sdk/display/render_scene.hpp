// What the renderer draws, as plain data: nothing here knows DDS, files or OpenGL. `SceneAssets` only ever grows; a `RenderScene`
// is made anew for each frame. Frames: W is the world (y up, metres), M a mesh's own frame. Colours are linear unless said.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "client-sdk/display/camera.hpp"
#include "client-sdk/display/overlay_controls.hpp"
#include "server/base/math.hpp"

namespace mechane::display {

/// Triangles for one draw call. `normals` is as long as `positions`; `tangents` and `uv` may be empty.
struct MeshData {
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;             ///< unit
  std::vector<Eigen::Vector4f> tangents;  ///< xyz along +u; w is the sign of the bitangent
  std::vector<Eigen::Vector2f> uv;        ///< (0, 0) is the image's upper left corner
  std::vector<std::uint32_t> indices;     ///< three a triangle, counter-clockwise seen from outside
  std::string name{};                     ///< for a person: "machine.glb#WHEEL"; empty: the display's own
};

/// Eight bits a channel, upper row first.
struct ImageData {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba;
  bool srgb = true;    ///< colour; false: numbers such as normals
  std::string name{};  ///< for a person: "machine.glb, texture oak"; empty: the display's own
};

/// Metallic-roughness, as glTF has it. Textures index SceneAssets::images.
struct MaterialData {
  Eigen::Vector4f base_colour = Eigen::Vector4f::Ones();
  Vec3f emissive = Vec3f::Zero();
  float metallic = 0;
  float roughness = 0.8F;
  float occlusion_strength = 1;  ///< how much of its occlusion image counts, 0..1
  float alpha_cutoff = 0;        ///< over 0: fragments with less opacity are left out
  bool clear = false;            ///< seen through by base_colour's opacity, drawn last and sorted; throws no shadow
  bool double_sided = false;
  bool land = false;  ///< earth: looks like the plain around, whatever its own colours; its images give the grain
  std::optional<std::uint32_t> base_colour_image;
  std::optional<std::uint32_t> normal_image;
  std::optional<std::uint32_t> metallic_roughness_image;
  std::optional<std::uint32_t> emissive_image;
  std::optional<std::uint32_t> occlusion_image;  ///< red: share of the sky's light that arrives
};

struct SceneAssets {
  std::vector<MeshData> meshes;
  std::vector<MaterialData> materials;
  std::vector<ImageData> images;
};

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

struct Sun {
  Vec3f to_sun_W = Vec3f(0.58F, 0.60F, 0.46F).normalized();
  Vec3f irradiance =
      Vec3f(4.6F, 3.85F, 2.8F);  ///< on a surface that faces the sun; the sky's own radiance is about 0.5
};

/// A number that visitors read.
struct Readout {
  std::string label;             ///< "Water lifted"
  std::string value;             ///< "12,4"
  std::string unit;              ///< "l"
  double fraction = 0;           ///< of the gauge's end, 0..1
  std::string end;               ///< what the gauge's end stands for: "20"
  std::optional<double> goal{};  ///< where on the gauge the step's goal is, 0..1
};

/// Drawn under all panels, in pixels of one eye's picture; sRGB with straight alpha.
struct OverlayDot {
  float x = 0;
  float y = 0;
  float radius = 0;
  Eigen::Vector4f colour = Eigen::Vector4f::Ones();
};

/// What a thing is called, above it where there is room. The thing's place is in pixels of one eye's picture.
struct OverlayLabel {
  std::string text;
  float left = 0, top = 0, right = 0, bottom = 0;
  bool framed = false;  ///< its corners are marked: all of it is there
};

/// Everything that is written over the picture, in one language, UTF-8.
struct OverlayContent {
  std::string title;
  std::string caption;
  std::string hint;
  std::string note;  ///< calm word about the link: "The connection was lost. Waiting ..."
  std::uint32_t steps_done = 0;
  std::uint32_t steps_total = 0;
  std::vector<Readout> readouts;
  std::string goal;                   ///< of the activity, at its beginning
  std::vector<OverlayButton> corner;  ///< low on the right
  std::optional<OverlayPanel> panel;  ///< it stands before captions and readouts, which are not shown then
  OverlayStyle style;
  std::vector<OverlayDot> dots{};        ///< of the display's own hand
  std::optional<OverlayLabel> label{};   ///< of what is pointed at
  std::optional<OverlayAction> meant{};  ///< of the button under the mouse: it is lit
};

/// A sphere that darkens what is near it: contact shading of the hand.
struct Occluder {
  Vec3f p_WO = Vec3f::Zero();
  float radius_m = 0;
};

/// What a pointer or a finger is on.
struct Touched {
  std::uint32_t object = 0;  ///< of the manifest
  Vec3 p_WT = Vec3::Zero();  ///< there
};

/// A thing that visitors have a name for, and where it is.
struct NamedThing {
  std::uint32_t object = 0;  ///< of the manifest
  std::string name;          ///< in the visitor's language
  Eigen::Affine3f X_WB = Eigen::Affine3f::Identity();
  Eigen::AlignedBox3f box_B;
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
  Eigen::AlignedBox3f shadow_box_W;       ///< what throws shadows
  Eigen::AlignedBox3f focus_box_W;        ///< where they are to be sharpest; empty: everywhere alike
  Camera camera;
  Sun sun;
  bool sky = true;                             ///< false: black, no light but the sun's
  std::optional<float> ground_height_m;        ///< an endless plain of dry earth at this height
  std::optional<std::uint32_t> land_material;  ///< whose images give the plain its grain; none: it has none
  double time_s = 0;  ///< of the world, for ripples: the frame's tick, never the client's clock
  std::vector<NamedThing> named;
  std::optional<Touched> near_hand;  ///< what a free hand is about to touch, of those that are named
  OverlayContent overlay;
  std::optional<Inset> inset;
};

}  // namespace mechane::display
