#include "client-sdk/drivers/dhd/api.hpp"

#include <algorithm>

#include "client-sdk/drivers/vectors.hpp"
#include "client-sdk/drivers/vendor_library.hpp"

namespace mechane::drivers::dhd {
namespace {

constexpr std::array kModels = {
    Model{63, "Force Dimension delta.3", 20, 0, 5000, 30, 0.15, false},
    Model{33, "Force Dimension omega.3", 12, 0, 5000, 30, 0.075, false},
    Model{34, "Force Dimension omega.6", 12, 0, 5000, 30, 0.075, true},
    Model{36, "Force Dimension omega.6", 12, 0, 5000, 30, 0.075, true},
    Model{35, "Force Dimension omega.7", 12, 0, 5000, 30, 0.075, true},
    Model{37, "Force Dimension omega.7", 12, 0, 5000, 30, 0.075, true},
    Model{104, "Force Dimension sigma.7", 12, 0.2, 4000, 30, 0.075, true},
    Model{105, "Force Dimension sigma.7", 12, 0.2, 4000, 30, 0.075, true},
    Model{108, "Force Dimension lambda.7", 12, 0.2, 8000, 30, 0.1125, true},
    Model{109, "Force Dimension lambda.7", 12, 0.2, 8000, 30, 0.1125, true},
    Model{60, "Novint Falcon", 8, 0, 3000, 20, 0.04, false},
};
constexpr Model kUnknown{-1, "Force Dimension device", 8, 0, 3000, 20, 0, false};

}  // namespace

std::string load(Api& api, const std::string& file) {
  VendorLibrary library;
  const std::vector<std::string> installed = {"libdrd.so.3", "libdrd.so", "/usr/local/lib/libdrd.so.3",
                                              "/usr/local/lib/libdrd.so"};
  if (std::string fault = library.load(file, installed); !fault.empty()) return fault;
  library.need(api.drd_open, "drdOpenID");
  library.need(api.drd_close, "drdClose");
  library.need(api.drd_is_initialized, "drdIsInitialized");
  library.need(api.drd_auto_init, "drdAutoInit");
  library.need(api.drd_stop, "drdStop");
  library.need(api.system_type, "dhdGetSystemType");
  library.need(api.gravity_compensation, "dhdSetGravityCompensation");
  library.need(api.brakes, "dhdSetBrakes");
  library.need(api.enable_force, "dhdEnableForce");
  library.need(api.status, "dhdGetStatus");
  library.need(api.position, "dhdGetPosition");
  library.need(api.orientation, "dhdGetOrientationFrame");
  library.need(api.buttons, "dhdGetButtonMask");
  library.need(api.set_force, "dhdSetForce");
  library.need(api.set_force_torque_grip, "dhdSetForceAndTorqueAndGripperForce");
  library.need(api.last_error, "dhdErrorGetLastStr");
  (void)library.want(api.max_force, "dhdGetMaxForce");
  return library.missing();
}

const Model& model_of(int type) noexcept {
  const auto found =
      std::find_if(kModels.begin(), kModels.end(), [type](const Model& model) { return model.type == type; });
  return found == kModels.end() ? kUnknown : *found;
}

bool orientation_to_d(const double (&m)[3][3], std::span<double, 4> wxyz) noexcept {
  const std::array<double, 9> by_rows = {m[1][1], m[1][2], m[1][0], m[2][1], m[2][2],
                                         m[2][0], m[0][1], m[0][2], m[0][0]};
  return quaternion_of(by_rows, wxyz);
}

}  // namespace mechane::drivers::dhd
