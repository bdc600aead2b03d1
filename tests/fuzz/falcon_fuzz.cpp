// Whatever comes over USB from a Falcon, the driver gets answers that a board can give, and of them positions that its
// legs can reach, or none.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "client-sdk/drivers/falcon/frame.hpp"
#include "client-sdk/drivers/falcon/kinematics.hpp"

namespace {

using namespace mechane::drivers::falcon;

void must(bool held) {
  if (!held) std::abort();
}

void check(const Answer& answer) {
  must(answer.buttons < 16 && answer.homed < 8);
  Triple angles{}, position{}, again{}, torques{};
  for (std::size_t leg = 0; leg < 3; ++leg)
    angles[leg] = thigh_angle(answer.counts[leg]);
  if (!grip_position(angles, position)) return;
  for (const double part : position)
    must(std::abs(part) < 0.3);
  must(thigh_angles(position, again));
  for (std::size_t leg = 0; leg < 3; ++leg)
    must(std::abs(std::remainder(again[leg] - angles[leg], 6.283185307179586)) < 1e-3);
  if (!thigh_torques(angles, position, {1, 2, 3}, torques)) return;
  for (const double torque : torques)
    must(std::isfinite(torque));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span bytes(data, size);
  Answers whole, in_pieces;
  whole.add(bytes);
  for (std::size_t at = 0; at < size; at += 7) {
    in_pieces.add(bytes.subspan(at, std::min<std::size_t>(7, size - at)));
    check(in_pieces.newest());
  }
  must(whole.count() == in_pieces.count() && whole.noise() == in_pieces.noise());
  must(whole.newest().counts == in_pieces.newest().counts && whole.newest().homed == in_pieces.newest().homed);
  check(whole.newest());
  return 0;
}
