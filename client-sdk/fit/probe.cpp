#include "client-sdk/fit/probe.hpp"

#include <array>

#include "server/base/assert.hpp"
#include "server/collision/samples.hpp"

namespace mechane::fit {
namespace {

collision::Object single_point() {
  collision::Object point;
  point.parts.emplace_back();  // its empty map is never hit
  collision::append_samples(point, 0, {Vec3::Zero()});
  collision::close_clusters(point);
  return point;
}

}  // namespace

Probe::Probe(const collision::Object& object) : point_(single_point()) {
  object_.parts = object.parts;
  object_.bound_O = object.bound_O;
  object_.first_group.assign(object.parts.size() + 1, 0);
}

Probe::Probe(const collision::Object& object, std::size_t part) : point_(single_point()) {
  MECHANE_ASSERT(part < object.parts.size());
  object_.parts.push_back(object.parts[part]);
  object_.bound_O = object_.parts.front().bound_O;
  object_.first_group.assign(2, 0);
}

Felt Probe::at(const Vec3& p_OP) const {
  std::array<collision::PointContact, 4> storage;
  collision::ContactBuffer contacts(storage);
  collision::find_contacts(point_, Pose{p_OP, Quat::Identity()}, object_, Pose{}, contacts);
  if (contacts.contacts().empty()) return {};
  const collision::PointContact& contact = contacts.contacts().front();
  return {true, contact.depth_m, contact.part_b};
}

}  // namespace mechane::fit
