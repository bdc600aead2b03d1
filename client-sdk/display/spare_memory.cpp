#include "client-sdk/display/spare_memory.hpp"

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace mechane::display {

void keep_large_blocks_apart() {
#ifdef __GLIBC__
  // Mesa's software rasteriser takes and frees a picture's triangles in blocks of 64 KiB. They have to stay in the heap: as mappings of
  // their own, or from a heap that shrinks after each picture, the system clears their pages each time, which took four fifths of a
  // picture.
  (void)::mallopt(M_MMAP_THRESHOLD, 128 << 10);
  (void)::mallopt(M_TRIM_THRESHOLD, 16 << 20);
#endif
}

void give_spare_memory_back() {
#ifdef __GLIBC__
  (void)::malloc_trim(0);
#endif
}

}  // namespace mechane::display
