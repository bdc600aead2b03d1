#include "server/machines/machine_set.hpp"

#include "server/base/assert.hpp"
#include "server/machines/machine.hpp"

namespace mechane::machines {

struct MachineSet::Impl {
  std::vector<std::unique_ptr<Machine>> machines;
  bool linked = false;
};

MachineSet::MachineSet(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
MachineSet::~MachineSet() = default;

Expected<std::unique_ptr<MachineSet>> MachineSet::create(const state::WorldDescription& description,
                                                         state::MemoryLayout& layout) {
  auto impl = std::make_unique<Impl>();
  for (std::size_t i = 0; i < description.machines.size(); ++i) {
    auto machine = state::make_component(kinds(), "machine", description, description.machines, MachineId(i), layout);
    if (!machine) return tl::unexpected(machine.error());
    impl->machines.push_back(std::move(*machine));
  }
  return std::unique_ptr<MachineSet>(new MachineSet(std::move(impl)));
}

Expected<void> MachineSet::link(const state::MemoryLayout& layout) {
  MECHANE_ASSERT(!impl_->linked);
  for (const auto& machine : impl_->machines) {
    if (auto linked = machine->link(layout); !linked) return linked;
  }
  impl_->linked = true;
  return {};
}

void MachineSet::run(state::WorldState& state, double dt_s) const noexcept {
  MECHANE_ASSERT(impl_->linked);
  for (const auto& machine : impl_->machines)
    machine->run(state, dt_s);
}

}  // namespace mechane::machines
