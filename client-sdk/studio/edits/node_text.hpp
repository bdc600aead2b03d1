// What edits write into a file: numbers as X3D has them, and lines with the margin of the place they go to.
#pragma once

#include <string>
#include <string_view>

#include "server/base/error.hpp"
#include "server/base/math.hpp"
#include "server/x3d/document.hpp"

namespace mechane::studio {

/// Without "-0", and without digits that nobody has set.
[[nodiscard]] std::string in_words(double number);
[[nodiscard]] std::string in_words(const Vec3& p);
/// As axis and angle.
[[nodiscard]] std::string in_words(const Quat& R);

/// A text of several lines, each with a margin more, the first one included.
[[nodiscard]] std::string with_margin(std::string_view text, const std::string& margin);

/// unknown_name: no element of that type (empty: of any) has the DEF.
[[nodiscard]] tl::unexpected<Error> no_such_node(const x3d::Document& document, const std::string& def,
                                                 std::string_view type);

}  // namespace mechane::studio
