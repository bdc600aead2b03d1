#include "server/machines/expression_parser.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "server/base/math.hpp"
#include "server/base/suggestion.hpp"
#include "server/machines/formula_tokens.hpp"

namespace mechane::machines {
namespace {

constexpr int kDeepest = 40;  // of brackets, functions and signs
constexpr int kMostPower = 9;

/// The type of a part of a formula.
struct Typed {
  Dimension dimension;
  bool condition = false;
  bool zero = false;  ///< a bare 0, which has any unit
};

std::string type_in_words(const Typed& type) {
  if (type.condition) return "is a condition";
  return (type.dimension.is_number() ? "is " : "is in ") + in_words(type.dimension);
}

bool alike(const Typed& a, const Typed& b) {
  return a.condition == b.condition && (a.zero || b.zero || a.dimension == b.dimension);
}

class FormulaParser : private FormulaTokens {
 public:
  FormulaParser(const FormulaText& text, const FormulaScope& scope) : FormulaTokens(text), scope_(scope) {}

  Expected<Expression> run() {
    const Typed type = condition();
    if (!error_ && token_.kind != Token::Kind::end)
      stop(ErrorCode::invalid_value, token_.at, fmt::format("'{}' is not expected here", token_.text),
           "write an operator between two numbers: + - * / ^ < <= > >= and or");
    if (!error_ && type.condition)
      stop(ErrorCode::conflict, text_.begin, "the result is a condition, not a number", "write step(...) around it");
    if (error_) return tl::unexpected(*error_);
    return Expression{std::move(ops_), type.dimension, type.zero};
  }

 private:
  Typed stop(ErrorCode code, std::size_t at, const std::string& what, std::string remedy) {
    refuse(code, at, what, std::move(remedy));
    return {};
  }

  // Programs.

  void put(const Op& op) {
    if (error_) return;
    depth_ += 1 - operands_of(op.code);
    ops_.push_back(op);
    if (depth_ > static_cast<int>(kStackSize) || ops_.size() > kMostSteps)
      stop(ErrorCode::too_large, token_.at, "the formula is too long",
           "make two values of it, and name the first in the second");
  }
  void put(OpCode code) { put(Op{code, 0, 0, 0}); }
  void put(OpCode code, std::size_t index) { put(Op{code, static_cast<std::uint32_t>(index), 0, 0}); }

  bool deeper() {
    if (++level_ <= kDeepest) return true;
    stop(ErrorCode::too_large, token_.at, fmt::format("more than {} brackets or signs in each other", kDeepest),
         "make a value of the inner part, and name it here");
    return false;
  }

  // Operators.

  /// One operator between parts of the same kind.
  struct Two {
    std::string_view sign;
    OpCode code;
  };
  const Two* taken(std::span<const Two> operators) {
    const auto it = std::ranges::find_if(operators, [&](const Two& two) { return is(two.sign); });
    if (it == operators.end()) return nullptr;
    advance();
    return &*it;
  }

  Typed mismatch(std::string_view sign, std::size_t left, const Typed& a, std::string_view left_text, std::size_t right,
                 const Typed& b) {
    return stop(
        ErrorCode::conflict, left,
        fmt::format("'{}' {}, but '{}' after the '{}' {}", left_text, type_in_words(a), piece(right), sign,
                    type_in_words(b)),
        fmt::format("both sides of '{}' must have the same unit: a constant takes its unit after it, as in '2 m'",
                    sign));
  }

  void need_condition(const Typed& type, std::size_t from) {
    if (error_ || type.condition) return;
    stop(ErrorCode::conflict, from, fmt::format("'{}' {}, not a condition", piece(from), type_in_words(type)),
         "compare it: write > or < and a limit after it");
  }
  void need_number(const Typed& type, std::size_t from) {
    if (error_ || !type.condition) return;
    stop(ErrorCode::conflict, from, fmt::format("'{}' is a condition, not a number", piece(from)),
         "write step(...) around it: 1 where it holds, else 0");
  }
  void need_pure(const Typed& type, std::size_t from, std::string_view function) {
    need_number(type, from);
    if (error_ || type.zero || type.dimension.is_number()) return;
    stop(ErrorCode::conflict, from,
         fmt::format("'{}' {}, but {} takes a pure number or an angle", piece(from), type_in_words(type), function),
         "divide it by a constant of that unit");
  }

