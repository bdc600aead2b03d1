// OBJ text as assimp 5.2 reads it rightly.
#pragma once

#include <string>
#include <string_view>

namespace mechane::content {

/// The same file without what assimp's parser takes amiss: it drops a vertex without a word, and then refuses the faces that name it.
/// It counts a line's numbers by their first characters, so that '.1' is not a number to it and each word of a comment behind them may be
/// one (assimp issue 5890); and it does not know a line that is indented. In lines v, vn, vt and f '.1' becomes '0.1' and comments
/// go; no line is indented. The count of lines stays.
[[nodiscard]] std::string plain_obj(std::string_view text);

}  // namespace mechane::content
