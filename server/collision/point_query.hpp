// The samples of one object asked against the parts of another: the query under find_contacts, for those who want depths alone.
#pragma once

#include <cstdint>
#include <span>

#include "server/collision/kernels.hpp"
#include "server/collision/object.hpp"

namespace mechane::collision {

/// What the target says of one sample.
struct SampleHit {
  float depth_m = 0;           ///< 0: outside
  Vec3f n_T = Vec3f::Zero();   ///< outward unit normal of the target's surface, in its frame T
};

/// Fills out[i] for the i-th sample of `source` (in the order of for_each_sample); `out` must hold them all. Allocates nothing. Any
/// thread.
void query_samples(const Object& source, const Pose& X_TS, const Object& target, std::span<SampleHit> out,
                   const Kernels& kernels = best_kernels()) noexcept;

}  // namespace mechane::collision
