// Whether this build's allocator and system calls are a sanitizer's, and whether that is the address sanitizer.
#pragma once

#if defined(__has_feature)
#define MECHANE_HAS_FEATURE(name) __has_feature(name)
#else
#define MECHANE_HAS_FEATURE(name) 0
#endif

#if defined(__SANITIZE_ADDRESS__) || MECHANE_HAS_FEATURE(address_sanitizer)
#define MECHANE_ADDRESS_SANITIZED 1
#else
#define MECHANE_ADDRESS_SANITIZED 0
#endif

#if MECHANE_ADDRESS_SANITIZED || defined(__SANITIZE_THREAD__) || MECHANE_HAS_FEATURE(thread_sanitizer) || \
    MECHANE_HAS_FEATURE(memory_sanitizer)
#define MECHANE_SANITIZED 1
#else
#define MECHANE_SANITIZED 0
#endif

namespace mechane {

inline constexpr bool kAddressSanitized = MECHANE_ADDRESS_SANITIZED == 1;
inline constexpr bool kSanitized = MECHANE_SANITIZED == 1;

}  // namespace mechane