  Typed condition() {
    if (!deeper()) return {};
    const std::size_t from = token_.at;
    Typed type = conjunction();
    while (is("or")) {
      need_condition(type, from);
      advance();
      const std::size_t right = token_.at;
      need_condition(conjunction(), right);
      put(OpCode::either);
    }
    --level_;
    return type;
  }

  Typed conjunction() {
    const std::size_t from = token_.at;
    Typed type = negation();
    while (is("and")) {
      need_condition(type, from);
      advance();
      const std::size_t right = token_.at;
      need_condition(negation(), right);
      put(OpCode::both);
    }
    return type;
  }

  Typed negation() {
    if (!take("not")) return comparison();
    if (!deeper()) return {};
    const std::size_t from = token_.at;
    const Typed type = negation();
    need_condition(type, from);
    put(OpCode::opposite);
    --level_;
    return type;
  }

  Typed comparison() {
    static constexpr Two kSigns[] = {
        {"<", OpCode::less}, {"<=", OpCode::less_equal}, {">", OpCode::greater}, {">=", OpCode::greater_equal}};
    const std::size_t left = token_.at;
    const Typed a = total();
    const std::string_view left_text = piece(left);
    const Two* const sign = taken(kSigns);
    if (sign == nullptr) return a;
    const std::size_t right = token_.at;
    const Typed b = total();
    need_number(a, left);
    need_number(b, right);
    if (!alike(a, b)) return mismatch(sign->sign, left, a, left_text, right, b);
    put(sign->code);
    return {{}, true, false};
  }

  Typed total() {
    static constexpr Two kSigns[] = {{"+", OpCode::add}, {"-", OpCode::subtract}};
    const std::size_t left = token_.at;
    Typed a = product();
    std::string_view left_text = piece(left);
    while (const Two* const sign = taken(kSigns)) {
      const std::size_t right = token_.at;
      const Typed b = product();
      need_number(a, left);
      need_number(b, right);
      if (!alike(a, b)) return mismatch(sign->sign, left, a, left_text, right, b);
      put(sign->code);
      a = {a.zero ? b.dimension : a.dimension, false, a.zero && b.zero};
      left_text = piece(left);
    }
    return a;
  }

  Typed product() {
    static constexpr Two kSigns[] = {{"*", OpCode::multiply}, {"/", OpCode::divide}};
    const std::size_t left = token_.at;
    Typed a = factor();
    while (const Two* const sign = taken(kSigns)) {
      const std::size_t right = token_.at;
      const Typed b = factor();
      need_number(a, left);
      need_number(b, right);
      put(sign->code);
      a = sane({combined(a.dimension, b.dimension, sign->code == OpCode::multiply ? 1 : -1), false, false}, left);
    }
    return a;
  }

  Typed factor() {
    if (!is("-")) return raised_item();
    if (!deeper()) return {};
    advance();
    const std::size_t from = token_.at;
    const Typed type = factor();
    need_number(type, from);
    put(OpCode::negate);
    --level_;
    return type;
  }

  Typed raised_item() {
    const std::size_t from = token_.at;
    const Typed base = item();
    if (!take("^")) return base;
    need_number(base, from);
    const int sign = take("-") ? -1 : 1;
    if (error_) return {};
    if (token_.kind != Token::Kind::number || token_.number != std::floor(token_.number) || token_.number > kMostPower)
      return stop(ErrorCode::invalid_value, token_.at, "a power is not a whole number",
                  fmt::format("write a whole number from {} to {} after '^', or use sqrt", -kMostPower, kMostPower));
    const int power = sign * static_cast<int>(token_.number);
    advance();
    put(Op{OpCode::power, 0, static_cast<double>(power), 0});
    return sane({*raised(base.dimension, 2 * power), false, false}, from);
  }

  Typed sane(const Typed& type, std::size_t from) {
    if (is_sane(type.dimension)) return type;
    return stop(ErrorCode::too_large, from, fmt::format("'{}' has a unit of too high a power", piece(from)),
                fmt::format("stay within the power {} of metres, kilograms and seconds", kMostHalves / 2));
  }

  // Items.

  Typed item() {
    if (error_) return {};
    const Token first = token_;
    if (first.kind == Token::Kind::number) return constant();
    if (take("(")) {
      const Typed type = condition();
      expect(")", "close the bracket");
      return type;
    }
    if (first.kind != Token::Kind::word) return missing_item(first);
    advance();
    if (is("(")) return function(first);
    if (first.text == "pi") {
      put(Op{OpCode::constant, 0, kPi, 0});
      return {};
    }
    if (take(".")) return first.text == "quantity" ? quantity(first.at) : joint(first);
    return value(first);
  }

