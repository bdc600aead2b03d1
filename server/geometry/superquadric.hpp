// The superquadric (superellipsoid) with taper and bend, in its own frame Q: the inside-outside function F, the parametric surface,
// tangents and normals. Equation numbers are those of the paper; deformations after Barr 1984 and Solina & Bajcsy 1990.
#pragma once

#include <Eigen/Dense>

#include "server/base/math.hpp"

namespace mechane::geometry {

/// Shape of a superquadric in its frame Q; `T` is double, or a jet while fitting. The undeformed surface is tapered first, then bent.
template <class T>
struct BasicSuperquadric {
  Eigen::Matrix<T, 3, 1> a = Eigen::Matrix<T, 3, 1>::Constant(T(1));  ///< semi-axes along x, y, z, metres, > 0
  T e1 = T(1);              ///< shape exponent along z: 0.1 boxy, 1 round, 1.9 nearly a double cone
  T e2 = T(1);              ///< shape exponent of the section across z
  T taper_x = T(0);         ///< x is scaled by taper_x z / a.z + 1; |taper| < 1
  T taper_y = T(0);         ///< the same for y
  T bend_per_m = T(0);      ///< curvature k >= 0 of the bend along z; k r < 1 and |k z| < pi over the part
  T bend_angle_rad = T(0);  ///< alpha, the direction about z towards which it bends
};
using Superquadric = BasicSuperquadric<double>;

/// Exponents outside this range overflow F and the normals in float32: fitted parts stay inside it.
inline constexpr double kMinExponent = 0.1;
inline constexpr double kMaxExponent = 1.9;

/// Parameters of the surface (paper, equation 5): eta in [-pi/2, pi/2], omega in (-pi, pi], radians.
struct SurfaceAngles {
  double eta = 0;
  double omega = 0;
};

struct SurfaceTangents {
  Vec3 eta = Vec3::Zero();    ///< dr/d eta
  Vec3 omega = Vec3::Zero();  ///< dr/d omega
};

/// False where an axis is not positive and finite, an exponent is outside (0, 2], or a deformation folds the part over itself.
[[nodiscard]] bool is_valid(const Superquadric& shape);

/// True when taper or bend is not zero.
[[nodiscard]] bool is_deformed(const Superquadric& shape);

/// F of equation 1 at p_QP: below 1 inside, 1 on the surface, above 1 outside. Deformed shapes are undeformed first.
[[nodiscard]] double inside_outside(const Superquadric& shape, const Vec3& p_QP);

/// F^(e1/2): like F, but it grows in proportion to the distance from the centre (exactly so without deformation).
[[nodiscard]] double radial_form(const Superquadric& shape, const Vec3& p_QP);

/// dF/dp at p_QP. Zero at the centre.
[[nodiscard]] Vec3 gradient(const Superquadric& shape, const Vec3& p_QP);

/// r(eta, omega) of equation 5, deformed.
[[nodiscard]] Vec3 surface_point(const Superquadric& shape, SurfaceAngles angles);

/// Derivatives of r. For exponents below 1 they are unbounded on the edges eta = 0, +-pi/2 and omega = k pi/2: ask beside them.
[[nodiscard]] SurfaceTangents surface_tangents(const Superquadric& shape, SurfaceAngles angles);

/// The outward unit normal (equation 16; det(J) J^-T n0 when deformed, J the deformation's Jacobian).
[[nodiscard]] Vec3 surface_normal(const Superquadric& shape, SurfaceAngles angles);

/// The angles of a surface point; of any other point, those where its ray from the centre meets the undeformed surface.
[[nodiscard]] SurfaceAngles angles_of(const Superquadric& shape, const Vec3& p_QP);

/// Taper, then bend. The inverse holds while k r < 1 and |k z| < pi (see is_valid).
[[nodiscard]] Vec3 deform(const Superquadric& shape, const Vec3& p_undeformed);
[[nodiscard]] Vec3 undeform(const Superquadric& shape, const Vec3& p_QP);

}  // namespace mechane::geometry
