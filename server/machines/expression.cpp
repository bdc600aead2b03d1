#include "server/machines/expression.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "server/base/assert.hpp"

namespace mechane::machines {
namespace {

Result finite(double value, bool fault) noexcept {
  if (std::abs(value) <= kMostValue) return {value, fault};
  return {std::isnan(value) ? 0.0 : std::copysign(kMostValue, value), true};
}

Result quotient(const Result& a, const Result& b) noexcept {
  if (b.value == 0) return {0, true};
  return finite(a.value / b.value, a.fault || b.fault);
}

Result raised_to(const Result& base, int power) noexcept {
  Result out{1, base.fault};
  for (int i = std::abs(power); i > 0; --i)
    out = finite(out.value * base.value, out.fault);
  return power < 0 ? quotient({1, false}, out) : out;
}

Result of_two(OpCode code, const Result& a, const Result& b) noexcept {
  const bool fault = a.fault || b.fault;
  switch (code) {
    case OpCode::add:
      return finite(a.value + b.value, fault);
    case OpCode::subtract:
      return finite(a.value - b.value, fault);
    case OpCode::multiply:
      return finite(a.value * b.value, fault);
    case OpCode::divide:
      return quotient(a, b);
    case OpCode::less:
      return {a.value < b.value ? 1.0 : 0.0, fault};
    case OpCode::less_equal:
      return {a.value <= b.value ? 1.0 : 0.0, fault};
    case OpCode::greater:
      return {a.value > b.value ? 1.0 : 0.0, fault};
    case OpCode::greater_equal:
      return {a.value >= b.value ? 1.0 : 0.0, fault};
    case OpCode::both:  // what stands after a condition that does not hold is not looked at
      return a.value == 0 ? a : Result{b.value, fault};
    case OpCode::either:
      return a.value != 0 ? a : Result{b.value, fault};
    case OpCode::least:
      return {std::min(a.value, b.value), fault};
    case OpCode::most:
      return {std::max(a.value, b.value), fault};
    default:
      return {};
  }
}

Result of_one(const Op& op, const Result& a) noexcept {
  switch (op.code) {
    case OpCode::negate:
      return {-a.value, a.fault};
    case OpCode::power:
      return raised_to(a, static_cast<int>(op.constant));
    case OpCode::opposite:
      return {a.value == 0 ? 1.0 : 0.0, a.fault};
    case OpCode::absolute:
      return {std::abs(a.value), a.fault};
    case OpCode::square_root:
      return a.value < 0 ? Result{0, true} : Result{std::sqrt(a.value), a.fault};
    case OpCode::sine:
      return finite(std::sin(a.value), a.fault);
    case OpCode::cosine:
      return finite(std::cos(a.value), a.fault);
    default:
      return {};
  }
}

/// Between the limits; the lower one where they are the wrong way round.
Result between_limits(double value, const Result& low, const Result& high, bool fault) noexcept {
  return {std::max(std::min(value, high.value), low.value), fault || low.fault || high.fault};
}

Result of_three(const Op& op, const Result* a, const Surroundings& around, double dt_s) noexcept {
  if (op.code == OpCode::select) {
    const Result& taken = a[0].value != 0 ? a[1] : a[2];
    return {taken.value, a[0].fault || taken.fault};
  }
  if (op.code == OpCode::clamp) return between_limits(a[0].value, a[1], a[2], a[0].fault);
  double& sum = around.memory[op.index];
  const Result moved = finite(sum + a[0].value * dt_s, a[0].fault);
  const Result kept = between_limits(moved.value, a[1], a[2], moved.fault);
  sum = kept.value;
  return kept;
}

Result counted(const Op& op, const Result& value, const Result& condition, const Surroundings& around,
               double dt_s) noexcept {
  double& total = around.memory[op.index];
  double& before = around.memory[op.index + 1];
  bool fault = condition.fault;
  if (dt_s > 0) {
    const double now = condition.fault ? 0 : condition.value;
    if (now != 0 && before == 0) {
      const Result next = finite(total + value.value, value.fault);
      total = next.value;
      fault = fault || next.fault;
    }
    before = now;
  }
  return finite(total, fault);
}

Result read(const Op& op, const Surroundings& around) noexcept {
  switch (op.code) {
    case OpCode::joint_position:
      return finite(around.joints[op.index].position, false);
    case OpCode::joint_velocity:
      return finite(around.joints[op.index].velocity, false);
    case OpCode::quantity:
      return finite(around.quantities[op.index] * op.constant + op.offset, false);
    case OpCode::value:
      return finite(around.memory[op.index], false);
    default:
      return {op.constant, false};
  }
}

}  // namespace

Result evaluate(std::span<const Op> ops, const Surroundings& around, double dt_s) noexcept {
  std::array<Result, kStackSize> stack;
  std::size_t depth = 0;
  for (const Op& op : ops) {
    const int takes = operands_of(op.code);
    MECHANE_ASSERT(depth >= static_cast<std::size_t>(takes));
    depth -= static_cast<std::size_t>(takes);
    Result* const a = stack.data() + depth;
    MECHANE_ASSERT(depth < kStackSize);
    if (takes == 0)
      *a = read(op, around);
    else if (takes == 1)
      *a = of_one(op, a[0]);
    else if (takes == 3)
      *a = of_three(op, a, around, dt_s);
    else
      *a = op.code == OpCode::sum ? counted(op, a[0], a[1], around, dt_s) : of_two(op.code, a[0], a[1]);
    ++depth;
  }
  MECHANE_ASSERT(depth <= 1);
  return depth == 1 ? stack[0] : Result{};
}

int operands_of(OpCode code) noexcept {
  switch (code) {
    case OpCode::constant:
    case OpCode::joint_position:
    case OpCode::joint_velocity:
    case OpCode::quantity:
    case OpCode::value:
      return 0;
    case OpCode::negate:
    case OpCode::power:
    case OpCode::opposite:
    case OpCode::absolute:
    case OpCode::square_root:
    case OpCode::sine:
    case OpCode::cosine:
      return 1;
    case OpCode::clamp:
    case OpCode::select:
    case OpCode::integral:
      return 3;
    default:
      return 2;
  }
}

}  // namespace mechane::machines
