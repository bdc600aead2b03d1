#include "server/machines/unit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "server/base/math.hpp"

namespace mechane::machines {
namespace {

struct UnitWord {
  std::string_view name;
  double factor;
  Dimension dimension;
  double offset = 0;
};

constexpr Dimension of_powers(int m, int kg, int s, int k = 0) {
  return {{2 * m, 2 * kg, 2 * s, 2 * k}};
}

constexpr UnitWord kUnitWords[] = {
    {"m", 1, of_powers(1, 0, 0)},
    {"cm", 0.01, of_powers(1, 0, 0)},
    {"mm", 0.001, of_powers(1, 0, 0)},
    {"km", 1000, of_powers(1, 0, 0)},
    {"l", 0.001, of_powers(3, 0, 0)},
    {"ml", 1e-6, of_powers(3, 0, 0)},
    {"kg", 1, of_powers(0, 1, 0)},
    {"g", 0.001, of_powers(0, 1, 0)},
    {"t", 1000, of_powers(0, 1, 0)},
    {"s", 1, of_powers(0, 0, 1)},
    {"ms", 0.001, of_powers(0, 0, 1)},
    {"min", 60, of_powers(0, 0, 1)},
    {"h", 3600, of_powers(0, 0, 1)},
    {"Hz", 1, of_powers(0, 0, -1)},
    {"rpm", 2 * kPi / 60, of_powers(0, 0, -1)},
    {"N", 1, of_powers(1, 1, -2)},
    {"kN", 1000, of_powers(1, 1, -2)},
    {"J", 1, of_powers(2, 1, -2)},
    {"kJ", 1000, of_powers(2, 1, -2)},
    {"W", 1, of_powers(2, 1, -3)},
    {"kW", 1000, of_powers(2, 1, -3)},
    {"Pa", 1, of_powers(-1, 1, -2)},
    {"kPa", 1000, of_powers(-1, 1, -2)},
    {"bar", 1e5, of_powers(-1, 1, -2)},
    {"K", 1, of_powers(0, 0, 0, 1)},
    {"degC", 1, of_powers(0, 0, 0, 1), 273.15},
    {"rad", 1, {}},
    {"deg", kPi / 180, {}},
    {"turns", 2 * kPi, {}},
    {"%", 0.01, {}},
};

const UnitWord* find_word(std::string_view name) {
  const auto* const it = std::ranges::find(kUnitWords, name, &UnitWord::name);
  return it == std::end(kUnitWords) ? nullptr : it;
}

/// What people call it, before the powers are written out.
constexpr std::pair<std::string_view, Dimension> kNamedUnits[] = {
    {"a pure number", {}},          {"N", kForceDimension},         {"N m", kTorqueDimension},
    {"W", of_powers(2, 1, -3)},     {"Pa", of_powers(-1, 1, -2)},   {"N/m", of_powers(0, 1, -2)},
    {"N s/m", of_powers(0, 1, -1)}, {"N m s", of_powers(2, 1, -1)},
};

constexpr std::pair<std::string_view, std::string_view> kRaisedDigits[] = {{"²", "2"}, {"³", "3"}};

/// Multiplies or divides `unit` by one of its words.
bool take_word(std::string_view word, int sign, Unit& unit) {
  const std::optional<Unit> next = word == "1" ? Unit{} : find_unit(word);
  if (!next || next->offset != 0) return false;
  unit.dimension = combined(unit.dimension, next->dimension, sign);
  unit.factor *= sign > 0 ? next->factor : 1 / next->factor;
  return is_sane(unit.dimension);
}

}  // namespace

Dimension combined(const Dimension& a, const Dimension& b, int sign) {
  Dimension out;
  for (std::size_t i = 0; i < out.halves.size(); ++i)
    out.halves[i] = a.halves[i] + sign * b.halves[i];
  return out;
}

std::optional<Dimension> raised(const Dimension& a, int twice) {
  Dimension out;
  for (std::size_t i = 0; i < out.halves.size(); ++i) {
    if (a.halves[i] * twice % 2 != 0) return std::nullopt;
    out.halves[i] = a.halves[i] * twice / 2;
  }
  return out;
}

bool is_sane(const Dimension& a) {
  return std::ranges::all_of(a.halves, [](int power) { return std::abs(power) <= kMostHalves; });
}

std::string in_words(const Dimension& a) {
  for (const auto& [name, dimension] : kNamedUnits) {
    if (dimension == a) return std::string(name);
  }
  static constexpr std::string_view kBases[] = {"m", "kg", "s", "K"};
  static constexpr std::size_t kOrder[] = {1, 0, 2, 3};  // kg m2/s3
  std::string over, under;
  for (const std::size_t i : kOrder) {
    const int halves = std::abs(a.halves[i]);
    if (halves == 0) continue;
    std::string word(kBases[i]);
    if (halves % 2 != 0)
      word += fmt::format("^{}", halves / 2.0);
    else if (halves != 2)
      word += fmt::format("{}", halves / 2);
    if (a.halves[i] > 0)
      over += (over.empty() ? "" : " ") + word;
    else
      under += "/" + word;
  }
  return (over.empty() ? "1" : over) + under;
}

std::optional<Unit> find_unit(std::string_view word) {
  if (const UnitWord* found = find_word(word)) return Unit{found->dimension, found->factor, found->offset};
  if (word.size() < 2 || word.back() < '2' || word.back() > '9') return std::nullopt;
  const int power = word.back() - '0';
  const UnitWord* found = find_word(word.substr(0, word.size() - 1));
  if (found == nullptr || found->offset != 0) return std::nullopt;
  Unit unit{*raised(found->dimension, 2 * power), 1, 0};
  for (int i = 0; i < power; ++i)
    unit.factor *= found->factor;
  if (!is_sane(unit.dimension)) return std::nullopt;
  return unit;
}

std::optional<Unit> parse_unit(std::string_view text) {
  if (text.empty()) return Unit{};
  if (const auto single = find_unit(text)) return single;
  Unit unit;
  int sign = 1;
  while (true) {
    const std::size_t end = std::min(text.find_first_of(" /"), text.size());
    std::string word(text.substr(0, end));
    if (const std::size_t hat = word.find('^'); hat != std::string::npos) word.erase(hat, 1);
    for (const auto& [raised, digit] : kRaisedDigits) {
      if (word.ends_with(raised)) word.replace(word.size() - raised.size(), raised.size(), digit);
    }
    if (!take_word(word, sign, unit)) return std::nullopt;
    if (end == text.size()) return unit;
    if (text[end] == '/') sign = -1;
    // "N/m s" could mean two things.
    if (text[end] == ' ' && sign < 0) return std::nullopt;
    text.remove_prefix(end + 1);
  }
}

std::string known_unit_words() {
  std::string words;
  for (const UnitWord& word : kUnitWords)
    words += (words.empty() ? "" : ", ") + std::string(word.name);
  return words;
}

}  // namespace mechane::machines
