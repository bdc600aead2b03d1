// Fixed sizes of a world. They are fixed so that a tick never allocates and a wire sample never grows.
#pragma once

#include <cstddef>

namespace mechane::state {

inline constexpr std::size_t kMaxUsers = 4;       ///< hands in one world
inline constexpr std::size_t kHandSegments = 16;  ///< palm, then thumb, index, middle, ring, little: 3 phalanges each
inline constexpr std::size_t kFingers = 5;        ///< thumb first
inline constexpr std::size_t kHandJoints = 20;  ///< 4 a finger: abduction, then flexion from the palm outwards, radians
inline constexpr std::size_t kMaxContacts = 512;     ///< of one user in one tick; the deepest are kept
inline constexpr std::size_t kMaxLocalContacts = 8;  ///< in the local contact model of HapticOutput
inline constexpr std::size_t kMaxRopeNodes = 12;     ///< of one rope: its two ends and what it runs over
inline constexpr std::size_t kMaxEventsPerTick = 64;
inline constexpr std::size_t kMaxCommandsPerTick = 8;

}  // namespace mechane::state
