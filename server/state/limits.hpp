// Fixed sizes of a world. They are fixed so that a tick never allocates and a wire sample never grows.
#pragma once

#include <cstddef>

namespace mechane::state {

inline constexpr std::size_t kMaxContacts = 512;   ///< of one user in one tick; see find_contacts()
inline constexpr std::size_t kMaxPatches = 64;     ///< touches of one user, each of one segment with one body
inline constexpr std::size_t kMaxSides = 16;       ///< of one user's tips and palm; two for each in a corner
inline constexpr std::size_t kMaxRopeNodes = 12;   ///< of one rope: its two ends and what it runs over
inline constexpr std::size_t kMaxPresented = 256;  ///< activities, questions of one, answers of one, views, effects
inline constexpr std::size_t kMaxJoints = 256;    ///< and as many couplings: the solver's tables grow with their square
inline constexpr std::size_t kMaxLanguages = 64;  ///< of one world's texts
inline constexpr std::size_t kMaxShownRopes = 8;  ///< displays draw the first ropes of a world
inline constexpr std::size_t kMaxEventsPerTick = 64;
inline constexpr std::size_t kMaxCommandsPerTick = 8;

}  // namespace mechane::state
