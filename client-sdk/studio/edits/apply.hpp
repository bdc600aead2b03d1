// Commands applied to the text of an exhibit: all of them, or none.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "client-sdk/studio/edits/command.hpp"

namespace mechane::studio {

struct Applied {
  std::string text;
  std::vector<std::string> added;  ///< DEFs of what was inserted, duplicated, joined and kept as a view
};

/// A command that is refused.
struct Refused {
  std::size_t command = 0;  ///< its place in the list
  Error error;
};

/// `path`: the exhibit's file, as x3d::read_document(). Every byte that no command is about stays as it was. Any thread; reads no file.
[[nodiscard]] tl::expected<Applied, Refused> apply_commands(std::string_view text, const std::filesystem::path& path,
                                                            std::span<const Command> commands);

}  // namespace mechane::studio
