// OBJ text that assimp 5.2 reads without mistakes.
#pragma once

#include <string>
#include <string_view>

namespace mechane::content {

/// The same file without what assimp's parser misreads: it drops vertices silently, and then refuses the faces that use them. The parser
/// counts the numbers of a line by their first characters: '.1' is not a number for it, but a word of a comment may be one (assimp issue
/// 5890). It also ignores indented lines. In lines v, vn, vt and f, '.1' becomes '0.1' and comments are removed; no line is indented any
/// more. The number of lines stays the same.
[[nodiscard]] std::string plain_obj(std::string_view text);

}  // namespace mechane::content
