#include "client-sdk/drivers/vendor_library.hpp"

#include <dlfcn.h>

namespace mechane::drivers {

std::string VendorLibrary::load(const std::string& file, const std::vector<std::string>& installed) {
  std::string why;
  std::string tried;
  for (const std::string& one : file.empty() ? installed : std::vector{file}) {
    handle_ = ::dlopen(one.c_str(), RTLD_LAZY | RTLD_GLOBAL);  // global: the vendor's libraries look each other up
    if (handle_ != nullptr) {
      file_ = one;
      return {};
    }
    const char* error = ::dlerror();
    // A file that is there and does not load tells more than one that is not there.
    const bool there = error != nullptr && !std::string(error).starts_with(one + ": cannot open");
    if (error != nullptr && (why.empty() || there)) why = error;
    tried += (tried.empty() ? "" : ", ") + one;
  }
  return "the vendor's library does not load: " + why + " (tried: " + tried +
         "). Install the vendor's software, or give the file as library=PATH";
}

std::string VendorLibrary::missing() const {
  if (missing_.empty()) return {};
  return file_ + " is not the vendor's library, or another version of it: it lacks " + missing_ +
         ". Give the right file as library=PATH";
}

void* VendorLibrary::symbol(const char* name) {
  return handle_ == nullptr ? nullptr : ::dlsym(handle_, name);
}

}  // namespace mechane::drivers
