#include "server/haptics/contact_patch.hpp"

#include <algorithm>

namespace mechane::haptics {
namespace {

bool is_of(const state::Contact& contact, const ContactPatch& patch) {
  return patch.body == contact.body && patch.segment == contact.segment;
}

/// Contacts of one segment with one body. The sums are kept beside the patch: in memory, each addition would wait for the last one.
void add_sums(std::span<const state::Contact> contacts, ContactPatch& patch, double& depth_sum_m) {
  Vec3 push_m = patch.push_m, p_WC = patch.p_WC;
  double sum_m = depth_sum_m, deepest_m = patch.deepest_m;
  for (const state::Contact& contact : contacts) {
    const double S = contact.depth_m;
    sum_m += S;
    push_m += S * S * contact.n_BH_W;
    p_WC += S * contact.p_WC;
    deepest_m = std::max(deepest_m, S);
  }
  patch.push_m = push_m;
  patch.p_WC = p_WC;
  patch.deepest_m = deepest_m;
  patch.points += static_cast<std::uint32_t>(contacts.size());
  depth_sum_m = sum_m;
}

void divide_sums(ContactPatch& patch, double depth_sum_m) {
  if (depth_sum_m <= 0) return;
  patch.push_m /= depth_sum_m;
  patch.p_WC /= depth_sum_m;
  patch.depth_m = patch.found_depth_m = patch.push_m.norm();
  // Points on both sides of a thin segment can cancel each other: a push of zero has no direction.
  if (patch.depth_m > 0) patch.n_BH_W = patch.push_m / patch.depth_m;
}

ContactPatch empty_patch(const state::Contact& of) {
  ContactPatch patch;
  patch.body = of.body;
  patch.segment = of.segment;
  return patch;
}

}  // namespace

void gather_patches(std::span<const state::Contact> contacts, ContactPatches& patches) noexcept {
  boost::container::static_vector<double, kMaxPatches> depth_sums_m;
  while (!contacts.empty()) {  // those of a patch mostly follow one another
    const state::Contact& first = contacts.front();
    const auto end = std::ranges::find_if(
        contacts, [&](const state::Contact& c) { return c.body != first.body || c.segment != first.segment; });
    const auto run = contacts.first(static_cast<std::size_t>(end - contacts.begin()));
    contacts = contacts.subspan(run.size());
    auto patch = std::ranges::find_if(patches, [&](const ContactPatch& known) { return is_of(first, known); });
    if (patch == patches.end()) {
      if (patches.size() == patches.capacity()) break;
      patches.push_back(empty_patch(first));
      depth_sums_m.push_back(0);
      patch = patches.end() - 1;
    }
    add_sums(run, *patch, depth_sums_m[static_cast<std::size_t>(patch - patches.begin())]);
  }
  for (std::size_t i = 0; i < patches.size(); ++i)
    divide_sums(patches[i], depth_sums_m[i]);
}

ContactPatch patch_of(std::span<const state::Contact> contacts) noexcept {
  if (contacts.empty()) return {};
  ContactPatch patch = empty_patch(contacts.front());
  double depth_sum_m = 0;
  add_sums(contacts, patch, depth_sum_m);
  divide_sums(patch, depth_sum_m);
  return patch;
}

}  // namespace mechane::haptics
