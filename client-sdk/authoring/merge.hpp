// Merges several scenarios into one file. Where names clash, those of the later file change.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "server/base/error.hpp"
#include "server/x3d/problem.hpp"

namespace mechane::authoring {

struct Merged {
  std::string text;
  std::vector<std::string> notes;  ///< what was renamed and what was not kept, one line each
};

/// Merges files into one that will lie at `out` (paths of meshes and sounds are made relative to it; nothing is written). The first
/// file's head, title and effort scale are kept; agents, machines, quantities, activities, visits, effects, bodies and all other nodes
/// are taken from both. Machines keep their places, so two machines in the same place overlap. Errors: a file that cannot be read, fewer
/// than two files.
[[nodiscard]] Expected<Merged> merge_files(std::span<const std::string> files, const std::filesystem::path& out);

/// The body of `mechane merge FILE FILE... -o OUT`: merges, writes the result and checks it. Prints notes and problems. Returns the exit
/// status: 0; 1 where the result has errors (it is written all the same, so that its author can mend it); 2 where nothing was written.
[[nodiscard]] int run_merge(std::span<const std::string> files, const std::string& out_file, std::ostream& out);

}  // namespace mechane::authoring
