#include "server/base/assert.hpp"

#include <cstdio>
#include <cstdlib>

namespace mechane {

void assertion_failed(const char* condition, const char* file, int line) noexcept {
  std::fprintf(stderr, "mechane: broken invariant at %s:%d: %s\n", file, line, condition);
  std::abort();
}

}  // namespace mechane
