// simulation.assembled: the order in which parts go to their places. A part that comes to its place before its turn is not taken.
#include <algorithm>

#include <fmt/format.h>

#include "server/agents/agent.hpp"

namespace mechane::agents {
namespace {

using state::ParameterKind;

constexpr std::string_view kBefore = " before ";

/// One part: the snap that takes it, and what must be in place before.
struct Part {
  AgentId snap;
  std::string name;
  BodyId object;
  double reach_m = 0;
  double reach_rad = 0;
  std::vector<std::size_t> after;  // parts
  std::size_t placed = 0;          // slots of the snap
  std::size_t distance = 0;
  std::size_t angle = 0;
  std::size_t refused = 0;  // slot of ours: it is at its place and not taken
};

class Assembled final : public Agent {
 public:
  Assembled(const Build& build, std::vector<Part> parts)
      : id_(build.id),
        parts_(std::move(parts)),
        placed_(build.slot("placed")),
        complete_(build.slot("complete")),
        refused_(build.slot("refused")),
        next_(build.slot("next", -1)) {
    for (Part& part : parts_)
      part.refused = build.slot("own." + part.name);
  }

  Expected<void> link(const state::MemoryLayout& layout) override {
    for (Part& part : parts_) {
      part.placed = layout.find(part.name + ".placed")->index;
      part.distance = layout.find(part.name + ".distance")->index;
      part.angle = layout.find(part.name + ".angle")->index;
    }
    return {};
  }

  [[nodiscard]] bool switches_others() const noexcept override { return true; }

  void run(state::WorldState& state, bool enabled, double /*dt_s*/) const noexcept override {
    double placed = 0, next = -1;
    for (const Part& part : parts_) {
      const bool home = state.memory[part.placed] != 0;
      const bool allowed = std::all_of(part.after.begin(), part.after.end(),
                                       [&](std::size_t i) { return state.memory[parts_[i].placed] != 0; });
      placed += home ? 1 : 0;
      if (!home && allowed && next < 0) next = static_cast<double>(part.object.index());
      if (!enabled) continue;
      state.agent_enabled[part.snap.index()] = allowed ? 1 : 0;
      refuse(state, part, !home && !allowed);
    }
    const bool complete = placed == static_cast<double>(parts_.size());
    if (enabled && complete && state.memory[complete_] == 0)
      state.emit(state::EventKind::assembled, static_cast<std::uint32_t>(id_.index()));
    state.memory[placed_] = placed;
    state.memory[next_] = next;
    state.memory[complete_] = complete ? 1 : 0;
  }

 private:
  /// Emits one event when a part comes too early, and another only after the part has been away.
  void refuse(state::WorldState& state, const Part& part, bool early) const noexcept {
    const auto within = [&](double share) {
      return state.memory[part.distance] <= share * part.reach_m && state.memory[part.angle] <= share * part.reach_rad;
    };
    double& said = state.memory[part.refused];
    if (said != 0 && (!early || !within(1.5))) said = 0;
    // Before the snap has measured anything its distances are 0.
    const bool measured = state.tick > state.progress.activity_tick + 1;
    if (said != 0 || !early || !measured || !within(1)) return;
    said = 1;
    state.memory[refused_] += 1;
    state.emit(state::EventKind::part_refused, static_cast<std::uint32_t>(id_.index()),
               static_cast<std::uint32_t>(part.object.index()));
  }

