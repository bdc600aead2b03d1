// Commands in remedies: `mechane content` as a person would type it, ready to be pasted into a shell.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace mechane::content {

/// The catalogue's path without --catalogue, relative to the current folder.
inline constexpr const char* kDefaultCatalogue = "scenarios/catalogue.db";

/// A word as a POSIX shell takes it: in quotes where it has blanks or characters that mean something to a shell.
[[nodiscard]] std::string shell_word(const std::string& word);

/// "mechane content add models/a.glb", with --catalogue where `catalogue` is not the default one. `word`: an argument, which is quoted
/// where need be; empty: none.
[[nodiscard]] std::string content_command(const std::filesystem::path& catalogue, std::string_view verb,
                                          const std::string& word = {});

/// The commands that put a damaged catalogue aside and make a new one from the files beside it.
[[nodiscard]] std::string remake_command(const std::filesystem::path& catalogue);

}  // namespace mechane::content
