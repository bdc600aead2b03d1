// "Did you mean ...?": the known name that is closest to an unknown one.
#pragma once

#include <span>
#include <string>

namespace mechane {

/// The candidate nearest to `name` by edits, ignoring case; empty where none is near (more than a third of the letters differ).
[[nodiscard]] std::string nearest(const std::string& name, std::span<const std::string> candidates);

/// "did you mean X?" for a near candidate; else "use one of: X, Y, Z"; `if_none` where there are no candidates.
[[nodiscard]] std::string suggest(const std::string& name, std::span<const std::string> candidates,
                                  const std::string& if_none);

}  // namespace mechane
