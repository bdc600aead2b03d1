// Returns memory that a display no longer needs to the system: it runs for months and changes its exhibits. For glibc;
// with another allocator these functions do nothing.
#pragma once

namespace mechane::display {

/// Call it once, at the start. glibc raises its mmap threshold with each freed block, and then keeps images and meshes
/// in its heap, which small blocks between them prevent from shrinking: after all exhibits it held about 130 MiB more.
void keep_large_blocks_apart();

/// Returns empty pages of the heap. Call it when much was freed, as between two exhibits. Takes some milliseconds. Any
/// thread.
void give_spare_memory_back();

}  // namespace mechane::display
