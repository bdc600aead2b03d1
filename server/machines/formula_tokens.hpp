// The text of a formula as words, numbers and signs; its units; and the pieces of "NAME = FORMULA in UNIT".
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"

namespace mechane::machines {

/// A text to read: the part of `whole` from `begin` to `end`.
struct FormulaText {
  std::string_view whole;
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string_view key;  ///< the parameter, for errors
  Place where;
};

/// The pieces of "NAME = FORMULA in UNIT", as they stand; `unit` is empty where there is none.
struct FormulaStatement {
  std::string name;
  std::size_t begin = 0;  ///< of the formula in the text
  std::size_t end = 0;
  std::optional<std::string> unit;
};
/// None where there is no '='.
[[nodiscard]] std::optional<FormulaStatement> split_statement(std::string_view text);

/// Words that have a meaning of their own in formulas, and so cannot name a value.
[[nodiscard]] bool is_reserved(std::string_view word);
/// Letters, digits and '_', not a digit first.
[[nodiscard]] bool is_formula_name(std::string_view word);

/// What can be called with brackets after it.
[[nodiscard]] const std::vector<std::string>& formula_functions();

struct FormulaToken {
  enum class Kind { end, number, word, sign };
  Kind kind = Kind::end;
  std::string_view text;
  std::size_t at = 0;
  double number = 0;
};

/// Reads one word after the other, and keeps the first error: from then on the text is at its end.
class FormulaTokens {
 public:
  using Token = FormulaToken;

  /// The text outlives it.
  explicit FormulaTokens(const FormulaText& text);

 protected:
  void advance();
  [[nodiscard]] bool is(std::string_view text) const { return token_.kind != Token::Kind::end && token_.text == text; }
  bool take(std::string_view text);
  void expect(std::string_view text, std::string_view remedy);
  void refuse(ErrorCode code, std::size_t at, const std::string& what, std::string remedy);
  /// From there to the end of the token before this one.
  [[nodiscard]] std::string_view piece(std::size_t from) const;
  /// The text after a number up to the next operator: a unit, known or not.
  std::string unit_text();

  const FormulaText& text_;
  std::size_t at_;  // of the text behind the token
  Token token_;
  std::size_t last_end_ = 0;  // of the token before this one
  std::optional<Error> error_;

 private:
  std::size_t read_number();
  [[nodiscard]] bool starts_operator() const;
  [[nodiscard]] bool slash_of_unit() const;
  std::string power_of_unit();
};

}  // namespace mechane::machines
