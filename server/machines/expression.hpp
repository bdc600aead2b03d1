// A formula as the tick runs it: a flat program over a fixed stack. It allocates nothing, and each of its results is a finite number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "server/machines/unit.hpp"
#include "server/state/world_state.hpp"

namespace mechane::machines {

inline constexpr double kMostValue = 1e30;       ///< the largest result, either sign; a larger one counts as a fault
inline constexpr std::size_t kStackSize = 64;    ///< numbers that wait at the same time
inline constexpr std::size_t kMostSteps = 2000;  ///< of one expression

enum class OpCode : std::uint8_t {
  constant,
  joint_position,
  joint_velocity,
  quantity,
  value,  ///< one of the machine's own, SI
  add,
  subtract,
  multiply,
  divide,
  negate,
  power,  ///< to the whole number in `constant`
  less,
  less_equal,
  greater,
  greater_equal,
  both,
  either,
  opposite,
  least,
  most,
  absolute,
  square_root,
  sine,
  cosine,
  clamp,
  select,
  integral,  ///< its sum is memory[index]
  sum,       ///< memory[index], and whether its condition held before: memory[index + 1], -1: not yet looked at
};

struct Op {
  OpCode code = OpCode::constant;
  std::uint32_t index = 0;
  double constant = 0;  ///< of `quantity`: its unit's factor
  double offset = 0;    ///< of `quantity`: its unit's offset
};

struct Expression {
  std::vector<Op> ops;
  Dimension dimension;
  bool zero = false;  ///< a bare 0, which has any unit
};

/// What expressions read and keep. `memory` is the machine's own.
struct Surroundings {
  std::span<const state::JointState> joints;
  std::span<const double> quantities;
  std::span<double> memory;
};

struct Result {
  double value = 0;
  bool fault = false;  ///< another number took the place of one that does not exist: see evaluate()
};

/// How many numbers it takes from the stack; it leaves one.
[[nodiscard]] int operands_of(OpCode code) noexcept;

/// Runs a program. A division by zero, the root of a negative number, and what is not a number give 0; what is beyond kMostValue is
/// that; each is a fault of the result, unless it comes from the branch of an if() that was not taken. With `dt_s` 0 no sum and no
/// integral moves. noexcept, no allocation; any thread that owns the memory.
[[nodiscard]] Result evaluate(std::span<const Op> ops, const Surroundings& around, double dt_s) noexcept;

}  // namespace mechane::machines