  AgentId id_;
  std::vector<Part> parts_;
  std::size_t placed_;
  std::size_t complete_;
  std::size_t refused_;
  std::size_t next_;
};

/// The snap's object and tolerance. Faults in them are reported when the snap itself is made.
void read_snap(const state::WorldDescription& world, const state::ComponentDescription& snap, Part& part) {
  if (const std::string* object = snap.written_text("object")) part.object = world.find_body(*object);
  const auto* numbers = snap.written<std::vector<double>>("tolerance");
  if (numbers == nullptr || numbers->size() != 2) return;
  part.reach_m = (*numbers)[0];
  part.reach_rad = (*numbers)[1];
}

Expected<void> read_order(const Build& build, std::vector<Part>& parts) {
  constexpr const char* kRemedy = "write \"ONE before OTHER\", both named in 'parts'";
  const auto find = [&](std::string_view name) {
    return static_cast<std::size_t>(
        std::find_if(parts.begin(), parts.end(), [&](const Part& p) { return p.name == name; }) - parts.begin());
  };
  for (const std::string& line : build.parameters.texts("order")) {
    const std::size_t at = line.find(kBefore);
    if (at == std::string::npos)
      return fail(ErrorCode::invalid_value, fmt::format("the line '{}' of 'order' does not say 'before'", line),
                  build.place("order"), kRemedy);
    const std::size_t first = find(std::string_view(line).substr(0, at));
    const std::size_t then = find(std::string_view(line).substr(at + kBefore.size()));
    if (first >= parts.size() || then >= parts.size())
      return fail(ErrorCode::unknown_name, fmt::format("the line '{}' of 'order' names a part not in 'parts'", line),
                  build.place("order"), kRemedy);
    parts[then].after.push_back(first);
  }
  return {};
}

/// Whether the parts can be placed in an order that keeps every line of 'order'.
bool can_be_built(const std::vector<Part>& parts) {
  std::vector<bool> placed(parts.size(), false);
  for (std::size_t round = 0; round < parts.size(); ++round) {
    for (std::size_t i = 0; i < parts.size(); ++i)
      placed[i] = placed[i] ||
                  std::all_of(parts[i].after.begin(), parts[i].after.end(), [&](std::size_t k) { return placed[k]; });
  }
  return std::all_of(placed.begin(), placed.end(), [](bool p) { return p; });
}

Expected<std::unique_ptr<Agent>> make_assembled(const Build& build) {
  std::vector<Part> parts;
  for (const std::string& name : build.parameters.texts("parts")) {
    Part part;
    part.snap = build.description.find_agent(name);
    part.name = name;
    const state::ComponentDescription& snap = build.agent(part.snap);
    if (snap.type != "geometry.snap")
      return fail(ErrorCode::invalid_value, fmt::format("the agent '{}' in 'parts' is a {}", name, snap.type),
                  build.place("parts"), "name geometry.snap agents in 'parts'");
    if (std::any_of(parts.begin(), parts.end(), [&](const Part& p) { return p.name == name; }))
      return fail(ErrorCode::duplicate, fmt::format("'parts' names '{}' twice", name), build.place("parts"),
                  "name each part once");
    read_snap(build.description, snap, part);
    parts.push_back(std::move(part));
  }
  if (parts.empty())
    return fail(ErrorCode::missing, "'parts' is empty", build.place("parts"), "name the geometry.snap of each part");
  if (build.parameters.given("order")) {
    if (auto good = read_order(build, parts); !good) return tl::unexpected(good.error());
  } else {
    for (std::size_t i = 1; i < parts.size(); ++i)
      parts[i].after = {i - 1};
  }
  if (!can_be_built(parts))
    return fail(ErrorCode::conflict, "'order' goes in a circle: some parts each need the other placed first",
                build.place("order"), "remove one line of the circle from 'order'");
  return std::make_unique<Assembled>(build, std::move(parts));
}

constexpr state::ParameterType kAssembledParameters[] = {
    {.name = "parts",
     .kind = ParameterKind::texts,
     .summary = "the geometry.snap of each part; this agent switches them",
     .required = true,
     .reference = state::Reference::agent},
    {.name = "order",
     .kind = ParameterKind::texts,
     .summary =
         "lines like \"ONE before OTHER\": what must be in place before what; none: one after the other as listed"},
};
constexpr state::ValueType kAssembledValues[] = {
    state::amount("placed", "", "how many parts are in their places"),
    state::yes_or_no("complete", "1 while all are"),
    state::amount("refused", "", "how often a part came before its turn"),
    {"next", "", "index of a body whose turn it is; -1: none", -1},
};

}  // namespace

const AgentKind& assembled_kind() {
  static const AgentKind kKind{{"simulation.assembled", "Takes parts in their order, and says when all are in place",
                                kAssembledParameters, kAssembledValues},
                               make_assembled};
  return kKind;
}

}  // namespace mechane::agents
