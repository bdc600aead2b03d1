// Counts what this thread allocates while the guard lives. Linking the library replaces malloc and its family in the whole test
// program, shared libraries included, by functions that count and go on to glibc's own.
#pragma once

#include <cstdint>

namespace mechane::test {

/// AllocationGuard guard; world.step(...); EXPECT_EQ(guard.allocations(), 0u);
/// Guards may nest. Under a sanitizer, which brings a malloc of its own, nothing is counted: see available().
class AllocationGuard {
 public:
  AllocationGuard() noexcept;
  AllocationGuard(const AllocationGuard&) = delete;
  AllocationGuard& operator=(const AllocationGuard&) = delete;

  /// Calls of malloc, calloc, realloc, aligned_alloc, posix_memalign, memalign (and so of operator new) since the guard was made.
  [[nodiscard]] std::uint64_t allocations() const noexcept;
  /// Calls of free with something to free.
  [[nodiscard]] std::uint64_t frees() const noexcept;
  /// False where allocations cannot be counted in this build.
  [[nodiscard]] static bool available() noexcept;

 private:
  std::uint64_t allocations_at_start_;
  std::uint64_t frees_at_start_;
};

}  // namespace mechane::test
