#include "server/haptics/contact_patch.hpp"

#include <algorithm>

namespace mechane::haptics {
namespace {

ContactPatch* find_or_add(std::array<ContactPatch, kMaxPatches>& patches, std::size_t& count,
                          const state::Contact& contact, ContactPatch* last) {
  // Contacts of a patch mostly follow one another.
  if (last != nullptr && last->body == contact.body && last->segment == contact.segment) return last;
  for (std::size_t i = 0; i < count; ++i) {
    if (patches[i].body == contact.body && patches[i].segment == contact.segment) return &patches[i];
  }
  if (count == patches.size()) return nullptr;
  ContactPatch& fresh = patches[count++];
  fresh = ContactPatch{};
  fresh.body = contact.body;
  fresh.segment = contact.segment;
  return &fresh;
}

}  // namespace

std::size_t gather_patches(std::span<const state::Contact> contacts,
                           std::array<ContactPatch, kMaxPatches>& patches) noexcept {
  std::size_t count = 0;
  std::array<double, kMaxPatches> depth_sum{};
  ContactPatch* touched = nullptr;
  for (const state::Contact& contact : contacts) {
    touched = find_or_add(patches, count, contact, touched);
    if (touched == nullptr) break;
    const double S = contact.depth_m;
    depth_sum[static_cast<std::size_t>(touched - patches.data())] += S;
    touched->push_m += S * S * contact.n_BH_W;
    touched->p_WC += S * contact.p_WC;
    touched->deepest_m = std::max(touched->deepest_m, S);
    ++touched->points;
  }
  for (std::size_t i = 0; i < count; ++i) {
    ContactPatch& patch = patches[i];
    if (depth_sum[i] <= 0) continue;
    patch.push_m /= depth_sum[i];
    patch.p_WC /= depth_sum[i];
    patch.depth_m = patch.found_depth_m = patch.push_m.norm();
    // Points on both sides of a thin segment can cancel: then there is no way out to push along.
    if (patch.depth_m > 0) patch.n_BH_W = patch.push_m / patch.depth_m;
  }
  return count;
}

}  // namespace mechane::haptics
