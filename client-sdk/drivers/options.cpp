#include "client-sdk/drivers/options.hpp"

#include <charconv>
#include <cmath>
#include <sstream>
#include <utility>

namespace mechane::drivers {
namespace {

/// "port=FILE hand=left|right": whether a word begins with `name=`.
bool knows(std::string_view known, const std::string& name) {
  std::istringstream words{std::string(known)};
  for (std::string word; words >> word;)
    if (word.starts_with(name + "=")) return true;
  return false;
}

}  // namespace

Options::Options(std::string_view text, std::string_view known) {
  std::istringstream list{std::string(text)};
  for (std::string entry; std::getline(list, entry, ',');) {
    const std::size_t equals = entry.find('=');
    const std::string name = entry.substr(0, equals);
    if (equals == std::string::npos || name.empty())
      note("the option '" + entry + "' is not NAME=VALUE");
    else if (!knows(known, name))
      note("there is no option '" + name + "'; there are: " + (known.empty() ? "none" : std::string(known)));
    else if (!values_.emplace(name, entry.substr(equals + 1)).second)
      note("the option '" + name + "' is given twice");
  }
}

void Options::note(std::string fault) {
  if (fault_.empty()) fault_ = std::move(fault);
}

std::string Options::text(const std::string& name, const std::string& otherwise) {
  const auto found = values_.find(name);
  return found == values_.end() ? otherwise : found->second;
}

double Options::number(const std::string& name, double otherwise, double least, double most) {
  const auto found = values_.find(name);
  if (found == values_.end()) return otherwise;
  const std::string& text = found->second;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc{} && end == text.data() + text.size() && value >= least && value <= most) return value;
  std::ostringstream range;
  range << least << " to " << most;
  note("the option " + name + "=" + text + " is not a number of " + range.str());
  return otherwise;
}

std::size_t Options::choice(const std::string& name, const std::vector<std::string>& choices) {
  const std::string chosen = text(name, choices.front());
  std::string list;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i] == chosen) return i;
    list += (list.empty() ? "" : ", ") + choices[i];
  }
  note("the option " + name + "=" + chosen + " is not one of " + list);
  return 0;
}

}  // namespace mechane::drivers
