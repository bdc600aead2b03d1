// The types of machines that a scenario can name.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "server/state/component_type.hpp"

namespace mechane::machines {

/// Every type, by name. Any thread.
[[nodiscard]] std::span<const state::ComponentType> registry();

/// A value that an author named; quantities read it as "<MACHINE>.<name>".
struct OwnValue {
  std::string name;
  std::string unit;  ///< as it is written; empty: a pure number
};

/// Those of one machine, beside its type's. Any thread.
[[nodiscard]] std::vector<OwnValue> own_values(const state::ComponentDescription& machine);

/// What MachineSet::create() would refuse of one machine.
struct MachineFault {
  MachineId machine;
  Error error;
};

/// Makes all machines and throws them away: the first fault of each that has one. Not in the tick.
[[nodiscard]] std::vector<MachineFault> check(const state::WorldDescription& description);

}  // namespace mechane::machines
