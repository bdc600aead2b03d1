// Remedies that can be pasted: `mechane content` as a person would type it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace mechane::content {

/// Where the catalogue is without --catalogue, from the folder that one is in.
inline constexpr const char* kDefaultCatalogue = "scenarios/catalogue.db";

/// A word as a POSIX shell takes it: in quotes where it holds blanks or what a shell would read.
[[nodiscard]] std::string shell_word(const std::string& word);

/// "mechane content add models/a.glb", with --catalogue where `catalogue` is not the default one. `word`: a file, as it is; empty: none.
[[nodiscard]] std::string content_command(const std::filesystem::path& catalogue, std::string_view verb,
                                          const std::string& word = {});

/// How a catalogue that cannot be read is put aside and made anew from the files beside it.
[[nodiscard]] std::string remake_command(const std::filesystem::path& catalogue);

}  // namespace mechane::content
