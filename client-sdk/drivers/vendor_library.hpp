// A vendor's shared library, found at run time: none is linked, shipped or needed to build.
#pragma once

#include <string>
#include <vector>

namespace mechane::drivers {

/// Loaded once and never unloaded, for vendors' drivers fail when they are loaded a second time into one process. One
/// thread.
class VendorLibrary {
 public:
  /// Loads `file`, which the technician gave; where it is empty, the first of `installed` that loads. Both are paths, or
  /// names for the system's search path. Returns why none loads, with the names tried; empty when one does.
  [[nodiscard]] std::string load(const std::string& file, const std::vector<std::string>& installed);

  /// Sets `function` to the library's function of that name; a name that it lacks is noted in missing().
  template <class Function>
  void need(Function*& function, const char* name) {
    if (!want(function, name)) missing_ += (missing_.empty() ? "" : ", ") + std::string(name);
  }
  /// The same for a function that the driver can do without: null where the library lacks it.
  template <class Function>
  bool want(Function*& function, const char* name) {
    function = reinterpret_cast<Function*>(symbol(name));
    return function != nullptr;
  }

  /// What need() asked for in vain, as a fault for a person; empty: nothing.
  [[nodiscard]] std::string missing() const;

 private:
  void* symbol(const char* name);

  void* handle_ = nullptr;
  std::string file_;
  std::string missing_;
};

}  // namespace mechane::drivers
