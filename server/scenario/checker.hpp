// `mechane check`: everything that can be wrong in a scenario and can be known without building its collision objects.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/scenario/compiler.hpp"
#include "server/x3d/problem.hpp"

namespace mechane::scenario {

/// All that reading and compiling finds, mesh files and their nodes among it (see mesh_finder.hpp), and what an author likely did not
/// mean: steps that no trigger leads to, triggers that no value can fire, texts that lack a language, activities without a visit,
/// bodies that nothing uses. Any thread; no network.
[[nodiscard]] std::vector<x3d::Problem> check(const std::filesystem::path& file);

enum class CheckFormat { text, json };

/// The same for a text that is not in a file yet: an authoring tool's. `file` is its name and the folder of its mesh files; `loader`
/// is a MeshFinder, or where that takes too long a FileFinder.
[[nodiscard]] std::vector<x3d::Problem> check_text(std::string_view text, const std::filesystem::path& file,
                                                   ObjectLoader& loader);

/// The body of `mechane check FILE...`: writes problems, two files of one id among them, and a last line that counts them (or one JSON array). Returns the program's exit
/// status: 0 without errors (warnings and notes are none), 1 with errors, 2 without files.
[[nodiscard]] int run_check(std::span<const std::string> files, std::ostream& out,
                            CheckFormat format = CheckFormat::text);

}  // namespace mechane::scenario
