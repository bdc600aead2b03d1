// Meshes made by formula: hand segments, placeholders, the plain, falling water.
#pragma once

#include "client-sdk/picture/scene_parts.hpp"

namespace mechane::picture {

/// A superquadric (reference: Barr 1981) with semi-axes a, exponents e1, e2, its long axis along z of its own frame.
[[nodiscard]] MeshData superquadric_mesh(const Vec3& a_m, double e1, double e2, int rings, int sectors);

/// A sphere about the origin.
[[nodiscard]] MeshData sphere_mesh(double radius_m, int rings, int sectors);

/// A finger's phalanx: along x, round across, thinner towards +x by `taper` (0..1).
[[nodiscard]] MeshData phalanx_mesh(double length_m, double radius_m, double taper);

/// A box about the origin, with flat faces.
[[nodiscard]] MeshData box_mesh(const Vec3& half_m);

/// The plain box that is shown in place of a missing mesh.
inline constexpr float kPlaceholderHalf_m = 0.12F;
[[nodiscard]] MeshData placeholder_mesh();

/// A level disc about the origin that faces up.
[[nodiscard]] MeshData disc_mesh(double radius_m, int sectors);

/// How long the water falls, from the spout to where it lands.
[[nodiscard]] float flight_time_s(const WaterStream& stream);

/// After which time a jet's core has broken up: 8.51 d We^0.31 / v (Sallam, Dai & Faeth 2002, turbulent jets in still
/// air), with We for water's density and surface tension.
[[nodiscard]] float jet_breakup_s(const WaterStream& stream);

/// A tube along the parabola of the falling water, in W. uv: share of the way about the tube, seconds since the spout.
[[nodiscard]] MeshData stream_mesh(const WaterStream& stream);

}  // namespace mechane::picture
