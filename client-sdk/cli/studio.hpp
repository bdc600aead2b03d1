// `mechane studio`: edits an exhibit's file by commands, one JSON object a line, for scripts. client-sdk/studio/COMMANDS.md has their form.
#pragma once

#include <iosfwd>
#include <string>

namespace mechane::cli {

/// Reads requests from `in` until it ends, and answers each with one line on `out`; what is wrong with the file goes to `errors`. The file
/// changes only on {"do": "save"}. Returns the exit status: 0; 1 where a request was refused; 2 where the file cannot be read.
[[nodiscard]] int run_studio(const std::string& file, std::istream& in, std::ostream& out, std::ostream& errors);

}  // namespace mechane::cli
