// The kernels' one source, for lanes of any width. Compiled once for each instruction set by kernels_*.cpp, which add what portable C++
// cannot express well in vectors (see PortableLanes). It includes nothing that is compiled elsewhere too: otherwise the linker could
// choose an inline function with this file's instructions for the whole program, and a machine without them would crash.
#pragma once

#include "server/collision/brick_kernels.hpp"
#include "server/collision/field_kernels.hpp"
#include "server/collision/radial_kernels.hpp"

namespace mechane::collision {
namespace {

template <class Lanes>
struct KernelBody {
  static constexpr Kernels table(const char* name) {
    using Radial = RadialKernels<Lanes>;
    using Brick = BrickKernels<Lanes>;
    using Field = FieldKernels<Lanes>;
    return {name,
            &Radial::radial_near,
            &Brick::brick_near,
            &Radial::radial_inside,
            &Brick::brick_inside,
            &Radial::radial_depth,
            &Brick::brick_depth,
            &Field::field_near,
            &Field::field_inside,
            &Field::field_depth,
            &Field::field_sift,
            &Field::field_hits,
            &Field::have_stayed};
  }
};

}  // namespace
}  // namespace mechane::collision
