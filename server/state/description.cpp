#include "server/state/description.hpp"

#include <algorithm>

namespace mechane::state {
namespace {

template <class IdType, class Item>
IdType find_by_name(const std::vector<Item>& items, const std::string& name) {
  const auto it = std::find_if(items.begin(), items.end(), [&](const Item& item) { return item.name == name; });
  if (it == items.end()) return IdType::none();
  return IdType(static_cast<std::size_t>(it - items.begin()));
}

}  // namespace

BodyId WorldDescription::find_body(const std::string& name) const {
  return find_by_name<BodyId>(bodies, name);
}
JointId WorldDescription::find_joint(const std::string& name) const {
  return find_by_name<JointId>(joints, name);
}
AgentId WorldDescription::find_agent(const std::string& name) const {
  return find_by_name<AgentId>(agents, name);
}
MachineId WorldDescription::find_machine(const std::string& name) const {
  return find_by_name<MachineId>(machines, name);
}
QuantityId WorldDescription::find_quantity(const std::string& name) const {
  return find_by_name<QuantityId>(quantities, name);
}
StepId WorldDescription::find_step(const std::string& name) const {
  return find_by_name<StepId>(steps, name);
}
ActivityId WorldDescription::find_activity(const std::string& name) const {
  return find_by_name<ActivityId>(activities, name);
}

}  // namespace mechane::state
