#include "client-sdk/studio/view/stillness.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "server/agents/registry.hpp"
#include "server/state/affordances.hpp"

namespace mechane::studio {
namespace {

using state::ComponentDescription;
using state::WorldDescription;

constexpr double kFell_m = 10;
constexpr double kInPlace_m = 1e-3;
constexpr double kInPlace_rad = 1e-2;

/// What a hand pulls with where the grasp's author wrote nothing.
double usual_grasp_force_n() {
  const auto grasp = std::ranges::find(agents::registry(), "simulation.grasp", &state::ComponentType::name);
  return std::ranges::find(grasp->parameters, "forceLimit", &state::ParameterType::name)->default_value;
}

/// One body, and what is known around it.
class StillnessOf {
 public:
  StillnessOf(const WorldDescription& world, std::span<const state::Affordance> affordances, const SeenWorld& seen,
              std::size_t body)
      : world_(world),
        affordances_(affordances),
        seen_(seen),
        id_(body),
        body_(world.bodies[body]),
        step_(world.find_step(seen.step)) {}

  std::vector<StillReason> reasons() {
    look_at_visible();
    look_at_place();
    look_at_fixed();
    if (reasons_.empty() || reasons_.back().kind != "fixed") look_at_snaps();
    if (!body_.fixed) look_at_hands();
    if (reasons_.empty()) look_at_ratchets();
    return std::move(reasons_);
  }

 private:
  void add(const char* kind, state::Texts text, state::Texts remedy, std::string path = {}) {
    reasons_.push_back({kind, std::move(text), std::move(remedy), std::move(path)});
  }
  [[nodiscard]] bool is_on(const std::string& agent) const {
    return std::ranges::count(seen_.enabled_agents, agent) > 0;
  }
  /// "activities/use/steps/fill/WHAT"; empty before the first step.
  [[nodiscard]] std::string in_step(const std::string& what) const {
    if (!step_) return {};
    const state::StepDescription& step = world_.steps[step_.index()];
    return fmt::format("activities/{}/steps/{}/{}", world_.activities[step.activity.index()].name, step.name, what);
  }
  [[nodiscard]] std::string override_path(const char* key) const {
    return in_step(fmt::format("object:{}/{}", body_.name, key));
  }

  /// A property of the body as it is now, where that is certain: the step says it, or no step ever changes it.
  template <class Property>
  [[nodiscard]] std::optional<bool> known(bool at_start, Property property, bool& by_step) const {
    bool changes = false;
    for (std::size_t i = 0; i < world_.steps.size(); ++i) {
      for (const state::BodyOverride& change : world_.steps[i].bodies) {
        if (change.body != id_ || !property(change)) continue;
        by_step = StepId(i) == step_;
        if (by_step) return property(change);
        changes = true;
      }
    }
    return changes ? std::nullopt : std::optional(at_start);
  }

  void look_at_visible() {
    if (seen_.visible[id_.index()] != 0) return;
    add("hidden",
        {{"el", "Δεν φαίνεται τώρα: ούτε χέρια ούτε σώματα το αγγίζουν."},
         {"en", "It is hidden now: neither hands nor bodies touch it."}},
        {{"el", "Δείξτε το σε αυτό το βήμα."}, {"en", "Show it in this step."}}, override_path("visible"));
  }

  void look_at_place() {
    const double fallen_m = start().y() - seen_.X_WB[id_.index()].p.y();
    if (fallen_m < kFell_m) return;
    add("fell",
        {{"el", fmt::format("Έπεσε {:.0f} m κάτω από τη θέση του.", fallen_m)},
         {"en", fmt::format("It fell {:.0f} m below its place.", fallen_m)}},
        {{"el", "Βάλτε κάτι από κάτω, κρατήστε το με μια άρθρωση ή κλείστε τη βαρύτητά του."},
         {"en", "Put something under it, hold it by a joint, or turn its gravity off."}},
        body_.name);
  }
  [[nodiscard]] Vec3 start() const {
    if (step_)
      for (const state::BodyOverride& change : world_.steps[step_.index()].bodies)
        if (change.body == id_ && change.X_WB) return change.X_WB->p;
    return body_.X_WB.p;
  }

