#include "server/log/command_line.hpp"

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "server/base/suggestion.hpp"

namespace mechane {
namespace {

/// The command that was given, with the words before it: "mechane visits show".
const CLI::App& given_command(const CLI::App& app, std::string& words) {
  words = app.get_name();
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    words += " " + command->get_name();
  }
  return *command;
}

/// The first unexpected word, without its value; an option before other words, which may be its values.
std::string unknown_word(const CLI::App& app) {
  const std::vector<std::string> left = app.remaining(true);
  const auto option = std::ranges::find_if(left, [](const std::string& word) { return word.starts_with('-'); });
  const std::string word = option != left.end() ? *option : left.empty() ? "" : left.front();
  return word.substr(0, std::min<std::size_t>(word.find('='), 80));
}

/// The names of the command's options, each after `dashes`.
std::vector<std::string> option_names(const CLI::App& command, const std::string& dashes) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames())
      names.push_back(dashes + name);
  return names;
}

/// What CLI11 says of a settings file, in words for a technician.
Error settings_file_error(const CLI::App& command, const std::string& words, const CLI::ParseError& fault) {
  const std::string said = fault.what();
  const std::string word = said.substr(said.rfind(' ') + 1);
  const std::string near = nearest(word, option_names(command, ""));
  return {ErrorCode::unknown_name, "the settings file has '" + word + "', which is not an option of this program",
          words,
          (near.empty() ? std::string() : "did you mean '" + near + "'? ") +
              "Write options without dashes, one a line, as in quality = \"cached\" (" + words + " --help lists them)"};
}

}  // namespace

Error command_line_error(const CLI::App& app, const CLI::ParseError& fault) {
  std::string words;
  const CLI::App& command = given_command(app, words);
  if (dynamic_cast<const CLI::ConfigError*>(&fault) != nullptr) return settings_file_error(command, words, fault);
  Error error{ErrorCode::invalid_value, fault.what(), words, "see " + words + " --help"};
  error.what.erase(std::min(error.what.find('\n'), error.what.size()));
  const std::string word = unknown_word(app);
  if (dynamic_cast<const CLI::ExtrasError*>(&fault) == nullptr || word.empty()) return error;
  const bool is_option = word.starts_with('-');
  std::vector<std::string> known;
  if (is_option) known = option_names(command, "--");
  for (const CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; }))
    if (!is_option) known.push_back(below->get_name());
  const std::string near = nearest(word, known);
  error.what = is_option ? "there is no option '" + word + "'" : "unexpected word '" + word + "'";
  if (!near.empty()) error.remedy = "did you mean '" + near + "'? (" + words + " --help lists them)";
  return error;
}

std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    std::cerr << command_line_error(app, e).to_string() << '\n';
    return 2;
  }
}

}  // namespace mechane
