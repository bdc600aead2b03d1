// Lines for the parameters of components in worlds that no file was read for.
#pragma once

#include <string>
#include <vector>

#include "server/state/description.hpp"

namespace mechane::test {

/// The line that number_lines() gives to every parameter of this name.
inline int line_of(const std::string& parameter) {
  unsigned sum = 0;
  for (const char letter : parameter)
    sum = 31 * sum + static_cast<unsigned char>(letter);
  return static_cast<int>(1000 + sum % 100'000);
}

/// Gives each written parameter a line, as a world that was read from a file has it.
inline void number_lines(std::vector<state::ComponentDescription>& components) {
  for (state::ComponentDescription& component : components) {
    for (const auto& [name, value] : component.parameters)
      component.parameter_lines[name] = line_of(name);
  }
}

}  // namespace mechane::test
