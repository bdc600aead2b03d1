// The kernels' one source, for lanes of any width: compiled once for each instruction set by kernels_*.cpp, which bring what
// C++ cannot say in vectors, or not so well (see PortableLanes). Includes nothing that is compiled elsewhere too: an inline function
// with this file's instructions must not be what a machine without them runs.
#pragma once

#include "server/collision/brick_kernels.hpp"
#include "server/collision/radial_kernels.hpp"

namespace mechane::collision {
namespace {

template <class Lanes>
struct KernelBody {
  static constexpr Kernels table(const char* name) {
    using Radial = RadialKernels<Lanes>;
    using Brick = BrickKernels<Lanes>;
    return {name,
            &Radial::radial_near,
            &Brick::brick_near,
            &Radial::radial_inside,
            &Brick::brick_inside,
            &Radial::radial_depth,
            &Brick::brick_depth};
  }
};

}  // namespace
}  // namespace mechane::collision
