// `mechane exhibits`: lists a running server's exhibits; loads, replaces and retires them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace mechane::cli {

struct ExhibitsOptions {
  std::string name;    ///< of the exhibit; for all verbs but list
  std::string server;  ///< empty: the only one that runs
  std::filesystem::path key = "out/records/exhibits.key";
  std::uint32_t domain = 0;
  double seconds = 300;  ///< how long the server may take to answer: fitting new parts takes minutes
  bool now = false;      ///< visits in progress end
  bool json = false;
};

/// `verb`: empty or "list", "load", "replace" or "retire". Returns the exit status: 0; 1 if the network cannot be joined, no server runs or
/// answers, or it refuses; 2 for a name or key that cannot be used.
[[nodiscard]] int run_exhibits(const std::string& verb, const ExhibitsOptions& options);

}  // namespace mechane::cli
