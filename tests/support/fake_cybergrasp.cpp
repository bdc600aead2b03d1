// A stub of the library that a museum builds for its CyberGrasp (client-sdk/drivers/cybergrasp/shim.h). A test loads
// the same file and finds the fake_cybergrasp_* functions by name. No thread of its own.
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <string_view>

#include "client-sdk/drivers/cybergrasp/shim.h"

#define FAKE_CYBERGRASP extern "C" __attribute__((visibility("default")))

struct mechane_grasp {
  int unused;
};

namespace {

// What a test sets and reads, by name.
struct GraspCell {
  const char* name;
  double fresh;  // after fake_cybergrasp_reset()
  double value = fresh;
};
std::array grasp_cells = {
    // what it is, and what goes wrong
    GraspCell{"version", 1}, GraspCell{"absent", 0}, GraspCell{"slow_ms", 0}, GraspCell{"stays_in_mode", 0},
    // what it does now; every joint has the same angle
    GraspCell{"mode", 4}, GraspCell{"joints_come", 1}, GraspCell{"angle", 0}, GraspCell{"pose_comes", 0},
    GraspCell{"x", 0}, GraspCell{"w", 1},
    // what it was told
    GraspCell{"f0", 9}, GraspCell{"f1", 9}, GraspCell{"f2", 9}, GraspCell{"f3", 9}, GraspCell{"f4", 9},
    GraspCell{"sets", 0}, GraspCell{"rewound", 0}, GraspCell{"open", 0}, GraspCell{"host", 0}, GraspCell{"misuse", 0}};
mechane_grasp grasp_glove;

double& grasp_at(std::string_view name) {
  for (GraspCell& cell : grasp_cells)
    if (name == cell.name) return cell.value;
  std::abort();
}

/// The result of a call: -1 when the glove is not there.
int grasp_answer(const mechane_grasp* glove) {
  if (glove != &grasp_glove || grasp_at("open") != 1) ++grasp_at("misuse");
  const auto until =
      std::chrono::steady_clock::now() + std::chrono::milliseconds(static_cast<int>(grasp_at("slow_ms")));
  while (std::chrono::steady_clock::now() < until)
    ;
  return grasp_at("absent") != 0 ? -1 : 0;
}

}  // namespace

FAKE_CYBERGRASP void fake_cybergrasp_set(const char* name, double value) {
  grasp_at(name) = value;
}
FAKE_CYBERGRASP double fake_cybergrasp_get(const char* name) {
  return grasp_at(name);
}
FAKE_CYBERGRASP void fake_cybergrasp_reset() {
  for (GraspCell& cell : grasp_cells)
    cell.value = cell.fresh;
}

int mechane_grasp_version() {
  return static_cast<int>(grasp_at("version"));
}
mechane_grasp* mechane_grasp_open(const char* host) {
  grasp_at("host") = host != nullptr && std::string_view(host) == "grasp.museum" ? 1 : 0;
  if (grasp_at("absent") != 0) return nullptr;
  ++grasp_at("open");
  return &grasp_glove;
}
int mechane_grasp_set_mode(mechane_grasp* glove, int mode) {
  if (grasp_at("stays_in_mode") == 0) grasp_at("mode") = mode;
  return grasp_answer(glove);
}
int mechane_grasp_get_mode(mechane_grasp* glove, int* mode) {
  *mode = static_cast<int>(grasp_at("mode"));
  return grasp_answer(glove);
}
int mechane_grasp_set_forces(mechane_grasp* glove, const double forces[5]) {
  std::size_t finger = 0;
  for (const char* name : {"f0", "f1", "f2", "f3", "f4"})
    grasp_at(name) = forces[finger++];
  ++grasp_at("sets");
  if (grasp_at("stays_in_mode") == 0) grasp_at("mode") = MECHANE_GRASP_FORCE;  // as the maker's does
  return grasp_answer(glove);
}
int mechane_grasp_rewind(mechane_grasp* glove) {
  ++grasp_at("rewound");
  return grasp_answer(glove);
}
void mechane_grasp_close(mechane_grasp* glove) {
  (void)grasp_answer(glove);
  --grasp_at("open");
}
const char* mechane_grasp_error(mechane_grasp*) {
  return grasp_at("absent") != 0 ? "fake: no glove" : "";
}
int mechane_grasp_joints(mechane_grasp* glove, double joints_rad[20]) {
  for (int joint = 0; joint < 20; ++joint)
    joints_rad[joint] = grasp_at("angle");
  return grasp_answer(glove) < 0 ? -1 : static_cast<int>(grasp_at("joints_come"));
}
int mechane_grasp_pose(mechane_grasp* glove, double position_m[3], double wxyz[4]) {
  position_m[0] = grasp_at("x"), position_m[1] = position_m[2] = 0;
  wxyz[0] = grasp_at("w"), wxyz[1] = wxyz[2] = wxyz[3] = 0;
  return grasp_answer(glove) < 0 ? -1 : static_cast<int>(grasp_at("pose_comes"));
}
