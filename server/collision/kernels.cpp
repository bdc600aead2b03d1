#include "server/collision/kernels.hpp"

#include <cstdlib>
#include <string_view>

#include "server/base/assert.hpp"

namespace mechane::collision {

const Kernels& portable_kernels() noexcept;
const Kernels* avx2_kernels() noexcept;    // null: not compiled in
const Kernels* avx512_kernels() noexcept;  // null: not compiled in

namespace {

const Kernels* compiled(InstructionSet set) noexcept {
  switch (set) {
    case InstructionSet::avx2:
      return avx2_kernels();
    case InstructionSet::avx512:
      return avx512_kernels();
    case InstructionSet::portable:
      break;
  }
  return &portable_kernels();
}

bool processor_has(InstructionSet set) noexcept {
#if defined(__x86_64__)
  if (set == InstructionSet::avx2) {
    return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  }
  if (set == InstructionSet::avx512) {
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0;
  }
#endif
  return set == InstructionSet::portable;
}

InstructionSet choose() noexcept {
  const char* asked = std::getenv("MECHANE_KERNELS");
  InstructionSet widest = InstructionSet::portable;
  for (const InstructionSet set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!is_supported(set)) continue;
    if (asked != nullptr && std::string_view(asked) == compiled(set)->name) return set;
    widest = set;
  }
  return widest;
}

}  // namespace

bool is_supported(InstructionSet set) noexcept {
  return compiled(set) != nullptr && processor_has(set);
}

const Kernels& kernels_of(InstructionSet set) noexcept {
  MECHANE_ASSERT(is_supported(set));
  return *compiled(set);
}

InstructionSet best_set() noexcept {
  static const InstructionSet kBest = choose();
  return kBest;
}

const Kernels& best_kernels() noexcept {
  return kernels_of(best_set());
}

}  // namespace mechane::collision
