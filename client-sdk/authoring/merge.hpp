// Merges several scenarios into one file. Where names clash, those of the later file change.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "server/base/error.hpp"
#include "server/x3d/document.hpp"

namespace mechane::authoring {

/// Something of a later file that is not in the result as that file has it.
struct MergeNote {
  enum class Kind : std::uint8_t {
    renamed,   ///< both files have the name `theirs`; in the result the later file's is `ours`
    not_kept,  ///< a scenario has only one such value: the first file's, `ours`
  };
  Kind kind = Kind::renamed;
  std::string
      what;  ///< "name" (DEF, agent, machine), "prototype", "export", "quantity", "activity", "step", ...; "gravity", "effortScale"
  std::string file;  ///< the later one
  std::string theirs;
  std::string ours;
};
/// One line for a terminal.
[[nodiscard]] std::string to_string(const MergeNote& note);

struct Merged {
  std::string text;
  std::vector<MergeNote> notes;
};

/// The text of `ours` with all of `theirs` added, as merge_files() does it. Their paths stay as they are. Errors: invalid_value, where what
/// is made cannot be read.
[[nodiscard]] Expected<std::string> merge_documents(const x3d::Document& ours, const x3d::Document& theirs,
                                                    std::vector<MergeNote>& notes);

/// Merges files into one that will lie at `out` (paths of meshes and sounds are made relative to it; nothing is written). The first
/// file's head, title and effort scale are kept; agents, machines, quantities, activities, visits, effects, bodies and all other nodes
/// are taken from both. Machines keep their places, so two machines in the same place overlap. Errors: a file that cannot be read, fewer
/// than two files.
[[nodiscard]] Expected<Merged> merge_files(std::span<const std::string> files, const std::filesystem::path& out);

/// The body of `mechane merge FILE FILE... -o OUT`: merges, writes the result and checks it. Prints notes and problems. Returns the exit
/// status: 0; 1 where the result has errors (it is written all the same, so that its author can mend it); 2 where nothing was written.
[[nodiscard]] int run_merge(std::span<const std::string> files, const std::string& out_file, std::ostream& out);

}  // namespace mechane::authoring
