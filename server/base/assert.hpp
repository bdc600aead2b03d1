// MECHANE_ASSERT: for our own bugs, never for what comes from outside. It stays on in release builds: a server that goes on with
// a broken invariant can push somebody's hand; one that stops lets the client's governor bring the force to zero.
#pragma once

namespace mechane {

/// Writes the broken condition and its place to stderr, without allocating, and aborts.
[[noreturn]] void assertion_failed(const char* condition, const char* file, int line) noexcept;

}  // namespace mechane

#define MECHANE_ASSERT(condition) \
  (static_cast<bool>(condition) ? static_cast<void>(0) : ::mechane::assertion_failed(#condition, __FILE__, __LINE__))
