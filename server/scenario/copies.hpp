// The names of the bodies that one RigidBody stands for, as they are written in a file.
#pragma once

#include <string>
#include <vector>

#include "server/x3d/document.hpp"

namespace mechane::scenario {

/// What the copy of that number is called: COIN-1 of COIN and 0.
[[nodiscard]] std::string copy_name(const std::string& name, std::size_t index);
/// COIN-1, COIN-2 ... by the `copies` of its mechane:body; none where it is one body, or where the count is faulty.
[[nodiscard]] std::vector<std::string> copies_in(const x3d::Document& document, x3d::NodeId body);

}  // namespace mechane::scenario
