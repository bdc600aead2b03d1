#include "tests/support/allocation_guard.hpp"

#include <cerrno>
#include <cstddef>

#include "server/base/sanitized.hpp"

namespace {

// Plain counters of the thread: no constructor runs, so they may be used before main().
thread_local constinit std::uint64_t allocation_count = 0;
thread_local constinit std::uint64_t free_count = 0;

}  // namespace

#if !MECHANE_SANITIZED
// glibc's own entry points, under the names that it keeps for interposers.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* memory);

void* malloc(std::size_t size) {
  ++allocation_count;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocation_count;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  ++allocation_count;
  return __libc_realloc(memory, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  ++allocation_count;
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocation_count;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
  ++allocation_count;
  void* memory = __libc_memalign(alignment, size);
  if (memory == nullptr) return ENOMEM;
  *out = memory;
  return 0;
}
void free(void* memory) {
  if (memory != nullptr) ++free_count;
  __libc_free(memory);
}
}
#endif

namespace mechane::test {

AllocationGuard::AllocationGuard() noexcept : allocations_at_start_(allocation_count), frees_at_start_(free_count) {}

std::uint64_t AllocationGuard::allocations() const noexcept {
  return allocation_count - allocations_at_start_;
}

std::uint64_t AllocationGuard::frees() const noexcept {
  return free_count - frees_at_start_;
}

bool AllocationGuard::available() noexcept {
  return !kSanitized;
}

}  // namespace mechane::test
