#include "server/collision/point_query.hpp"

#include <algorithm>

#include "server/collision/cluster_query.hpp"

namespace mechane::collision {

void query_samples(const Object& source, const Pose& X_TS, const Object& target, std::span<SampleHit> out,
                   const Kernels& kernels) noexcept {
  std::fill(out.begin(), out.end(), SampleHit{});
  if (!overlap(target.bound_O, X_TS * source.bound_O.center, source.bound_O.radius)) return;
  const auto sink = [&](const InsideSample& sample) {
    SampleHit& hit = out[source.clusters[sample.cluster].first_sample + sample.lane];
    if (hit.depth_m >= sample.depth_m) return;
    hit.depth_m = sample.depth_m;
    hit.n_T = sample.part->part->X_OQ.rotate(sample.n_Q.cast<double>()).cast<float>();
  };
  ClusterQuery(source, X_TS, target, kernels, sink).run();
}

}  // namespace mechane::collision
