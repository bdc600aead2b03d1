// The output of `mechane exhibits`: a table, JSON.
#pragma once

#include <string>

#include <mechane/client/exhibits.hpp>

namespace mechane::cli {

/// A line for each exhibit, then what could be loaded.
[[nodiscard]] std::string exhibits_table(const client::ExhibitStatus& status);

/// One JSON object on a line.
[[nodiscard]] std::string exhibits_json(const client::ExhibitStatus& status);

}  // namespace mechane::cli
