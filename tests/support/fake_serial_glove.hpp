// A glove at the other end of a serial line: a pseudo-terminal and a thread that plays the firmware.
#pragma once

#include <array>
#include <cerrno>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace mechane::test {

class FakeSerialGlove {
 public:
  /// Called on the glove's thread every millisecond or two: takes what the host has sent since, gives what the glove
  /// sends.
  using Firmware = std::function<std::string(std::string_view heard)>;

  explicit FakeSerialGlove(Firmware firmware) : firmware_(std::move(firmware)) {
    glove_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    std::array<char, 64> name{};
    EXPECT_TRUE(glove_ >= 0 && ::grantpt(glove_) == 0 && ::unlockpt(glove_) == 0 &&
                ::ptsname_r(glove_, name.data(), name.size()) == 0);
    port_ = name.data();
    // Held open, so that what the host says last can be read when it has gone; raw, or it would echo.
    host_ = ::open(port_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios settings{};
    EXPECT_EQ(::tcgetattr(host_, &settings), 0);
    ::cfmakeraw(&settings);
    EXPECT_EQ(::tcsetattr(host_, TCSANOW, &settings), 0);
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }
  ~FakeSerialGlove() { unplug(); }
  FakeSerialGlove(const FakeSerialGlove&) = delete;
  FakeSerialGlove& operator=(const FakeSerialGlove&) = delete;

  [[nodiscard]] const std::string& port() const { return port_; }
  void unplug() {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    thread_.join();
    ::close(host_);
    ::close(glove_);
  }

 private:
  void run(const std::stop_token& stop) {
    std::array<char, 4096> heard{};
    while (!stop.stop_requested()) {
      pollfd ready{glove_, POLLIN, 0};
      ::poll(&ready, 1, 2);
      const ssize_t count = ::read(glove_, heard.data(), heard.size());
      const std::string said = firmware_({heard.data(), count > 0 ? static_cast<std::size_t>(count) : 0});
      if (said.empty() || ::write(glove_, said.data(), said.size()) >= 0) continue;
      EXPECT_EQ(errno, EAGAIN) << "a host that does not read loses what comes meanwhile, as on a real line";
    }
  }

  Firmware firmware_;
  std::string port_;
  int glove_ = -1;
  int host_ = -1;
  std::jthread thread_;
};

}  // namespace mechane::test
