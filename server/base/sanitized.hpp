// Whether this build's allocator and system calls are a sanitizer's.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define MECHANE_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define MECHANE_SANITIZED 1
#endif
#endif
#if !defined(MECHANE_SANITIZED)
#define MECHANE_SANITIZED 0
#endif

namespace mechane {

inline constexpr bool kSanitized = MECHANE_SANITIZED == 1;

}  // namespace mechane
