// What a display no longer needs goes back to the system: a kiosk's display lives for months, and goes from exhibit to exhibit. For glibc;
// with another allocator these do nothing.
#pragma once

namespace mechane::display {

/// Once, first of all. glibc raises its threshold for blocks of their own with each that is freed, and keeps images and meshes in one heap
/// instead, which what lies between them holds up: through all exhibits and back it held some 130 MiB more.
void keep_large_blocks_apart();

/// When much was freed, as between two exhibits: pages of the heap that hold nothing. Some milliseconds. Any thread.
void give_spare_memory_back();

}  // namespace mechane::display
