// machine.formula: a machine of an author's own. Its values are formulas of joints, quantities and each other, with sums, counts and
// integrals; its loads are formulas too. What they mean is in expression_parser.hpp and expression.hpp.
//
// Each tick computes the values in the order in which they are written, then the loads. Joints are those of this tick; quantities are
// those of its beginning, which have what machines did in the tick before. All sums lie in WorldState::memory.
#include "server/machines/formula.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "server/machines/expression_parser.hpp"
#include "server/machines/machine.hpp"

namespace mechane::machines {
namespace {

constexpr std::size_t kMostValues = 64;
constexpr std::size_t kFaults = 0;  // its place in the machine's memory

/// One value, ready to run.
struct FormulaProgram {
  std::vector<Op> ops;
  std::size_t slot = 0;   // SI
  std::size_t shown = 0;  // in its unit; 0: not shown
  Unit unit;
};

/// What acts: a load's formula, where there is one.
struct FormulaSettings {
  std::vector<FormulaProgram> values;
  std::vector<double> memory{0};  // as it is at the start; the first is kFaults
  std::vector<std::string> names{"faults"};
  JointId joint;
  std::vector<Op> load;
  std::vector<Op> resistance;
  BodyId body;
  std::vector<Op> force;
  std::vector<Op> torque;
  Vec3 axis_B = Vec3::UnitY();
  Vec3 p_BQ = Vec3::Zero();
  double limit = 0;
  double effort_scale = 1;

  [[nodiscard]] std::size_t steps() const {
    std::size_t sum = load.size() + resistance.size() + force.size() + torque.size();
    for (const FormulaProgram& value : values)
      sum += value.ops.size();
    return sum;
  }
};

/// Computes all values; true: one of them had a fault.
bool compute(std::span<const FormulaProgram> values, const Surroundings& around, double dt_s) noexcept {
  bool fault = false;
  for (const FormulaProgram& value : values) {
    const Result result = evaluate(value.ops, around, dt_s);
    around.memory[value.slot] = result.value;
    if (value.shown != 0) around.memory[value.shown] = value.unit.from_si(result.value);
    fault = fault || result.fault;
  }
  return fault;
}

class Formula final : public Machine {
 public:
  Formula(const Build& build, FormulaSettings settings) : s_(std::move(settings)) {
    for (std::size_t i = 0; i < s_.memory.size(); ++i) {
      const std::size_t slot = build.slot(s_.names[i], s_.memory[i]);
      if (i == 0) base_ = slot;
    }
  }

  void run(state::WorldState& state, double dt_s) const noexcept override {
    const Surroundings around{state.joints, state.quantities, std::span(state.memory).subspan(base_, s_.memory.size())};
    bool fault = compute(s_.values, around, dt_s);
    const auto limited = [&](const std::vector<Op>& ops) noexcept {
      const Result result = evaluate(ops, around, dt_s);
      fault = fault || result.fault;
      return s_.effort_scale * std::clamp(result.value, -s_.limit, s_.limit);
    };
    if (s_.joint) {
      const double load = limited(s_.load), resistance = limited(s_.resistance);
      state::JointState& joint = state[s_.joint];
      if (joint.enabled) {
        joint.load += load;
        joint.resistance += std::max(0.0, resistance);
      }
    }
    if (s_.body) {
      const double force = limited(s_.force), torque = limited(s_.torque);
      state::BodyState& body = state[s_.body];
      const Vec3 axis_W = body.X_WB.R * s_.axis_B;
      state::add_force(body, force * axis_W, body.X_WB * s_.p_BQ);
      body.load_W.t += torque * axis_W;
    }
    if (fault) around.memory[kFaults] += 1;
  }

 private:
  FormulaSettings s_;
  std::size_t base_ = 0;
};

/// Reads the formulas of one machine.
class FormulaReader {
 public:
  explicit FormulaReader(const Build& build) : build_(build) {}

  Expected<FormulaSettings> read() {
    const state::Parameters& p = build_.parameters;
    const std::vector<std::string> texts = p.texts("values");
    if (texts.size() > kMostValues)
      return fail(ErrorCode::too_large, fmt::format("there are {} values", texts.size()), build_.place("values"),
                  fmt::format("write {} at most: make two machines of this one", kMostValues));
    for (const std::string& text : texts) {
      if (auto good = declare(text); !good) return tl::unexpected(good.error());
    }
    for (std::size_t i = 0; i < texts.size(); ++i) {
      if (auto good = define(texts[i], i); !good) return tl::unexpected(good.error());
    }
    s_.limit = p.number("limit");
    s_.effort_scale = build_.effort_scale();
    for (const auto& good : {read_joint(), read_body()}) {
      if (!good) return tl::unexpected(good.error());
    }
    if (s_.steps() > kMostSteps)
      return fail(ErrorCode::too_large, fmt::format("the formulas have {} steps", s_.steps()), build_.place("values"),
                  fmt::format("{} at most: make two machines of this one", kMostSteps));
    start();
    return std::move(s_);
  }

