#include "client-sdk/drivers/vendor_library.hpp"

#include <dlfcn.h>

namespace mechane::drivers {

std::string VendorLibrary::load(const std::vector<std::string>& files) {
  std::string why;
  std::string tried;
  for (const std::string& file : files) {
    handle_ = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_GLOBAL);  // global: the vendor's libraries look each other up
    if (handle_ != nullptr) {
      file_ = file;
      return {};
    }
    const char* error = ::dlerror();
    // A file that is there and does not load tells more than one that is not there.
    const bool there = error != nullptr && !std::string(error).starts_with(file + ": cannot open");
    if (error != nullptr && (why.empty() || there)) why = error;
    tried += (tried.empty() ? "" : ", ") + file;
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
