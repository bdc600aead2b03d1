#include "client-sdk/drivers/serial_port.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

namespace mechane::drivers {
namespace {

constexpr std::array<std::pair<int, speed_t>, 7> kSpeeds{{{9600, B9600},
                                                          {19200, B19200},
                                                          {38400, B38400},
                                                          {57600, B57600},
                                                          {115200, B115200},
                                                          {230400, B230400},
                                                          {460800, B460800}}};

const speed_t* speed_of(int baud) {
  for (const auto& [bits, speed] : kSpeeds)
    if (bits == baud) return &speed;
  return nullptr;
}

std::string remedy_for(int error) {
  switch (error) {
    case ENOENT:
      return "; is the cable plugged in, and the option port right?";
    case EACCES:
      return "; add the user to the group that owns it (ls -l shows it; on Debian: dialout)";
    case EBUSY:
      return "; another program uses it";
    default:
      return "";
  }
}

std::string system_fault(const std::string& what, int error) {
  return what + ": " + std::strerror(error) + remedy_for(error);
}

bool set_up(int file, speed_t speed) {
  termios settings{};
  if (::tcgetattr(file, &settings) != 0) return false;
  ::cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  ::cfsetspeed(&settings, speed);
  return ::tcsetattr(file, TCSANOW, &settings) == 0 && ::tcflush(file, TCIOFLUSH) == 0;
}

}  // namespace

SerialPort::~SerialPort() {
  if (file_ >= 0) ::close(file_);
}

std::string SerialPort::open(const std::string& file, int baud) {
  const speed_t* const speed = speed_of(baud);
  if (speed == nullptr) return "a serial line has no speed of " + std::to_string(baud) + " baud";
  file_ = ::open(file.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (file_ < 0) return system_fault("cannot open " + file, errno);
  name_ = file;
  if (::isatty(file_) == 0) return file + " is not a serial line; is the option port right?";
  if (::flock(file_, LOCK_EX | LOCK_NB) != 0 || ::ioctl(file_, TIOCEXCL) != 0)
    return system_fault("cannot have " + file + " alone", errno == EWOULDBLOCK ? EBUSY : errno);
  if (!set_up(file_, *speed)) return system_fault(file + " is not a serial line", errno);
  return {};
}

std::string SerialPort::read(std::span<char> into, std::size_t& got) {
  got = 0;
  const ssize_t count = ::read(file_, into.data(), into.size());
  if (count > 0) got = static_cast<std::size_t>(count);
  if (count > 0 || (count < 0 && (errno == EAGAIN || errno == EINTR))) return {};
  // A raw line without bytes says EAGAIN (cfmakeraw sets VMIN to 1): 0 bytes are its end.
  return count == 0 ? name_ + " is gone; is the cable plugged in?" : system_fault(name_ + " is gone", errno);
}

std::string SerialPort::write(std::string_view text) {
  if (rest_.empty()) rest_ = text;  // else the line is slow: what is on its way goes first, and this text is dropped
  const ssize_t count = ::write(file_, rest_.data(), rest_.size());
  if (count > 0) rest_.erase(0, static_cast<std::size_t>(count));
  if (count >= 0 || errno == EAGAIN || errno == EINTR) return {};
  return system_fault(name_ + " is gone", errno);
}

}  // namespace mechane::drivers
