// A matcher for Errors: what kind of thing is wrong, in which line, and which names and numbers a person is told.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "server/base/error.hpp"

namespace mechane {

inline void PrintTo(ErrorCode code, std::ostream* out) {
  *out << name_of(code);
}
inline void PrintTo(const Error& error, std::ostream* out) {
  *out << name_of(error.code) << " in line " << error.line << ": " << error.to_string();
}

namespace test {

/// An Error of this code and line that has a remedy, and that holds each of `words` somewhere in its text.
inline testing::Matcher<const Error&> is_error(ErrorCode code, int line, const std::vector<std::string>& words = {}) {
  std::vector<testing::Matcher<std::string>> all;
  for (const std::string& word : words)
    all.emplace_back(testing::HasSubstr(word));
  return testing::AllOf(
      testing::Field("code", &Error::code, testing::Eq(code)), testing::Field("line", &Error::line, testing::Eq(line)),
      testing::Field("remedy", &Error::remedy, testing::Not(testing::IsEmpty())),
      testing::ResultOf([](const Error& error) { return error.to_string(); }, testing::AllOfArray(all)));
}

}  // namespace test
}  // namespace mechane