 private:
  std::size_t keep(std::string name, double initial) {
    s_.memory.push_back(initial);
    s_.names.push_back(std::move(name));
    return s_.memory.size() - 1;
  }

  Expected<void> declare(const std::string& text) {
    const Place where = build_.place("values");
    const auto statement = split_statement(text);
    if (!statement)
      return fail(ErrorCode::invalid_value, fmt::format("values: '{}' gives no value a name", text.substr(0, 100)),
                  where, "write NAME = FORMULA in UNIT, as in 'level = volume / 0.02 m^2 in cm'");
    const std::string& name = statement->name;
    if (!is_formula_name(name) || is_reserved(name))
      return fail(ErrorCode::invalid_value, fmt::format("values: '{}' cannot be a value's name", name.substr(0, 100)),
                  where,
                  is_reserved(name) ? "it means something else in formulas: write a longer word"
                                    : "use letters from a to z, digits and '_', and a letter first");
    if (std::ranges::find(values_, name, &FormulaValue::name) != values_.end())
      return fail(ErrorCode::duplicate, fmt::format("values: '{}' is written twice", name), where,
                  "rename one of them");
    FormulaValue value{name, std::nullopt, statement->unit.value_or(""), 0, {}, false};
    if (statement->unit) {
      value.unit = parse_unit(*statement->unit);
      if (!value.unit)
        return fail(
            ErrorCode::unknown_name, fmt::format("values: '{}' in '{}' is not a unit", *statement->unit, name), where,
            "write 1 for a pure number, or words with blanks between them and none at a slash, as in 'N m/rad': " +
                known_unit_words());
    }
    value.slot = keep("si." + name, 0);
    values_.push_back(std::move(value));
    return {};
  }

  Expected<void> define(const std::string& text, std::size_t i) {
    const FormulaStatement statement = *split_statement(text);
    auto expression = parse({text, statement.begin, statement.end, "values", build_.place("values")});
    if (!expression) return tl::unexpected(expression.error());
    FormulaValue& value = values_[i];
    if (value.unit && !fits(*expression, value.unit->dimension))
      return fail(ErrorCode::conflict,
                  fmt::format("values: '{}' comes out in {}, but 'in {}' stands after it, which is {}", value.name,
                              in_words(expression->dimension), value.unit_text, in_words(value.unit->dimension)),
                  build_.place("values"), "correct the formula, or write a unit of what it computes");
    value.dimension = value.unit ? value.unit->dimension : expression->dimension;
    value.read = true;
    FormulaProgram program{std::move(expression->ops), value.slot, 0, value.unit.value_or(Unit{})};
    if (value.unit) program.shown = keep(value.name, 0);
    s_.values.push_back(std::move(program));
    return {};
  }

  /// The sums of a formula get names that quantities do not see.
  Expected<Expression> parse(const FormulaText& text) {
    auto expression = parse_expression(text, {build_.description, values_, s_.memory});
    while (s_.names.size() < s_.memory.size())
      s_.names.push_back(fmt::format("sum.{}", s_.names.size()));
    return expression;
  }

  Expected<void> read_load(std::string_view key, const Dimension& wanted, std::string_view of, std::vector<Op>& out) {
    if (!build_.parameters.given(key)) return {};
    const std::string text = build_.parameters.text(key);
    auto expression = parse({text, 0, text.size(), key, build_.place(key)});
    if (!expression) return tl::unexpected(expression.error());
    if (!fits(*expression, wanted))
      return fail(ErrorCode::conflict,
                  fmt::format("{}: '{}' comes out in {}, but {} takes {}", key, text, in_words(expression->dimension),
                              of, in_words(wanted)),
                  build_.place(key), fmt::format("multiply it by a constant that makes {} of it", in_words(wanted)));
    out = std::move(expression->ops);
    return {};
  }

  [[nodiscard]] Expected<void> needs(std::string_view key, std::string_view other) const {
    if (!build_.parameters.given(key) || build_.parameters.given(other)) return {};
    return fail(ErrorCode::missing, fmt::format("'{}' is given, but no '{}' that it acts on", key, other),
                build_.place(key), fmt::format("add '{}'", other));
  }

