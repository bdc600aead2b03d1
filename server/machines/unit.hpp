// Units as authors write them in formulas: "m", "l/min", "N m/rad", "kg/m^3". Angles are pure numbers, as in SI: rad is 1, deg is pi/180.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace mechane::machines {

/// What a number measures: powers of metre, kilogram, second and kelvin, counted in halves, for a square root may halve one.
struct Dimension {
  std::array<int, 4> halves{};

  friend bool operator==(const Dimension&, const Dimension&) = default;
  [[nodiscard]] bool is_number() const { return *this == Dimension{}; }
};

inline constexpr int kMostHalves = 24;  ///< of one power: beyond it no unit of nature lies, and sums stay small

inline constexpr Dimension kLengthDimension{{2, 0, 0, 0}};
inline constexpr Dimension kTimeDimension{{0, 0, 2, 0}};
inline constexpr Dimension kForceDimension{{2, 2, -4, 0}};
inline constexpr Dimension kTorqueDimension{{4, 2, -4, 0}};

/// Of a product (`sign` 1) or a quotient (-1).
[[nodiscard]] Dimension combined(const Dimension& a, const Dimension& b, int sign);
/// To the power of `twice` halves: 4 squares, 1 is the square root. None where that would halve a half.
[[nodiscard]] std::optional<Dimension> raised(const Dimension& a, int twice);
/// Whether each power is within kMostHalves.
[[nodiscard]] bool is_sane(const Dimension& a);
/// In SI units, as a person would write it: "N m", "m3/s", "kg m2/s3"; "a pure number".
[[nodiscard]] std::string in_words(const Dimension& a);

/// SI value = number * factor + offset.
struct Unit {
  Dimension dimension;
  double factor = 1;
  double offset = 0;  ///< of degC alone

  [[nodiscard]] double to_si(double number) const { return number * factor + offset; }
  [[nodiscard]] double from_si(double value) const { return (value - offset) / factor; }
};

/// One word of a unit: "l", "m3", "s2", "%". None where it is not known.
[[nodiscard]] std::optional<Unit> find_unit(std::string_view word);
/// A whole unit: words with a blank between them, then more after slashes; "" and "1" are a pure number. None where it is not one.
[[nodiscard]] std::optional<Unit> parse_unit(std::string_view text);
/// The words that find_unit() knows, for a remedy: "m, cm, ...".
[[nodiscard]] std::string known_unit_words();

}  // namespace mechane::machines
