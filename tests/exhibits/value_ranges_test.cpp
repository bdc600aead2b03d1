// What types say of the ranges of their values (state::ValueType) holds in every exhibit, also where visitors make mistakes: the checker
// refuses goals beyond them.
#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "server/agents/registry.hpp"
#include "server/machines/registry.hpp"
#include "tests/support/exhibit_play.hpp"

namespace mechane {
namespace {

/// Rounding of a level that has run empty.
constexpr double kRounding = 1e-9;

struct Ranged {
  std::string source;  ///< "PUMP.basin_l"
  double min = 0, max = 0;
  bool left = false;  ///< and said so
};

double number_of(const state::ComponentDescription& component, const state::ComponentType& type,
                 std::string_view name) {
  if (const auto it = component.parameters.find(std::string(name)); it != component.parameters.end())
    return std::get<std::vector<double>>(it->second).front();
  for (const state::ParameterType& parameter : type.parameters) {
    if (parameter.name == name) return parameter.default_value;
  }
  ADD_FAILURE() << type.name << " has no parameter " << name;
  return 0;
}

void add_ranged(std::span<const state::ComponentDescription> components, std::span<const state::ComponentType> types,
                std::vector<Ranged>& all) {
  for (const state::ComponentDescription& component : components) {
    for (const state::ComponentType& type : types) {
      if (type.name != component.type) continue;
      for (const state::ValueType& value : type.values) {
        const double max = value.max_parameter.empty() ? value.max : number_of(component, type, value.max_parameter);
        all.push_back({component.name + "." + std::string(value.name), value.min, max});
      }
    }
  }
}

class ValueRanges : public testing::TestWithParam<const char*> {};

TEST_P(ValueRanges, HoldWhereVisitorsMakeMistakes) {
  const test::Exhibit exhibit(GetParam());
  std::vector<Ranged> ranged;
  add_ranged(exhibit.description().agents, agents::registry(), ranged);
  add_ranged(exhibit.description().machines, machines::registry(), ranged);
  ASSERT_GT(ranged.size(), 3u);
  const std::size_t first = exhibit.description().quantities.size();
  test::PlayOptions options;
  options.change = [&](state::WorldDescription& world) {
    for (const Ranged& value : ranged)
      world.quantities.push_back({value.source, value.source, ""});
  };
  options.watch = [&](const state::WorldState& state) {
    for (std::size_t i = 0; i < ranged.size(); ++i) {
      const double value = state.quantities[first + i];
      if (ranged[i].left || (value >= ranged[i].min - kRounding && value <= ranged[i].max + kRounding)) continue;
      ranged[i].left = true;
      ADD_FAILURE() << ranged[i].source << " is " << value << " at tick " << state.tick << ", and should be "
                    << ranged[i].min << " to " << ranged[i].max;
    }
  };
  for (const state::VisitDescription& visit : exhibit.description().visits)
    (void)exhibit.play(visit.name, options);
}

// One exhibit of each machine, and those with the most agents.
INSTANTIATE_TEST_SUITE_P(Of, ValueRanges,
                         testing::Values("aiolos-sphere", "archimedes-screw", "catapult", "compound-pulley-crane",
                                         "crossbow", "ktesibios-pump", "odometer", "village"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace mechane
