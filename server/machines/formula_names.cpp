#include "server/machines/formula_names.hpp"

#include <algorithm>
#include <string>

#include "server/machines/registry.hpp"

namespace mechane::machines {
namespace {

bool starts_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

std::size_t end_of_word(std::string_view text, std::size_t at) {
  while (at < text.size() && (starts_word(text[at]) || (text[at] >= '0' && text[at] <= '9')))
    ++at;
  return at;
}

}  // namespace

std::vector<FormulaName> names_in_formula(std::string_view text) {
  std::vector<FormulaName> names;
  for (std::size_t at = 0; at < text.size();) {
    // The "e3" of "1e3" is not a name.
    const bool digit = text[at] >= '0' && text[at] <= '9';
    const std::size_t end = std::max(end_of_word(text, at), at + 1);
    if (!digit && starts_word(text[at]) && end + 1 < text.size() && text[end] == '.' && starts_word(text[end + 1])) {
      const bool quantity = text.substr(at, end - at) == "quantity";
      const std::size_t after = end_of_word(text, end + 1);
      if (quantity)
        names.push_back({end + 1, after - end - 1, true});
      else
        names.push_back({at, end - at, false});
      at = after;
    } else {
      at = end;
    }
  }
  return names;
}

std::vector<std::string> quantities_in_formulas(const state::ComponentDescription& component) {
  std::vector<std::string> found;
  const auto types = registry();
  const auto type = std::ranges::find(types, component.type, &state::ComponentType::name);
  if (type == types.end()) return found;
  for (const state::ParameterType& parameter : type->parameters) {
    const auto* texts = component.written<std::vector<std::string>>(std::string(parameter.name));
    if (texts == nullptr || parameter.reference != state::Reference::expression) continue;
    for (const std::string& text : *texts) {
      for (const FormulaName& name : names_in_formula(text)) {
        std::string word = text.substr(name.begin, name.length);
        if (name.quantity && std::ranges::find(found, word) == found.end()) found.push_back(std::move(word));
      }
    }
  }
  return found;
}

}  // namespace mechane::machines
