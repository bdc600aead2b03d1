// The functions of the museum's own library (see shim.h), found at run time.
#pragma once

#include <string>

#include "client-sdk/drivers/cybergrasp/shim.h"

namespace mechane::drivers::cybergrasp {

struct Api {
  decltype(mechane_grasp_version)* version = nullptr;
  decltype(mechane_grasp_open)* open = nullptr;
  decltype(mechane_grasp_set_mode)* set_mode = nullptr;
  decltype(mechane_grasp_get_mode)* get_mode = nullptr;
  decltype(mechane_grasp_set_forces)* set_forces = nullptr;
  decltype(mechane_grasp_rewind)* rewind = nullptr;
  decltype(mechane_grasp_close)* close = nullptr;
  decltype(mechane_grasp_error)* error = nullptr;
  decltype(mechane_grasp_joints)* joints = nullptr;  // null: the library has no angles
  decltype(mechane_grasp_pose)* pose = nullptr;      // null: the library has no tracker
};

/// Returns a fault for a person; empty: loaded, and of the right version.
[[nodiscard]] std::string load(Api& api, const std::string& file);

}  // namespace mechane::drivers::cybergrasp
