#include "server/content/licence_note.hpp"

#include <fstream>
#include <string>
#include <string_view>

namespace mechane::content {

namespace fs = std::filesystem;

Credits read_licence_note(const fs::path& folder) {
  Credits credits;
  for (const char* name : {"LICENCE", "LICENSE"}) {
    std::error_code code;
    if (!fs::is_regular_file(folder / name, code)) continue;
    std::ifstream in(folder / name);
    for (std::string line; std::getline(in, line);) {
      const auto take = [&](std::string_view key, std::string& into) {
        const std::size_t at = line.find(key);
        if (at == std::string::npos || !into.empty()) return;
        const std::size_t first = line.find_first_not_of(" \t", at + key.size());
        if (first != std::string::npos) into = line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
      };
      take("SPDX-License-Identifier:", credits.licence);
      take("SPDX-FileCopyrightText:", credits.author);
    }
  }
  return credits;
}

}  // namespace mechane::content
