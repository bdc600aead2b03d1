// The text of node_types.txt, built in: only schema.cpp reads it.
#pragma once

#include <string_view>

namespace mechane::x3d {

[[nodiscard]] std::string_view node_types();

}  // namespace mechane::x3d
