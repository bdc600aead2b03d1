#include "client-sdk/studio/draft/addition.hpp"

#include "client-sdk/studio/draft/bundle.hpp"
#include "client-sdk/studio/draft/draft.hpp"
#include "server/base/whole_file.hpp"

namespace mechane::studio {

namespace fs = std::filesystem;

Expected<Addition> addition_of(const x3d::Document& ours, const x3d::Document& theirs, const DraftFiles& files,
                               const std::function<fs::path(const std::string&)>& place_of) {
  const fs::path to = ours.path().parent_path().lexically_normal();
  const fs::path from = theirs.path().parent_path().lexically_normal();
  Bundle whole =
      bundle(theirs, {[&](const std::string& path) { return is_own_path(path) ? place_of(path) : ""; },
                      [&](const std::string& name, const fs::path& file) { return !files.has_other(name, file); },
                      [&](const std::string& path) { return authoring::rebased_path(path, from, to); }});
  x3d::Problems problems(theirs.path().string());
  const auto added = x3d::read_document(whole.text, theirs.path(), problems);
  if (!added) return tl::unexpected(added.error());
  Addition out;
  out.files = std::move(whole.files);
  auto both = authoring::merge_documents(ours, *added, out.notes);
  if (!both) return tl::unexpected(both.error());
  if (both->size() > Draft::kMostBytes)
    return fail(ErrorCode::too_large, "the draft would have more than 16 MiB", "", "add a smaller exhibit");
  out.text = std::move(*both);
  return out;
}

Expected<void> put_files(const DraftFiles& files, const std::vector<ArchiveSource>& sources,
                         const std::function<Expected<void>()>& then) {
  std::vector<std::string> added;
  Expected<void> done;
  for (const ArchiveSource& source : sources) {
    if (files.find(source.name)) continue;  // the same bytes
    const auto bytes = read_whole(source.path, DraftFiles::kMostBytes);
    done = bytes ? files.put(source.name, *bytes, false) : tl::unexpected(bytes.error());
    if (!done) break;
    added.push_back(source.name);
  }
  if (done) done = then();
  for (std::size_t i = 0; !done && i < added.size(); ++i)
    (void)files.remove(added[i]);
  return done;
}

}  // namespace mechane::studio
