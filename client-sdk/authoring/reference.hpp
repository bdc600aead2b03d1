// The manual of the scenario format, made from the tables that the reader uses: schema.hpp, X3D's own, and those of the registered
// agents and machines. `mechane reference` prints it; a test compares it with its copy, scenarios/REFERENCE.md.
#pragma once

#include <string>

namespace mechane::authoring {

/// Markdown.
[[nodiscard]] std::string reference_page();

}  // namespace mechane::authoring