  Typed missing_item(const Token& token) {
    if (token.kind == Token::Kind::end)
      return stop(ErrorCode::missing, token.at, "the formula ends where a number is needed",
                  "write a number, a name or a bracket after the last sign");
    return stop(ErrorCode::invalid_value, token.at, fmt::format("'{}' stands where a number is needed", token.text),
                "write a number, the name of a value, JOINT.angle, quantity.NAME, or a bracket");
  }

  Typed constant() {
    const double number = token_.number;
    const std::size_t from = token_.at;
    advance();
    const std::string text = unit_text();
    if (error_) return {};
    const auto unit = parse_unit(text);
    if (!unit)
      return stop(ErrorCode::unknown_name, from, fmt::format("'{}' is not a unit", text),
                  "write it of these words, with blanks between them and none at a slash, as in 'N m/rad': " +
                      known_unit_words());
    const double si = unit->to_si(number);
    if (!(std::abs(si) <= kMostValue))
      return stop(ErrorCode::too_large, from, fmt::format("'{}' is too large", piece(from)), "write a smaller number");
    put(Op{OpCode::constant, 0, si, 0});
    return {unit->dimension, false, number == 0 && text.empty()};
  }

  Typed joint(const Token& name) {
    const JointId id = scope_.world.find_joint(std::string(name.text));
    if (!id) return unknown_joint(name);
    const state::JointKind kind = scope_.world.joints[id.index()].kind;
    if (kind == state::JointKind::ball)
      return stop(ErrorCode::invalid_value, name.at,
                  fmt::format("'{}' is a ball joint, which has no one position", name.text),
                  "name a hinge or a slider");
    const std::string_view what = token_.text;
    const Dimension position = kind == state::JointKind::slider ? kLengthDimension : Dimension{};
    if (what == "position" || what == "angle") {
      put(OpCode::joint_position, id.index());
      advance();
      return {position, false, false};
    }
    if (what == "rate") {
      put(OpCode::joint_velocity, id.index());
      advance();
      return {combined(position, kTimeDimension, -1), false, false};
    }
    return stop(ErrorCode::unknown_name, token_.at, fmt::format("a joint has no '{}'", what),
                fmt::format("write {0}.angle, {0}.position or {0}.rate", name.text));
  }

  /// "TANK.level" for the value TANK_level of this machine is what quantities taught the author.
  Typed unknown_joint(const Token& name) {
    const std::string own = fmt::format("{}_{}", name.text, token_.text);
    if (std::ranges::find(scope_.values, own, &FormulaValue::name) != scope_.values.end())
      return stop(ErrorCode::unknown_name, name.at, fmt::format("no joint is called '{}'", name.text),
                  fmt::format("write {}: it is a value of this machine", own));
    return unknown(name.at, "joint", name.text, names_of(scope_.world.joints));
  }

  Typed quantity(std::size_t from) {
    const std::string name(token_.text);
    const QuantityId id = scope_.world.find_quantity(name);
    if (!id) return unknown(token_.at, "quantity", name, names_of(scope_.world.quantities));
    advance();
    const std::string& text = scope_.world.quantities[id.index()].unit;
    const auto unit = parse_unit(text);
    if (!unit)
      return stop(ErrorCode::unknown_name, from,
                  fmt::format("the unit '{}' of the quantity '{}' is not known here", text, name),
                  "give the quantity a unit of these words: " + known_unit_words());
    put(Op{OpCode::quantity, static_cast<std::uint32_t>(id.index()), unit->factor, unit->offset});
    return {unit->dimension, false, false};
  }

  Typed value(const Token& name) {
    const auto it = std::ranges::find(scope_.values, name.text, &FormulaValue::name);
    if (it == scope_.values.end()) {
      std::vector<std::string> known = formula_functions();
      for (const FormulaValue& each : scope_.values)
        known.push_back(each.name);
      return stop(ErrorCode::unknown_name, name.at, fmt::format("nothing is called '{}'", name.text),
                  suggest(std::string(name.text), known, "") +
                      "; of joints and quantities write JOINT.angle and quantity.NAME");
    }
    if (!it->read)
      return stop(ErrorCode::conflict, name.at, fmt::format("'{0}' is not computed yet", name.text),
                  fmt::format("write it before this one, or last({}) for what it was a tick ago", name.text));
    put(OpCode::value, it->slot);
    return {it->dimension, false, false};
  }

