// A driver of a maker's library, on a stand-in for that library.
#pragma once

#include <chrono>
#include <string>

#include <dlfcn.h>
#include <gtest/gtest.h>

#include "tests/support/driver_under_test.hpp"

namespace mechane::test {

/// `fake` is the stand-in's name: "dhd" is the shared object fake_dhd.so with fake_dhd_set(), fake_dhd_get() and fake_dhd_reset(). It is
/// there, and reset, from before the driver is opened until after it was closed.
class DriverOnFake : public ::testing::Test {
 public:
  ~DriverOnFake() override { let_go(); }

 protected:
  DriverOnFake(const std::string& driver, const std::string& fake)
      : driver_(driver),
        file_(std::string(MECHANE_TEST_FAKES "/fake_") + fake + ".so"),
        library_(::dlopen(file_.c_str(), RTLD_LAZY | RTLD_GLOBAL)) {
    if (library_ == nullptr) {
      ADD_FAILURE() << ::dlerror();
      return;
    }
    find(set_, "fake_" + fake + "_set");
    find(get_, "fake_" + fake + "_get");
    find(reset_, "fake_" + fake + "_reset");
    reset_();
  }
  void TearDown() override { driver_.close(); }
  void let_go() {
    if (library_ != nullptr) ::dlclose(library_);
    library_ = nullptr;
  }

  template <class Function>
  void find(Function& function, const std::string& name) {
    function = reinterpret_cast<Function>(::dlsym(library_, name.c_str()));
  }
  std::string open(const std::string& more = "") { return driver_.open("library=" + file_ + more); }
  std::string read() {
    state_ = {};
    return driver_.read(state_);
  }
  std::string push(double x, double y, double z) { return driver_.write(force_of(x, y, z)); }
  [[nodiscard]] static mechane_device_force force_of(double x, double y, double z) {
    mechane_device_force force{};
    force.force_n[0] = x, force.force_n[1] = y, force.force_n[2] = z;
    return force;
  }
  /// Whether the condition becomes true within a second while `step` is done again and again.
  template <class Condition, class Step>
  bool comes(const Condition& condition, const Step& step) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    while (!condition() && std::chrono::steady_clock::now() < deadline)
      step();
    return condition();
  }
  [[nodiscard]] bool ready() const { return (state_.flags & MECHANE_STATE_READY) != 0; }

  void (*set_)(const char*, double) = nullptr;
  double (*get_)(const char*) = nullptr;
  void (*reset_)() = nullptr;
  DriverUnderTest driver_;
  mechane_device_state state_{};
  const std::string file_;  // of the stand-in

 private:
  void* library_;
};

}  // namespace mechane::test
