// The normal of a surface as a soft fingertip feels it: facets are smoothed away, edges stay.
#pragma once

#include "server/collision/object.hpp"

namespace mechane::haptics {

/// The points of a fingertip's pad: 48 around z = 0 of its own frame, in pairs on both sides of the middle, as dense as a normal
/// distribution. An object without a surface of its own. Not in the tick.
[[nodiscard]] collision::Object make_pad();

/// A touch on a body, in the body's frame.
struct Touch {
  Vec3 p_B = Vec3::Zero();
  double surface_m = 0;      ///< from p_B to the surface, against the normal
  Vec3 n_B = Vec3::UnitZ();  ///< unit, as the contacts gave it
  bool thin_walls = true;    ///< those under 3 mm are smoothed, too
  int rounds = 1;            ///< how often a plane is fitted, each time with the normal of the last one
  Vec3 v_B = Vec3::Zero();   ///< of the hand over the surface, m/s
};

/// A surface as a soft fingertip feels it, in the body's frame.
struct SmoothSurface {
  Vec3 n_B = Vec3::UnitZ();  ///< unit
  /// Along the hand's way; where that is slow, the mean of all directions. > 0 bulges towards the hand.
  double curvature_per_m = 0;
};

/// Fits a plane to where the pad's points come to lie on the body, around the place where its surface is felt, and returns the plane's
/// unit normal and how the points bend away from it. Surface that is turned by more than 45 degrees from the touch's normal belongs to
/// another side of an edge, and does not count; where little is left, the answer goes over into the touch's own normal, without a bend.
/// Allocates nothing; any thread.
///
/// Compare the smoothed distance map of the paper (Figure 16) and force shading (Morgenbesser and Srinivasan 1996), which interpolates the
/// normals of a mesh's corners: this needs no mesh.
[[nodiscard]] SmoothSurface smooth_surface(const collision::Object& pad, const collision::Object& body,
                                           const Touch& touch) noexcept;

}  // namespace mechane::haptics
