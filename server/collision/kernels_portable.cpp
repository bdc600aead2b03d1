// The kernels for any machine: four lanes, which every x86-64 and ARM64 processor has.
#include "server/collision/kernel_body.hpp"

namespace mechane::collision {

const Kernels& portable_kernels() noexcept {
  static constexpr Kernels kTable = KernelBody<PortableLanes<4>>::table("portable");
  return kTable;
}

}  // namespace mechane::collision
