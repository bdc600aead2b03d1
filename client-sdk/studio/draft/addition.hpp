// Another exhibit added to a draft, with its own files.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "client-sdk/authoring/merge.hpp"
#include "client-sdk/studio/draft/archive.hpp"
#include "client-sdk/studio/draft/draft_files.hpp"
#include "server/base/error.hpp"
#include "server/x3d/document.hpp"

namespace mechane::studio {

struct Addition {
  std::string text;  ///< the draft's, with all of the other
  std::vector<authoring::MergeNote> notes;
  std::vector<ArchiveSource> files;  ///< the other's own, by the names that the text has
};

/// `theirs` in `ours`, both with the paths of their exhibits' files. What `theirs` names as files/NAME comes into the draft's `files`, by
/// another name where the draft has another file of that one; other paths are written anew, from the folder of `ours`. `place_of`: where
/// a path of `theirs` leads to; empty: there is no file. Errors: too_large; invalid_value, where the result cannot be read.
[[nodiscard]] Expected<Addition> addition_of(const x3d::Document& ours, const x3d::Document& theirs,
                                             const DraftFiles& files,
                                             const std::function<std::filesystem::path(const std::string&)>& place_of);

/// Puts files among a draft's, and then does `then`. Where either fails, the draft has the files that it had.
[[nodiscard]] Expected<void> put_files(const DraftFiles& files, const std::vector<ArchiveSource>& sources,
                                       const std::function<Expected<void>()>& then);

}  // namespace mechane::studio
