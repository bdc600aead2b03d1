#include "client-sdk/drivers/cybergrasp/api.hpp"

#include "client-sdk/drivers/vendor_library.hpp"

namespace mechane::drivers::cybergrasp {

std::string load(Api& api, const std::string& file) {
  if (file.empty())
    return "the option library is missing. Build the library that Mechane's cybergrasp/shim.h describes with the "
           "maker's VirtualHand SDK, and give it as library=FILE";
  VendorLibrary library;
  if (std::string fault = library.load(file, {}); !fault.empty()) return fault;
  library.need(api.version, "mechane_grasp_version");
  library.need(api.open, "mechane_grasp_open");
  library.need(api.set_mode, "mechane_grasp_set_mode");
  library.need(api.get_mode, "mechane_grasp_get_mode");
  library.need(api.set_forces, "mechane_grasp_set_forces");
  library.need(api.rewind, "mechane_grasp_rewind");
  library.need(api.close, "mechane_grasp_close");
  library.need(api.error, "mechane_grasp_error");
  (void)library.want(api.joints, "mechane_grasp_joints");
  (void)library.want(api.pose, "mechane_grasp_pose");
  if (std::string missing = library.missing(); !missing.empty()) return missing;
  if (api.version() == MECHANE_GRASP_VERSION) return {};
  return file + " was built with version " + std::to_string(api.version()) + " of cybergrasp/shim.h, and not " +
         std::to_string(MECHANE_GRASP_VERSION) + ". Build it again with this Mechane's header";
}

}  // namespace mechane::drivers::cybergrasp
