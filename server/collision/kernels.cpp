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
    case InstructionSet::avx2: return avx2_kernels();
    case InstructionSet::avx512: return avx512_kernels();
    case InstructionSet::portable: break;
  }
  return &portable_kernels();
}

bool processor_has(InstructionSet set) noexcept {
#if defined(__x86_64__)
  if (set == InstructionSet::avx2) return __builtin_cpu_supports("avx2") != 0;
  if (set == InstructionSet::avx512) {
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0;
  }
#endif
  return set == InstructionSet::portable;
}

const Kernels& choose() noexcept {
  const char* asked = std::getenv("MECHANE_KERNELS");
  const Kernels* widest = nullptr;
  for (const InstructionSet set : {InstructionSet::avx512, InstructionSet::avx2, InstructionSet::portable}) {
    if (!is_supported(set)) continue;
    const Kernels* found = compiled(set);
    if (asked != nullptr && std::string_view(asked) == found->name) return *found;
    if (widest == nullptr) widest = found;
  }
  return *widest;
}

}  // namespace

bool is_supported(InstructionSet set) noexcept {
  return compiled(set) != nullptr && processor_has(set);
}

const Kernels& kernels_of(InstructionSet set) noexcept {
  MECHANE_ASSERT(is_supported(set));
  return *compiled(set);
}

const Kernels& best_kernels() noexcept {
  static const Kernels& kBest = choose();
  return kBest;
}

}  // namespace mechane::collision
