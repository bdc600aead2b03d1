#include "client-sdk/drivers/openhaptics/api.hpp"

#include <array>
#include <cstdio>

#include "client-sdk/drivers/vendor_library.hpp"

namespace mechane::drivers::hd {

std::string load(Api& api, const std::string& file) {
  VendorLibrary library;
  const std::vector<std::string> installed = {"libHD.so", "libHD.so.3.4", "libHD.so.3.0", "/usr/lib64/libHD.so"};
  if (std::string fault = library.load(file, installed); !fault.empty()) return fault;
  library.need(api.init_device, "hdInitDevice");
  library.need(api.disable_device, "hdDisableDevice");
  library.need(api.begin_frame, "hdBeginFrame");
  library.need(api.end_frame, "hdEndFrame");
  library.need(api.get_boolean, "hdGetBooleanv");
  library.need(api.get_integer, "hdGetIntegerv");
  library.need(api.get_double, "hdGetDoublev");
  library.need(api.set_double, "hdSetDoublev");
  library.need(api.get_string, "hdGetString");
  library.need(api.enable, "hdEnable");
  library.need(api.get_error, "hdGetError");
  library.need(api.get_error_string, "hdGetErrorString");
  library.need(api.check_calibration, "hdCheckCalibration");
  library.need(api.update_calibration, "hdUpdateCalibration");
  library.need(api.start_scheduler, "hdStartScheduler");
  library.need(api.stop_scheduler, "hdStopScheduler");
  library.need(api.set_scheduler_rate, "hdSetSchedulerRate");
  library.need(api.schedule_asynchronous, "hdScheduleAsynchronous");
  library.need(api.unschedule, "hdUnschedule");
  return library.missing();
}

Errors pop_errors(const Api& api) noexcept {
  constexpr int kMost = 64;  // a stack that never ends must not hold the vendor's thread
  Errors errors;
  for (int i = 0; i < kMost; ++i) {
    const ErrorInfo error = api.get_error();
    switch (error.code) {
      case 0:
        return errors;
      case kWarmMotors:
        errors.warm = true;
        break;
      case kExceededMaxForce:
      case kExceededMaxForceImpulse:
      case kExceededMaxVelocity:
        break;  // the library stops the force and ramps it up again by itself
      default:
        errors.serious = error;  // the newest comes off first, so the cause is the last one
    }
  }
  return errors;
}

std::string in_words(const Api& api, const ErrorInfo& error) {
  if (error.code == 0) return "the library gives no reason";
  const char* text = api.get_error_string(error.code);
  std::array<char, 256> words{};
  std::snprintf(words.data(), words.size(), "'%s' (error 0x%03x, internal %d)",
                text == nullptr ? "unknown error" : text, error.code, error.internal);
  return words.data();
}

}  // namespace mechane::drivers::hd
