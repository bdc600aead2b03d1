// The text of node_types.txt, built in: read by schema.cpp alone.
#pragma once

#include <string_view>

namespace mechane::x3d {

[[nodiscard]] std::string_view node_types();

}  // namespace mechane::x3d
