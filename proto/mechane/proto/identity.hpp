// What a program calls itself on the wire.
#pragma once

#include <cstdint>
#include <random>
#include <string>

#include <unistd.h>

namespace mechane::proto {

/// A session, an incarnation or a request: 63 random bits of the kernel's, never 0. Any thread.
[[nodiscard]] inline std::uint64_t random_id() {
  std::random_device device;
  const std::uint64_t high = device();
  return ((high << 32) | device()) | 1u;
}

/// This machine's name, up to 63 bytes; "unknown" where the system does not tell it. Any thread.
[[nodiscard]] inline std::string host_name() {
  char name[64] = {};
  return ::gethostname(name, sizeof(name) - 1) == 0 ? std::string(name) : std::string("unknown");
}

}  // namespace mechane::proto
