// A driver's shared object, loaded and called as Mechane does it.
#pragma once

#include <array>
#include <string>

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <mechane/driver.h>

namespace mechane::test {

/// One device of the driver `name` of this build. Each function returns what went wrong; empty: nothing.
class DriverUnderTest {
 public:
  explicit DriverUnderTest(const std::string& name) {
    library_ = ::dlopen((MECHANE_TEST_DRIVERS "/mechane_driver_" + name + ".so").c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library_ == nullptr) {
      ADD_FAILURE() << ::dlerror();
      return;
    }
    const auto entry = reinterpret_cast<decltype(&mechane_driver)>(::dlsym(library_, "mechane_driver"));
    EXPECT_EQ(entry(MECHANE_DRIVER_VERSION + 1), nullptr);
    driver_ = entry(MECHANE_DRIVER_VERSION);
  }
  ~DriverUnderTest() {
    close();
    if (library_ != nullptr) ::dlclose(library_);
  }
  DriverUnderTest(const DriverUnderTest&) = delete;
  DriverUnderTest& operator=(const DriverUnderTest&) = delete;

  [[nodiscard]] std::string open(const std::string& options) {
    return fault(driver_->open(options.c_str(), &device_, why_.data(), why_.size()));
  }
  [[nodiscard]] std::string describe(mechane_device_info& info) {
    return fault(driver_->describe(device_, &info, why_.data(), why_.size()));
  }
  [[nodiscard]] std::string read(mechane_device_state& state) {
    return fault(driver_->read(device_, &state, why_.data(), why_.size()));
  }
  [[nodiscard]] std::string write(const mechane_device_force& force) {
    return fault(driver_->write(device_, &force, why_.data(), why_.size()));
  }
  void close() {
    if (device_ != nullptr) driver_->close(device_);
    device_ = nullptr;
  }

 private:
  std::string fault(int result) {
    if (result == 0) return {};
    EXPECT_STRNE(why_.data(), "") << "a fault without a word";
    return why_.data();
  }

  void* library_ = nullptr;
  const mechane_driver_table* driver_ = nullptr;
  void* device_ = nullptr;
  std::array<char, 256> why_{};
};

}  // namespace mechane::test
