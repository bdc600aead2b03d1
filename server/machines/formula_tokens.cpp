#include "server/machines/formula_tokens.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "server/machines/expression.hpp"

namespace mechane::machines {
namespace {

constexpr int kMostUnitPower = 9;

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// A byte within a letter of UTF-8 that takes several.
bool is_within_letter(char c) {
  return (static_cast<unsigned char>(c) & 0xc0u) == 0x80u;
}
/// The beginning of a text, for a message.
std::string_view beginning(std::string_view text) {
  std::size_t end = std::min<std::size_t>(text.size(), 200);
  while (end < text.size() && end > 0 && is_within_letter(text[end]))
    --end;
  return text.substr(0, end);
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back()))
    text.remove_suffix(1);
  return text;
}

}  // namespace

FormulaTokens::FormulaTokens(const FormulaText& text) : text_(text), at_(text.begin) {
  advance();
}

void FormulaTokens::advance() {
  last_end_ = token_.at + token_.text.size();
  while (at_ < text_.end && is_blank(text_.whole[at_]))
    ++at_;
  token_ = {Token::Kind::end, {}, at_, 0};
  if (at_ >= text_.end) return;
  const char c = text_.whole[at_];
  std::size_t length = 1;
  if (is_letter(c)) {
    token_.kind = Token::Kind::word;
    while (at_ + length < text_.end && (is_letter(text_.whole[at_ + length]) || is_digit(text_.whole[at_ + length])))
      ++length;
  } else if (is_digit(c) || c == '.') {
    length = read_number();
  } else {
    token_.kind = Token::Kind::sign;
    if ((c == '<' || c == '>') && at_ + 1 < text_.end && text_.whole[at_ + 1] == '=') length = 2;
    while (at_ + length < text_.end && is_within_letter(text_.whole[at_ + length]))
      ++length;
  }
  token_.text = text_.whole.substr(at_, length);
  at_ += length;
}

/// A dot that no digit follows is a sign.
std::size_t FormulaTokens::read_number() {
  const char* const begin = text_.whole.data() + at_;
  const auto read = std::from_chars(begin, text_.whole.data() + text_.end, token_.number);
  if (read.ec != std::errc() || !(std::abs(token_.number) <= kMostValue)) {
    token_.kind = Token::Kind::sign;
    return read.ptr == begin ? 1 : static_cast<std::size_t>(read.ptr - begin);
  }
  token_.kind = Token::Kind::number;
  return static_cast<std::size_t>(read.ptr - begin);
}

bool FormulaTokens::take(std::string_view text) {
  if (!is(text)) return false;
  advance();
  return true;
}
void FormulaTokens::expect(std::string_view text, std::string_view remedy) {
  if (error_ || take(text)) return;
  refuse(ErrorCode::invalid_value, token_.at,
         token_.kind == Token::Kind::end ? fmt::format("the formula ends before a '{}'", text)
                                         : fmt::format("'{}' stands where a '{}' is needed", token_.text, text),
         std::string(remedy));
}

/// Keeps the first error, and ends the text there.
void FormulaTokens::refuse(ErrorCode code, std::size_t at, const std::string& what, std::string remedy) {
  if (error_) return;
  error_ = Error{code, fmt::format("{}: {}, at letter {} of '{}'", text_.key, what, at + 1, beginning(text_.whole)),
                 text_.where.text, std::move(remedy), text_.where.line};
  token_ = {Token::Kind::end, {}, text_.end, 0};
  at_ = text_.end;
}

std::string_view FormulaTokens::piece(std::size_t from) const {
  return last_end_ > from ? text_.whole.substr(from, last_end_ - from) : std::string_view();
}

bool FormulaTokens::starts_operator() const {
  return is("and") || is("or") || is("not") || is("in");
}
/// A slash without blanks and a unit's word after it.
bool FormulaTokens::slash_of_unit() const {
  if (!is("/") || token_.at != last_end_ || at_ >= text_.end || !is_letter(text_.whole[at_])) return false;
  std::size_t end = at_;
  while (end < text_.end && (is_letter(text_.whole[end]) || is_digit(text_.whole[end])))
    ++end;
  const bool goes_on = end < text_.end && (text_.whole[end] == '.' || text_.whole[end] == '(');
  return !goes_on && find_unit(text_.whole.substr(at_, end - at_)).has_value();
}

std::string FormulaTokens::unit_text() {
  std::string text;
  bool divided = false;
  while (!error_) {
    if (slash_of_unit()) {
      advance();
      text += text.empty() ? "1/" : "/";
      divided = true;
    } else if ((token_.kind == Token::Kind::word && !starts_operator()) || (is("%") && text.empty())) {
      if (divided)
        refuse(ErrorCode::invalid_value, token_.at, "a word after a unit's slash could belong to either side",
               "write another slash before it, or '*' to multiply");
      if (!text.empty()) text += " ";
    } else {
      break;
    }
    text += token_.text;
    advance();
    if (is("^") && token_.at == last_end_ && text.back() != '%') text += power_of_unit();
    if ((is("²") || is("³")) && token_.at == last_end_) {
      text += token_.text;
      advance();
    }
  }
  return text;
}

/// "^2" or "^-1" of a unit's word; a negative one is written as the slash that it means.
std::string FormulaTokens::power_of_unit() {
  advance();
  if (token_.kind == Token::Kind::number && token_.number >= 2 && token_.number <= kMostUnitPower &&
      token_.text.size() == 1) {
    const std::string power(token_.text);
    advance();
    return power;
  }
  refuse(ErrorCode::invalid_value, token_.at, "the power of a unit is not a whole number from 2 to 9",
         "write 'm^2', or '1/s' in place of 's^-1'");
  return {};
}

const std::vector<std::string>& formula_functions() {
  static const std::vector<std::string> kNames = {"min", "max",  "abs",      "sqrt",  "sin", "cos", "clamp",
                                                  "if",  "step", "integral", "count", "sum", "last"};
  return kNames;
}

std::optional<FormulaStatement> split_statement(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) return std::nullopt;
  FormulaStatement out{std::string(trimmed(text.substr(0, equals))), equals + 1, text.size(), std::nullopt};
  for (std::size_t at = text.size(); at > out.begin + 3; --at) {
    if (!is_blank(text[at - 4]) || text.substr(at - 3, 2) != "in" || !is_blank(text[at - 1])) continue;
    out.end = at - 4;
    out.unit = std::string(trimmed(text.substr(at)));
    break;
  }
  return out;
}

bool is_formula_name(std::string_view word) {
  return !word.empty() && is_letter(word.front()) &&
         std::ranges::all_of(word, [](char c) { return is_letter(c) || is_digit(c); });
}

bool is_reserved(std::string_view word) {
  static constexpr std::string_view kWords[] = {"and", "or", "not", "in", "pi", "quantity", "faults"};
  return std::ranges::find(kWords, word) != std::end(kWords) || find_unit(word).has_value() ||
         std::ranges::find(formula_functions(), word) != formula_functions().end();
}

}  // namespace mechane::machines