  Typed unknown(std::size_t at, std::string_view kind, std::string_view name, const std::vector<std::string>& known) {
    return stop(ErrorCode::unknown_name, at, fmt::format("no {} is called '{}'", kind, name),
                suggest(std::string(name), known, fmt::format("the scenario has no {}: add one", kind)));
  }

  template <class Items>
  static std::vector<std::string> names_of(const Items& items) {
    std::vector<std::string> names;
    names.reserve(items.size());
    for (const auto& item : items)
      names.push_back(item.name);
    return names;
  }

  // Functions.

  Typed function(const Token& name) {
    advance();
    const Typed type = call(name);
    expect(")", fmt::format("close the bracket of {}", name.text));
    return type;
  }

  Typed call(const Token& name) {
    const std::string_view f = name.text;
    if (f == "min" || f == "max") return least_or_most(f == "min" ? OpCode::least : OpCode::most);
    if (f == "abs" || f == "sqrt") return of_number(f);
    if (f == "sin" || f == "cos") return angle_function(f == "sin" ? OpCode::sine : OpCode::cosine, f);
    if (f == "clamp") return clamp();
    if (f == "if") return branch();
    if (f == "step") return as_number();
    if (f == "integral") return integral();
    if (f == "count" || f == "sum") return sum(f == "count");
    if (f == "last") return last();
    return unknown(name.at, "function", f, formula_functions());
  }

  /// The next part, of the same unit as `a`.
  Typed next_like(const Typed& a, std::size_t from, std::string_view function) {
    const std::string_view left = piece(from);
    expect(",", fmt::format("{} takes one more part", function));
    const std::size_t right = token_.at;
    const Typed b = condition();
    if (!error_ && !alike(a, b))
      return stop(ErrorCode::conflict, right,
                  fmt::format("'{}' {}, but '{}' {}", left, type_in_words(a), piece(right), type_in_words(b)),
                  fmt::format("what {} chooses among must have the same unit", function));
    return {a.zero ? b.dimension : a.dimension, a.condition, a.zero && b.zero};
  }

  Typed number_part() {
    const std::size_t from = token_.at;
    const Typed type = condition();
    need_number(type, from);
    return type;
  }

  Typed least_or_most(OpCode code) {
    const std::size_t from = token_.at;
    Typed type = number_part();
    do {
      type = next_like(type, from, code == OpCode::least ? "min" : "max");
      put(code);
    } while (is(","));
    return type;
  }

  Typed of_number(std::string_view name) {
    const std::size_t from = token_.at;
    Typed type = number_part();
    put(name == "abs" ? OpCode::absolute : OpCode::square_root);
    if (name == "abs" || error_) return type;
    const auto root = raised(type.dimension, 1);
    if (!root)
      return stop(ErrorCode::conflict, from,
                  fmt::format("'{}' {}, which has no square root", piece(from), type_in_words(type)),
                  "take the root of a product whose unit is a square");
    type.dimension = *root;
    return type;
  }

  Typed angle_function(OpCode code, std::string_view name) {
    const std::size_t from = token_.at;
    need_pure(condition(), from, name);
    put(code);
    return {};
  }

  Typed clamp() {
    const std::size_t from = token_.at;
    const Typed a = number_part();
    const Typed b = next_like(a, from, "clamp");
    const Typed c = next_like(b, from, "clamp");
    put(OpCode::clamp);
    return c;
  }

  Typed branch() {
    const std::size_t from = token_.at;
    need_condition(condition(), from);
    expect(",", "write if(CONDITION, THEN, ELSE)");
    const std::size_t then = token_.at;
    const Typed a = number_part();
    const Typed b = next_like(a, then, "if");
    put(OpCode::select);
    return b;
  }

  Typed as_number() {
    const std::size_t from = token_.at;
    need_condition(condition(), from);  // which is 1 or 0 already
    return {};
  }

