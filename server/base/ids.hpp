// Identifiers that do not mix: a BodyId is not an AgentId. Each is an index into the table of its own kind.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>

namespace mechane {

/// An index into one kind of table. A default-made id is `none()`: it points at nothing and tests false.
template <class Tag>
class Id {
 public:
  constexpr Id() = default;
  constexpr explicit Id(std::size_t index) : value_(static_cast<std::uint32_t>(index)) {}
  [[nodiscard]] static constexpr Id none() { return {}; }
  [[nodiscard]] constexpr std::size_t index() const { return value_; }
  [[nodiscard]] constexpr explicit operator bool() const { return value_ != kNone; }
  friend constexpr auto operator<=>(Id, Id) =
      default;  // NOLINT(modernize-use-nullptr): it reads <=> as a comparison with 0

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t value_ = kNone;
};

using BodyId = Id<struct BodyTag>;
using JointId = Id<struct JointTag>;
using AgentId = Id<struct AgentTag>;
using MachineId = Id<struct MachineTag>;
using QuantityId = Id<struct QuantityTag>;
using StepId = Id<struct StepTag>;
using ActivityId = Id<struct ActivityTag>;

}  // namespace mechane
