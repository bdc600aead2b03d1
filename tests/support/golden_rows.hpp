// Accepted figures in a text file: rows of a name and numbers.
#pragma once

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/source_folder.hpp"

namespace mechane::test {

inline std::vector<std::string> words_of(const std::string& row) {
  std::istringstream in(row);
  return {std::istream_iterator<std::string>(in), {}};
}

/// Expects the rows to be those of tests/golden/`file`, each number within `tolerance`. With MECHANE_ACCEPT_GOLDEN set it writes them.
inline void expect_accepted(const std::string& file, const std::vector<std::string>& rows, double tolerance) {
  const auto path = source_folder() / "tests/golden" / file;
  if (std::getenv("MECHANE_ACCEPT_GOLDEN") != nullptr) {
    std::ofstream out(path);
    for (const std::string& row : rows)
      out << row << "\n";
  }
  std::vector<std::string> accepted;
  std::ifstream in(path);
  for (std::string row; std::getline(in, row);)
    accepted.push_back(row);
  ASSERT_EQ(rows.size(), accepted.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto was = words_of(accepted[i]), is = words_of(rows[i]);
    const std::string both = "accepted: " + accepted[i] + "\nnow:      " + rows[i] +
                             "\nif it was meant to change, run this test once with MECHANE_ACCEPT_GOLDEN=1";
    ASSERT_EQ(is.size(), was.size()) << both;
    ASSERT_EQ(is.at(0), was.at(0)) << both;
    for (std::size_t k = 1; k < is.size(); ++k)
      ASSERT_NEAR(std::stod(is[k]), std::stod(was[k]), tolerance) << both;
  }
}

}  // namespace mechane::test
