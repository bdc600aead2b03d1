#include "server/content/content_command.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace mechane::content {
namespace {

namespace fs = std::filesystem;

bool is_plain(unsigned char c) {
  return std::isalnum(c) != 0 || c >= 0x80 ||
         std::string_view("_-./+,:@%=").find(static_cast<char>(c)) != std::string_view::npos;
}

}  // namespace

std::string shell_word(const std::string& word) {
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word)
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string content_command(const fs::path& catalogue, std::string_view verb, const std::string& word) {
  std::string command = fmt::format("mechane content {}", verb);
  if (catalogue.lexically_normal() != kDefaultCatalogue) command += " --catalogue " + shell_word(catalogue.string());
  if (word.empty()) return command;
  return command + " " + (word.starts_with('-') ? shell_word("./" + word) : shell_word(word));
}

std::string remake_command(const fs::path& catalogue) {
  const fs::path folder = catalogue.parent_path().empty() ? fs::path(".") : catalogue.parent_path();
  return fmt::format("mv {} {} && {}", shell_word(catalogue.string()), shell_word(catalogue.string() + ".damaged"),
                     content_command(catalogue, "add", folder.string()));
}

}  // namespace mechane::content
