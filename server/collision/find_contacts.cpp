#include <algorithm>

#include "server/collision/cluster_query.hpp"
#include "server/collision/object.hpp"

namespace mechane::collision {
namespace {

/// Makes contacts of samples that lie inside the target (T).
struct Reporter {
  const Object& source;
  const Pose& X_WT;
  bool target_is_a;
  ContactBuffer& out;

  void operator()(const InsideSample& sample) const noexcept {
    const Pose X_WQ = X_WT * sample.part->part->X_OQ;
    const Vec3 n_W = X_WQ.rotate(sample.n_Q.cast<double>());  // out of the target
    const std::uint16_t sample_part = source.clusters[sample.cluster].part;
    PointContact contact;
    contact.depth_m = sample.depth_m;
    if (target_is_a) {
      contact.p_WC = X_WQ * sample.p_Q.cast<double>();  // the sample itself lies on B's surface
      contact.n_BA_W = -n_W;
      contact.part_a = sample.part->index;
      contact.part_b = sample_part;
    } else {
      const Vec3f p_QS = sample.p_Q + sample.depth_m * sample.n_Q;
      contact.p_WC = X_WQ * p_QS.cast<double>();
      contact.n_BA_W = n_W;
      contact.part_a = sample_part;
      contact.part_b = sample.part->index;
    }
    out.add(contact);
  }
};

}  // namespace

void ContactBuffer::add(const PointContact& contact) noexcept {
  if (storage_.empty()) return;
  // A heap with the shallowest on top, once it is full: the one to beat.
  const auto deeper = [](const PointContact& l, const PointContact& r) { return l.depth_m > r.depth_m; };
  if (count_ < storage_.size()) {
    storage_[count_++] = contact;
    if (count_ == storage_.size()) std::make_heap(storage_.begin(), storage_.end(), deeper);
  } else if (contact.depth_m > storage_.front().depth_m) {
    std::pop_heap(storage_.begin(), storage_.end(), deeper);
    storage_.back() = contact;
    std::push_heap(storage_.begin(), storage_.end(), deeper);
  }
}

void find_contacts(const Object& a, const Pose& X_WA, const Object& b, const Pose& X_WB, ContactBuffer& out) noexcept {
  const Pose X_BA = X_WB.inverse() * X_WA;
  if (!overlap(b.bound_O, X_BA * a.bound_O.center, a.bound_O.radius)) return;
  ClusterQuery(a, X_BA, b, best_kernels(), Reporter{a, X_WB, false, out}).run();
  const Pose X_AB = X_BA.inverse();
  ClusterQuery(b, X_AB, a, best_kernels(), Reporter{b, X_WA, true, out}).run();
}

}  // namespace mechane::collision
