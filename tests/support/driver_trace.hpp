// What the fake driver (fake_driver.c) was given to render.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "server/base/clock.hpp"

namespace mechane::test {

struct DriverTrace {
  struct Written {
    std::int64_t at_ns;
    double force_n;
  };
  std::vector<Written> forces;
  int closed = 0;

  /// Empty when there is no such file yet.
  static DriverTrace read(const std::filesystem::path& file) {
    DriverTrace trace;
    std::ifstream bytes(file, std::ios::binary);
    for (Written w{}; bytes.read(reinterpret_cast<char*>(&w), sizeof(w));)
      w.at_ns < 0 ? void(++trace.closed) : trace.forces.push_back(w);
    return trace;
  }
  [[nodiscard]] double largest_n() const {
    double largest = 0;
    for (const Written& w : forces)
      largest = std::max(largest, w.force_n);
    return largest;
  }
};

/// The name of the fake device for DeviceName, with these options.
inline std::string fake_device(const std::string& options) {
  return MECHANE_TEST_DRIVERS "/mechane_driver_fake.so:" + options;
}

}  // namespace mechane::test
