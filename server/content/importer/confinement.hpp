// Takes from this process all rights that reading a mesh does not need.
#pragma once

#include <cstdint>

namespace mechane::content {

/// Limits memory, processor time and open files, forbids core dumps and new privileges. From then on the kernel refuses (EPERM) to start
/// programs, open sockets, trace other processes or open files for writing. This cannot be undone; call it once, before the first byte of a
/// foreign file is read. Under the address sanitizer, which needs terabytes of address space and system calls at its exit, memory and
/// system calls are not limited. False when the kernel refused a part of it.
[[nodiscard]] bool confine_this_process(std::uint64_t memory_bytes, std::uint32_t cpu_seconds);

}  // namespace mechane::content
