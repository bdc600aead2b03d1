// What an exhibit's file says of itself: the <meta> elements of its head.
#pragma once

#include <string>

#include "client-sdk/studio/command.hpp"
#include "server/base/error.hpp"
#include "server/x3d/document.hpp"

namespace mechane::studio {

/// Writes the content of a <meta>, and makes the element and the head where there is none. Of several that say the same only this one
/// stays; where the value is empty, none. Errors: unknown_name, of a name that is none of scenario::same_meta_names().
[[nodiscard]] Expected<std::string> with_meta(const x3d::Document& document, const SetMeta& meta);

}  // namespace mechane::studio