  /// integral(RATE), integral(RATE, START), integral(RATE, START, LOW, HIGH)
  Typed integral() {
    const std::size_t from = token_.at;
    const Typed rate = number_part();
    const Typed result = sane({combined(rate.dimension, kTimeDimension, 1), false, rate.zero}, from);
    Typed type = result;
    double start = 0;
    if (take(",")) type = start_of(type, from, start);
    if (take(",")) {
      type = limit(type, from);
      expect(",", "write integral(RATE, START, LOW, HIGH)");
      type = limit(type, from);
    } else {
      put(Op{OpCode::constant, 0, -kMostValue, 0});
      put(Op{OpCode::constant, 0, kMostValue, 0});
    }
    put(OpCode::integral, scope_.memory.size());
    scope_.memory.push_back(start);
    return type;
  }

  Typed of_integral(const Typed& integral, const Typed& part, std::size_t from, std::size_t part_from) {
    need_number(part, part_from);
    if (!error_ && !alike(integral, part))
      return stop(ErrorCode::conflict, part_from,
                  fmt::format("'{}' {}, but the integral over time of '{}' {}", piece(part_from), type_in_words(part),
                              rate_text(from, part_from), type_in_words(integral)),
                  "an integral is in the unit of its rate times s, and so are its start and its limits");
    return {integral.zero ? part.dimension : integral.dimension, false, integral.zero && part.zero};
  }
  [[nodiscard]] std::string_view rate_text(std::size_t from, std::size_t to) const {
    const std::string_view text = text_.whole.substr(from, to - from);
    return text.substr(0, text.find_last_not_of(", \t\n\r") + 1);
  }

  Typed limit(const Typed& type, std::size_t from) {
    const std::size_t part = token_.at;
    return of_integral(type, condition(), from, part);
  }

  /// Reads a constant, which takes no part in the program.
  Typed start_of(const Typed& type, std::size_t from, double& start) {
    const std::size_t before = ops_.size();
    const std::size_t part = token_.at;
    const Typed out = of_integral(type, condition(), from, part);
    if (error_) return {};
    const std::span<const Op> ops = std::span(ops_).subspan(before);
    if (std::ranges::any_of(ops, [](const Op& op) {
          return op.code != OpCode::constant &&
                 (operands_of(op.code) == 0 || op.code == OpCode::integral || op.code == OpCode::sum);
        }))
      return stop(ErrorCode::conflict, part, fmt::format("the start '{}' is not a constant", piece(part)),
                  "write numbers with their units there");
    start = evaluate(ops, {}, 0).value;
    ops_.resize(before);
    --depth_;
    return out;
  }

  /// count(CONDITION), sum(VALUE, CONDITION)
  Typed sum(bool counts) {
    Typed type;
    if (counts) {
      put(Op{OpCode::constant, 0, 1, 0});
    } else {
      type = number_part();
      expect(",", "write sum(VALUE, CONDITION): the value is added each time that the condition becomes true");
    }
    const std::size_t from = token_.at;
    need_condition(condition(), from);
    put(OpCode::sum, scope_.memory.size());
    scope_.memory.push_back(0);
    scope_.memory.push_back(-1);
    return type;
  }

  Typed last() {
    const Token name = token_;
    const auto it = std::ranges::find(scope_.values, name.text, &FormulaValue::name);
    if (it == scope_.values.end()) return value(name);
    advance();
    if (it->read)
      return stop(ErrorCode::conflict, name.at, fmt::format("'{}' is computed before this one", name.text),
                  fmt::format("write {} without last()", name.text));
    if (!it->unit)
      return stop(
          ErrorCode::missing, name.at, fmt::format("the unit of '{}' is not written", name.text),
          fmt::format("end its formula with its unit, as in '{} = ... in m', so that last() knows it", name.text));
    put(OpCode::value, it->slot);
    return {it->unit->dimension, false, false};
  }

  const FormulaScope& scope_;
  std::vector<Op> ops_;
  int depth_ = 0;
  int level_ = 0;
};

}  // namespace

Expected<Expression> parse_expression(const FormulaText& text, const FormulaScope& scope) {
  if (text.whole.size() > kMostFormulaLetters)
    return fail(ErrorCode::too_large, fmt::format("{}: a formula has {} letters", text.key, text.whole.size()),
                text.where, fmt::format("make two values of it: {} letters at most", kMostFormulaLetters));
  return FormulaParser(text, scope).run();
}

bool fits(const Expression& expression, const Dimension& wanted) {
  return expression.zero || expression.dimension == wanted;
}

}  // namespace mechane::machines
