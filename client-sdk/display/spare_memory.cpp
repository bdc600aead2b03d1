#include "client-sdk/display/spare_memory.hpp"

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace mechane::display {

void keep_large_blocks_apart() {
#ifdef __GLIBC__
  // So large are the blocks in which Mesa's rasteriser on the processor keeps a picture's triangles.
  (void)::mallopt(M_MMAP_THRESHOLD, 64 << 10);
  (void)::mallopt(M_TRIM_THRESHOLD, 1 << 20);
#endif
}

void give_spare_memory_back() {
#ifdef __GLIBC__
  (void)::malloc_trim(0);
#endif
}

}  // namespace mechane::display
