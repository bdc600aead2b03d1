// What each of our threads does first.
#pragma once

#include <string_view>

namespace mechane {

/// Names the calling thread as `top -H` shows it (the first 15 bytes count), and leaves signals to the main thread: handling one here would
/// be a pause. Where a file grows over RLIMIT_FSIZE, write() then fails, instead of SIGXFSZ ending the process.
void set_up_thread(std::string_view name) noexcept;

}  // namespace mechane
