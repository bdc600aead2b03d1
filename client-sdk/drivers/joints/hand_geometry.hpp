// From the points of a tracked hand to the wrist's pose and the angles of the joints.
#pragma once

#include "client-sdk/drivers/joints/hand_datagram.hpp"
#include <mechane/driver.h>

namespace mechane::drivers {

/// Places the hand, whose points are in D: position_m, orientation_wxyz, joints_rad and grasp of `state`. Returns "", or
/// why the points are not those of a hand, for people; then `state` stays as it was. Any thread; allocates nothing.
///
/// Frame H has its origin at the wrist, x towards the middle between the knuckles of index and little finger, and y out
/// of the back of the hand. z points away from the thumb of a right hand, and towards that of a left one, whose angles
/// are those of the right hand that is its mirror image. A bend is the angle between two bones; all bends of a finger lie in
/// a plane through y, and abduction is how far that plane is turned about y. For the thumb x and y are those of the flat
/// thumb of Mechane's hand. Angles are limited to what joints can do.
///
/// `grasp` is the closing of the fingers, or the pinch where that is more: the tracker's own, or the nearness of the
/// tips of thumb and index finger.
[[nodiscard]] const char* place_tracked_hand(const HandDatagram& hand, mechane_device_state& state) noexcept;

}  // namespace mechane::drivers
