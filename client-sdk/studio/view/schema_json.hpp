// What may stand in an exhibit, as JSON, from the tables by which the server reads files: forms are made of it. COMMANDS.md has the form.
#pragma once

#include <string>

namespace mechane::studio {

/// Always the same. Any thread.
[[nodiscard]] std::string schema_json();

}  // namespace mechane::studio
