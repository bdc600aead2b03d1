// What an exhibit's file says of itself: the <meta> elements of its head.
#pragma once

#include <string>

#include "client-sdk/studio/edits/command.hpp"
#include "server/base/error.hpp"
#include "server/x3d/document.hpp"

namespace mechane::studio {

/// Sets the content of a <meta>; adds the element, and the head, where they are missing. Where several elements have the same meaning, the
/// first is written and the others are removed; an empty value removes all of them. Errors: unknown_name, where
/// scenario::same_meta_names() does not know the name.
[[nodiscard]] Expected<std::string> with_meta(const x3d::Document& document, const SetMeta& meta);

}  // namespace mechane::studio
