#include "server/machines/machine.hpp"

namespace mechane::machines {

Expected<void> Machine::link(const state::MemoryLayout& /*layout*/) {
  return {};
}

}  // namespace mechane::machines