  void look_at_fixed() {
    bool by_step = false;
    if (body_.fixed) {
      if (body_.graspable)
        add("fixed", {{"el", "Είναι σταθερό στο αρχείο."}, {"en", "It is fixed in the file."}},
            {{"el", "Βγάλτε το «fixed» του σώματος."}, {"en", "Take away the body's 'fixed'."}}, body_.name);
      return;
    }
    const auto movable = known(
        !body_.driven, [](const state::BodyOverride& o) { return o.movable; }, by_step);
    if (movable.value_or(true)) return;
    if (by_step)
      add("fixed", {{"el", "Αυτό το βήμα το κρατά ακίνητο."}, {"en", "This step holds it still."}},
          {{"el", "Κάντε το κινητό σε αυτό το βήμα."}, {"en", "Make it movable in this step."}},
          override_path("movable"));
    else
      add("fixed", {{"el", "Το κινούν μόνο συμβάντα (ROUTE)."}, {"en", "Only events (ROUTEs) move it."}},
          {{"el", "Κάντε το κινητό σε ένα βήμα."}, {"en", "Make it movable in a step."}}, override_path("movable"));
  }

  void look_at_snaps() {
    for (const state::Affordance& place : affordances_) {
      if (place.kind != state::Affordance::Kind::placed || place.object != id_) continue;
      const Pose X_WP = (place.base ? seen_.X_WB[place.base.index()] : Pose{}) * place.X_AJ;
      const Pose& X_WB = seen_.X_WB[id_.index()];
      const ComponentDescription& snap = world_.agents[place.agent.index()];
      if ((X_WP.p - X_WB.p).norm() > kInPlace_m || angle(snap, X_WP, X_WB) > kInPlace_rad) continue;
      add("snapped",
          {{"el", fmt::format("Το κρατά στη θέση του το {}.", snap.name)},
           {"en", fmt::format("{} holds it in its place.", snap.name)}},
          {{"el", "Κάντε το κινητό στο βήμα που πρέπει να βγει."},
           {"en", "Make it movable in the step in which it is to come out."}},
          "agents/" + snap.name);
    }
  }
  /// Between the attitudes; with an insertion axis, between the axes.
  [[nodiscard]] static double angle(const ComponentDescription& snap, const Pose& X_WP, const Pose& X_WB) {
    const auto* axis = snap.written<std::vector<double>>("axis");
    if (axis == nullptr || axis->size() != 3) return rotation_vector(X_WP.R * X_WB.R.conjugate()).norm();
    const Vec3 axis_B((*axis)[0], (*axis)[1], (*axis)[2]);
    return Quat::FromTwoVectors(X_WB.R * axis_B, X_WP.R * axis_B).angularDistance(Quat::Identity());
  }

  void look_at_hands() {
    const std::vector<const ComponentDescription*> grasps = agents_that_take();
    bool by_step = false;
    const auto graspable = known(
        body_.graspable, [](const state::BodyOverride& o) { return o.graspable; }, by_step);
    if (!graspable.value_or(true) || grasps.empty()) return not_taken(!graspable.value_or(true), by_step);
    if (std::ranges::none_of(grasps, [this](const auto* grasp) { return is_on(grasp->name); }))
      return off(grasps.front()->name, "Τα χέρια δεν το πιάνουν τώρα", "Hands cannot take it now");
    look_at_weight(grasps);
  }

  [[nodiscard]] std::vector<const ComponentDescription*> agents_that_take() const {
    std::vector<const ComponentDescription*> grasps;
    for (const state::Affordance& one : affordances_)
      if (one.kind == state::Affordance::Kind::taken && one.object == id_)
        grasps.push_back(&world_.agents[one.agent.index()]);
    return grasps;
  }

  /// No hand ever takes it: something else has to move it.
  void not_taken(bool not_graspable, bool by_step) {
    const std::vector<std::string> drives = agents_that_drive();
    for (const std::string& agent : drives)
      if (!is_on(agent)) off(agent, "Δεν κινείται μαζί με τα άλλα", "It does not move with other parts now");
    if (!drives.empty()) return;
    if (not_graspable)
      add("not_graspable", {{"el", "Τα χέρια δεν το πιάνουν."}, {"en", "Hands cannot take it."}},
          {{"el", "Κάντε το «graspable»."}, {"en", "Make it graspable."}},
          by_step ? override_path("graspable") : body_.name + "/mechane:haptic/graspable");
    else
      not_named();
  }
  /// In the bodies of no simulation.grasp.
  void not_named() {
    const auto grasp = std::ranges::find(world_.agents, "simulation.grasp", &ComponentDescription::type);
    const bool there = grasp != world_.agents.end();
    const std::string name = there ? grasp->name : std::string();
    add("not_graspable",
        {{"el", "Κανένα χέρι δεν το πιάνει: δεν είναι στα «bodies» κανενός simulation.grasp."},
         {"en", "No hand may take it: it is among the 'bodies' of no simulation.grasp."}},
        there ? state::Texts{{"el", fmt::format("Προσθέστε το στα «bodies» του {}.", name)},
                             {"en", fmt::format("Add it to the 'bodies' of {}.", name)}}
              : state::Texts{{"el", "Προσθέστε έναν τέτοιο πράκτορα."}, {"en", "Add such an agent."}},
        there ? fmt::format("agents/{}/bodies", name) : "agents");
  }

