// `mechane check`: finds everything that is wrong in a scenario, short of what only building its collision objects would show.
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

/// All problems of reading and compiling, those of mesh files and their nodes included (see mesh_finder.hpp), and warnings of what an
/// author likely did not mean: steps that no trigger leads to, triggers that can never fire, texts that are missing in a language,
/// activities without a visit, bodies that fall, drift away or stay stuck. Any thread; no network.
[[nodiscard]] std::vector<x3d::Problem> check(const std::filesystem::path& file);

enum class CheckFormat { text, json };

/// The same for a text that is not saved yet, for authoring tools. `file` is its name, and its mesh files are found relative to that
/// file's folder; `loader` is a MeshFinder, or a FileFinder where that takes too long.
[[nodiscard]] std::vector<x3d::Problem> check_text(std::string_view text, const std::filesystem::path& file,
                                                   ObjectLoader& loader);

/// The body of `mechane check FILE...`: writes all problems, two files with the same id included, and a last line that counts them; or one
/// JSON array. Returns the program's exit status: 0 without errors (warnings and notes do not count), 1 with errors, 2 without files.
[[nodiscard]] int run_check(std::span<const std::string> files, std::ostream& out,
                            CheckFormat format = CheckFormat::text);

}  // namespace mechane::scenario
