// What this program is, for --version, the wire and the records.
#pragma once

namespace mechane::app {

inline constexpr const char* kVersion = MECHANE_VERSION;

}  // namespace mechane::app