  void off(const std::string& agent, const char* el, const char* en) {
    add("off",
        {{"el", fmt::format("{}: το {} είναι κλειστό σε αυτό το βήμα.", el, agent)},
         {"en", fmt::format("{}: {} is off in this step.", en, agent)}},
        {{"el", fmt::format("Ανοίξτε το {} σε αυτό το βήμα.", agent)},
         {"en", fmt::format("Turn {} on in this step.", agent)}},
        in_step("enable"));
  }

  /// Gears, ropes and screws that are on one of its joints, or name it.
  [[nodiscard]] std::vector<std::string> agents_that_drive() const {
    static constexpr std::array<std::string_view, 5> kTypes{
        "geometry.gear", "geometry.worm", "geometry.intermittent_gear", "geometry.rope", "geometry.screw"};
    std::vector<std::string> agents;
    for (const ComponentDescription& agent : world_.agents) {
      if (std::ranges::count(kTypes, agent.type) == 0) continue;
      const auto* bodies = agent.written<std::vector<std::string>>("bodies");
      bool drives = bodies != nullptr && std::ranges::count(*bodies, body_.name) > 0;
      for (const char* key : {"joint", "joint1", "joint2", "drum"})
        if (const std::string* joint = agent.written_text(key)) drives = drives || moves_in(world_.find_joint(*joint));
      if (drives) agents.push_back(agent.name);
    }
    return agents;
  }
  [[nodiscard]] bool moves_in(JointId joint) const { return joint && world_.joints[joint.index()].body2 == id_; }

  void look_at_weight(const std::vector<const ComponentDescription*>& grasps) {
    const bool on_joint = std::ranges::any_of(world_.joints, [this](const state::JointDescription& joint) {
      return joint.body1 == id_ || joint.body2 == id_;
    });
    bool by_step = false;
    const auto weighs = known(
        body_.use_gravity, [](const state::BodyOverride& o) { return o.use_gravity; }, by_step);
    if (on_joint || !weighs.value_or(false)) return;
    double most_n = 0;
    for (const ComponentDescription* grasp : grasps) {
      const auto* limit = grasp->written<std::vector<double>>("forceLimit");
      if (is_on(grasp->name))
        most_n = std::max(most_n, limit != nullptr && limit->size() == 1 ? limit->front() : usual_grasp_force_n());
    }
    const double weight_n = body_.mass_kg * body_.effort_scale * world_.gravity_W.norm();
    if (weight_n <= most_n) return;
    add("heavy",
        {{"el", fmt::format("Ζυγίζει {:.1f} N στο χέρι, που τραβά το πολύ {:.1f} N.", weight_n, most_n)},
         {"en", fmt::format("It weighs {:.1f} N in a hand that pulls with {:.1f} N at most.", weight_n, most_n)}},
        {{"el", "Μικρύνετε το effortScale ή τη μάζα του."}, {"en", "Make its effortScale or its mass smaller."}},
        body_.name + "/mechane:haptic/effortScale");
  }

  /// Who turns it the other way finds it stuck.
  void look_at_ratchets() {
    for (const ComponentDescription& agent : world_.agents) {
      const std::string* joint = agent.type == "geometry.ratchet" ? agent.written_text("joint") : nullptr;
      if (joint == nullptr || !is_on(agent.name) || !moves_in(world_.find_joint(*joint))) continue;
      add("one_way",
          {{"el", fmt::format("Το {} το αφήνει να πάει μόνο προς τη μία φορά.", agent.name)},
           {"en", fmt::format("{} lets it go one way only.", agent.name)}},
          {{"el", "Δοκιμάστε προς την άλλη φορά."}, {"en", "Try the other way."}}, "agents/" + agent.name);
    }
  }

  const WorldDescription& world_;
  const std::span<const state::Affordance> affordances_;
  const SeenWorld& seen_;
  const BodyId id_;
  const state::BodyDescription& body_;
  const StepId step_;
  std::vector<StillReason> reasons_;
};

}  // namespace

std::vector<StillBody> still_bodies(const WorldDescription& world, const SeenWorld& seen) {
  std::vector<StillBody> still;
  const std::vector<state::Affordance> affordances = state::affordances_of(world);
  const std::size_t known = std::min({world.bodies.size(), seen.X_WB.size(), seen.visible.size(), seen.moves.size()});
  for (std::size_t i = 0; i < known; ++i) {
    if (seen.moves[i] != 0) continue;
    std::vector<StillReason> reasons = StillnessOf(world, affordances, seen, i).reasons();
    if (!reasons.empty()) still.push_back({world.bodies[i].name, std::move(reasons)});
  }
  return still;
}

}  // namespace mechane::studio
