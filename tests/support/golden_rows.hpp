// Accepted figures in a text file: rows of a name and numbers.
#pragma once

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/source_folder.hpp"

namespace mechane::test {

/// Expects the rows to be those of tests/golden/`file`, each number within `tolerance`. With MECHANE_ACCEPT_GOLDEN set it writes them.
inline void expect_accepted(const std::string& file, const std::vector<std::string>& rows, double tolerance) {
  const auto path = source_folder() / "tests/golden" / file;
  if (std::getenv("MECHANE_ACCEPT_GOLDEN") != nullptr) {
    std::ofstream out(path);
    for (const std::string& row : rows)
      out << row << "\n";
  }
  std::ifstream accepted(path);
  std::string row;
  std::size_t i = 0;
  for (; std::getline(accepted, row) && i < rows.size(); ++i) {
    std::istringstream was(row), is(rows[i]);
    std::string was_name, is_name;
    was >> was_name;
    is >> is_name;
    ASSERT_EQ(is_name, was_name);
    for (double before = 0, now = 0; was >> before && is >> now;)
      ASSERT_NEAR(now, before, tolerance)
          << "accepted: " << row << "\nnow:      " << rows[i]
          << "\nif it was meant to change, run this test once with MECHANE_ACCEPT_GOLDEN=1";
    ASSERT_EQ(was.eof(), is.eof()) << "as many numbers: " << row;
  }
  EXPECT_EQ(i, rows.size());
  EXPECT_TRUE(accepted.eof()) << "as many rows";
}

}  // namespace mechane::test
