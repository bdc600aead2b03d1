// Takes away from this process what reading a mesh does not need.
#pragma once

#include <cstdint>

namespace mechane::content {

/// Limits memory, processor time and open files, forbids core dumps and new privileges, and from then on refuses (EPERM) to start programs,
/// open sockets, trace others, or open any file for writing. For good; call it once, before the first byte of a foreign file is read.
/// The address sanitizer needs terabytes of address space and its own system calls at exit: under it, only processor time is limited.
/// False when the kernel refused a part of it.
[[nodiscard]] bool confine_this_process(std::uint64_t memory_bytes, std::uint32_t cpu_seconds);

}  // namespace mechane::content