  Expected<void> read_joint() {
    for (const char* key : {"load", "resistance"}) {
      if (auto good = needs(key, "joint"); !good) return good;
    }
    if (!build_.parameters.given("joint")) return {};
    const auto joint = build_.hinge_or_slider("joint");
    if (!joint) return tl::unexpected(joint.error());
    s_.joint = *joint;
    const bool hinge = build_.description.joints[joint->index()].kind == state::JointKind::hinge;
    const Dimension& wanted = hinge ? kTorqueDimension : kForceDimension;
    const std::string_view of = hinge ? "a hinge" : "a slider";
    if (auto good = read_load("load", wanted, of, s_.load); !good) return good;
    return read_load("resistance", wanted, of, s_.resistance);
  }

  Expected<void> read_body() {
    for (const char* key : {"force", "torque", "axis", "point"}) {
      if (auto good = needs(key, "body"); !good) return good;
    }
    if (!build_.parameters.given("body")) return {};
    s_.body = build_.parameters.body("body");
    if (build_.description.bodies[s_.body.index()].fixed)
      return fail(ErrorCode::conflict,
                  fmt::format("the body '{}' is fixed: no force moves it", build_.parameters.text("body")),
                  build_.place("body"), "name a body that can move");
    const auto axis = build_.direction("axis", Vec3::UnitY());
    if (!axis) return tl::unexpected(axis.error());
    s_.axis_B = *axis;
    s_.p_BQ = build_.vector("point");
    if (auto good = read_load("force", kForceDimension, "a body's force", s_.force); !good) return good;
    return read_load("torque", kTorqueDimension, "a body's torque", s_.torque);
  }

  /// What the values are before the first tick, with joints at 0 and quantities unknown: so that no trigger sees an empty vessel that
  /// starts full. Twice, for values that look at others' last ones.
  void start() {
    const std::vector<state::JointState> joints(build_.description.joints.size());
    const std::vector<double> quantities(build_.description.quantities.size(), 0.0);
    for (int i = 0; i < 2; ++i)
      static_cast<void>(compute(s_.values, {joints, quantities, s_.memory}, 0));
  }

  const Build& build_;
  FormulaSettings s_;
  std::vector<FormulaValue> values_;
};

Expected<std::unique_ptr<Machine>> make_formula(const Build& build) {
  auto settings = FormulaReader(build).read();
  if (!settings) return tl::unexpected(settings.error());
  return std::make_unique<Formula>(build, std::move(*settings));
}

using state::ParameterKind;
constexpr state::ParameterType formula_parameter(std::string_view name, std::string_view unit,
                                                 std::string_view summary) {
  return {.name = name,
          .kind = ParameterKind::text,
          .unit = unit,
          .summary = summary,
          .reference = state::Reference::expression};
}

constexpr state::ParameterType kFormulaParameters[] = {
    {.name = "values",
     .kind = ParameterKind::texts,
     .summary = "each `NAME = FORMULA` or `NAME = FORMULA in UNIT`; those with a unit can be read by quantities",
     .reference = state::Reference::expression},
    {.name = "joint",
     .kind = ParameterKind::text,
     .summary = "the hinge or slider that `load` and `resistance` act on",
     .reference = state::Reference::joint},
    formula_parameter("load", "N or N m", "formula of the force along the slider, or of the torque about the hinge"),
    formula_parameter("resistance", "N or N m", "formula of what only brakes the joint; below 0 it is 0"),
    {.name = "body",
     .kind = ParameterKind::text,
     .summary = "the body that `force` and `torque` act on",
     .reference = state::Reference::body},
    formula_parameter("force", "N", "formula of the force on the body, along `axis` at `point`"),
    formula_parameter("torque", "N m", "formula of the torque on the body, about `axis`"),
    state::direction("axis", "of force and torque, in the body's frame; not given: its y axis"),
    state::point("point", "where the force acts, in the body's frame"),
    {.name = "limit",
     .unit = "N or N m",
     .summary = "the most that any of the loads comes to, either way",
     .default_value = 1000,
     .min = 0,
     .max = 1e5},
    effort_scale_parameter("share of the loads that is applied; not given: the world's effort_scale"),
};
constexpr state::ValueType kFormulaValues[] = {
    state::amount("faults", "", "ticks in which a formula divided by zero, or had no finite result"),
};

}  // namespace

std::vector<OwnValue> formula_values(const state::ComponentDescription& component) {
  std::vector<OwnValue> out;
  const auto* texts = component.written<std::vector<std::string>>("values");
  if (texts == nullptr) return out;
  for (const std::string& text : *texts) {
    const auto statement = split_statement(text);
    if (statement && statement->unit) out.push_back({statement->name, *statement->unit == "1" ? "" : *statement->unit});
  }
  return out;
}

const MachineKind& formula_kind() {
  static const MachineKind kKind{{"machine.formula", "A machine of your own: its values and loads are formulas",
                                  kFormulaParameters, kFormulaValues},
                                 make_formula};
  return kKind;
}

}  // namespace mechane::machines
