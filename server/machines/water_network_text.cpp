#include "server/machines/water_network_text.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "server/base/suggestion.hpp"
#include "server/machines/expression_parser.hpp"
#include "server/machines/nature.hpp"

namespace mechane::machines {
namespace {

constexpr std::size_t kMostParts = 32;  // of one list
constexpr double kHighest_m = 1000;
constexpr double kMostSuction_m = 10;    // over which the atmosphere lifts no water
constexpr double kMostLift_m2_kg = 10;   // area of a float's section for its mass: a lighter one would leap in a tick
constexpr double kFloatDamping = 0.5;    // of the critical one
constexpr double kLeastStartAir = 0.01;  // share of a closed vessel
constexpr Dimension kAreaDimension{{4, 0, 0, 0}};
constexpr Dimension kVolumeDimension{{6, 0, 0, 0}};
constexpr Dimension kFlowDimension{{6, 0, -2, 0}};

constexpr PartValue kPartValues[] = {
    {"vessels", "_level", "m", &NetworkSlots::level},        {"vessels", "_volume", "l", &NetworkSlots::water},
    {"vessels", "_pressure", "Pa", &NetworkSlots::pressure}, {"vessels", "_overflow", "l/s", &NetworkSlots::overflow},
    {"pipes", "_flow", "l/s", &NetworkSlots::flow},          {"feeds", "_flow", "l/s", &NetworkSlots::poured},
    {"floats", "_lift", "N", &NetworkSlots::lift},
};

/// A list of parts, and what may be written of each.
struct List {
  std::string_view parameter;
  std::vector<std::string> keys;
  std::string_view example;
};
const std::vector<List>& lists() {
  static const std::vector<List> kLists = {
      {"vessels",
       {"area", "height", "floor", "start", "air", "vent", "on"},
       "TANK: area 0.02 m2, height 0.3 m, start 2 l"},
      {"pipes",
       {"from", "to", "bore", "discharge", "open", "oneway", "crest"},
       "SPOUT: from TANK at 0.5 m, to air, bore 8 mm"},
      {"feeds", {"into", "flow"}, "SPRING: into TANK, flow 2 l/min"},
      {"floats", {"in", "of", "area", "height", "bottom"}, "CORK: in TANK, of FLOAT.body, area 40 cm2, height 3 cm"},
  };
  return kLists;
}

constexpr std::string_view kBlanks = " \t\n\r";

/// One "KEY VALUE" of a part; the value is from `begin` to `end` of the part's text.
struct Field {
  std::string key;
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Cuts at commas that stand in no bracket.
std::vector<Field> fields_of(std::string_view text) {
  std::vector<Field> fields;
  std::size_t at = text.find(':') + 1;
  while (at <= text.size()) {
    std::size_t end = at;
    for (int depth = 0; end < text.size() && (depth > 0 || text[end] != ','); ++end)
      depth += text[end] == '(' ? 1 : text[end] == ')' ? -1 : 0;
    const std::size_t key = std::min(text.find_first_not_of(kBlanks, at), end);
    const std::size_t key_end = std::min(text.find_first_of(kBlanks, key), end);
    const std::size_t last = text.find_last_not_of(kBlanks, end == 0 ? 0 : end - 1) + 1;
    const std::size_t begin = std::min(text.find_first_not_of(kBlanks, key_end), end);
    fields.push_back({std::string(text.substr(key, key_end - key)), begin, std::max(begin, last)});
    at = end + 1;
  }
  return fields;
}

/// A name, and a colon right after it.
bool begins_with_name(std::string_view text) {
  const std::string_view name = part_name(text);
  const std::size_t colon = text.find(':');
  return is_formula_name(name) && name != "air" && colon != std::string_view::npos &&
         text.find_first_not_of(kBlanks, text.find(name) + name.size()) == colon;
}

bool changes(const Op& op) {
  switch (op.code) {
    case OpCode::joint_position:
    case OpCode::joint_velocity:
    case OpCode::quantity:
    case OpCode::value:
    case OpCode::integral:
    case OpCode::sum:
      return true;
    default:
      return false;
  }
}

/// Reads one network, and keeps the first error.
class NetworkReader {
 public:
  explicit NetworkReader(const Build& build) : build_(build) {}

  Expected<NetworkSettings> read() {
    s_.slots.faults = keep("faults", 0);
    for (const List& list : lists())
      read_names(list);
    if (!error_ && names_of("vessels").empty())
      error_ = fail(ErrorCode::missing, "there is no vessel", build_.place("vessels"),
                    fmt::format("write one, as in '{}'", lists().front().example))
                   .value();
    if (error_) return tl::unexpected(*error_);
    take_slots();
    each("vessels", [&] { read_vessel(); });
    fill_airs();
    each("pipes", [&] { read_pipe(); });
    each("feeds", [&] { read_feed(); });
    each("floats", [&] { read_float(); });
    count_steps();
    if (error_) return tl::unexpected(*error_);
    s_.time_scale = build_.parameters.number("timeScale");
    s_.limit_n = build_.parameters.number("limit");
    for (const ShownValue& value : s_.shown)
      s_.memory[value.shown] = s_.memory[value.si] / value.factor;
    return std::move(s_);
  }

 private:
  void refuse(ErrorCode code, const std::string& what, std::string remedy) {
    if (error_) return;
    const std::string name(part_name(text_).substr(0, 100));
    const std::string in = name.empty() ? "" : fmt::format("in '{}', ", name);
    error_ = fail(code, fmt::format("{}: {}{}", list_->parameter, in, what), build_.place(list_->parameter),
                  std::move(remedy))
                 .value();
  }

  // Lists and names.

  void read_names(const List& list) {
    list_ = &list;
    const std::vector<std::string> texts = build_.parameters.texts(list.parameter);
    text_.clear();
    if (texts.size() > kMostParts)
      refuse(ErrorCode::too_large, fmt::format("there are {}", texts.size()),
             fmt::format("write {} at most: make two machines of this one", kMostParts));
    for (const std::string& text : texts) {
      text_ = text;
      const std::string name(part_name(text));
      const bool named = begins_with_name(text);
      if (!named) text_.clear();
      if (!named)
        refuse(ErrorCode::invalid_value,
               fmt::format("'{}' does not begin with a name and a colon", text.substr(0, 100)),
               fmt::format("use letters from a to z, digits and '_', and a letter first, as in '{}'; not air",
                           list.example));
      else if (!taken_.insert(name).second)
        refuse(ErrorCode::duplicate, "another part has the same name", "rename one of them");
    }
  }

  [[nodiscard]] std::vector<std::string> names_of(std::string_view list) const {
    std::vector<std::string> names;
    for (const std::string& text : build_.parameters.texts(list))
      names.emplace_back(part_name(text));
    return names;
  }

  /// Calls `read_part` with the part's fields at hand.
  template <class ReadPart>
  void each(std::string_view list, ReadPart read_part) {
    list_ = &*std::ranges::find(lists(), list, &List::parameter);
    for (const std::string& text : build_.parameters.texts(list)) {
      if (error_) return;
      text_ = text;
      fields_ = fields_of(text_);
      check_keys();
      read_part();
    }
  }

  void check_keys() {
    std::set<std::string> seen;
    for (const Field& field : fields_) {
      if (std::ranges::find(list_->keys, field.key) == list_->keys.end())
        refuse(ErrorCode::unknown_name, fmt::format("'{}' is not known", field.key),
               suggest(field.key, list_->keys, "") + fmt::format("; a comma parts them, as in '{}'", list_->example));
      else if (!seen.insert(field.key).second)
        refuse(ErrorCode::duplicate, fmt::format("'{}' is written twice", field.key), "leave one of them");
      else if (field.key == "oneway" && field.end > field.begin)
        refuse(ErrorCode::invalid_value, fmt::format("'{}' stands after 'oneway'", value_of(field)),
               "write a comma between them");
    }
  }

  // Memory.

  std::size_t keep(std::string name, double initial) {
    s_.memory.push_back(initial);
    s_.names.push_back(std::move(name));
    return s_.memory.size() - 1;
  }

  /// A slot for each part of a list; the first one.
  std::size_t keep_each(std::string_view list, const std::string& prefix, double initial) {
    const std::size_t first = s_.memory.size();
    for (const std::string& part : names_of(list))
      keep(prefix + part, initial);
    return first;
  }

  void show(const std::string& name, std::size_t si, double factor) { s_.shown.push_back({si, keep(name, 0), factor}); }

  void take_slots() {
    for (const PartValue& value : kPartValues) {
      const Unit unit = *parse_unit(value.unit);
      const std::vector<std::string> parts = names_of(value.list);
      const std::size_t first = keep_each(value.list, fmt::format("si{}.", value.ending), 0);
      s_.slots.*value.first = first;
      for (std::size_t i = 0; i < parts.size(); ++i)
        values_.push_back(
            {parts[i] + std::string(value.ending), unit, std::string(value.unit), first + i, unit.dimension, true});
    }
    for (const FormulaValue& value : values_)
      show(value.name, value.slot, value.unit->factor);
    s_.slots.primed = keep_each("pipes", "primed.", 0);
    s_.slots.open = keep_each("pipes", "open.", 1);
    s_.slots.wanted = keep_each("feeds", "wanted.", 0);
    s_.slots.vent = keep_each("vessels", "vent.", 0);
    const auto total = [&](const std::string& name) {
      const std::size_t si = keep("si." + name, 0);
      show(name + "_l", si, 1e-3);
      return si;
    };
    s_.slots.supplied = total("supplied");
    s_.slots.delivered = total("delivered");
    s_.slots.spilled = total("spilled");
  }

  // Values.

  [[nodiscard]] const Field* find(std::string_view key) const {
    const auto it = std::ranges::find(fields_, key, &Field::key);
    return it == fields_.end() ? nullptr : &*it;
  }
  [[nodiscard]] std::string value_of(const Field& field) const {
    return text_.substr(field.begin, field.end - field.begin);
  }
  /// Refuses where it is not written.
  const Field* need(std::string_view key) {
    const Field* field = find(key);
    if (field == nullptr)
      refuse(ErrorCode::missing, fmt::format("there is no '{}'", key),
             fmt::format("add it, as in '{}'", list_->example));
    return field;
  }

  Expression parse(const Field& field, const Dimension& wanted, const FormulaScope& scope) {
    if (error_) return {};
    auto expression =
        parse_expression({text_, field.begin, field.end, list_->parameter, build_.place(list_->parameter)}, scope);
    if (!expression) {
      error_ = expression.error();
      return {};
    }
    if (!fits(*expression, wanted))
      refuse(ErrorCode::conflict,
             fmt::format("'{}' is in {}, but '{}' takes {}", value_of(field), in_words(expression->dimension),
                         field.key, in_words(wanted)),
             fmt::format("give it a unit that makes {} of it", in_words(wanted)));
    return std::move(*expression);
  }

  /// What may change while the network runs.
  std::vector<Op> formula(std::string_view key, const Dimension& wanted) {
    const Field* field = find(key);
    if (field == nullptr) return {};
    Expression expression = parse(*field, wanted, {build_.description, values_, s_.memory});
    while (s_.names.size() < s_.memory.size())
      s_.names.push_back(fmt::format("sum.{}", s_.names.size()));
    return std::move(expression.ops);
  }

  double constant(const Field& field, const Dimension& wanted, double low, double high) {
    std::vector<double> no_memory;
    const std::vector<FormulaValue> no_values;
    const Expression expression = parse(field, wanted, {build_.description, no_values, no_memory});
    if (error_) return low;
    if (std::ranges::any_of(expression.ops, changes)) {
      refuse(ErrorCode::conflict, fmt::format("the '{}' would change", field.key),
             "write numbers with their units there");
      return low;
    }
    const double number = evaluate(expression.ops, {}, 0).value;
    if (number < low || number > high)
      refuse(ErrorCode::invalid_value, fmt::format("'{}' of '{}' is out of range", value_of(field), field.key),
             fmt::format("write from {:g} to {:g}{}", low, high,
                         wanted.is_number() ? "" : fmt::format(" {}", in_words(wanted))));
    return std::clamp(number, low, high);
  }
  double measure(std::string_view key, const Dimension& wanted, double low, double high,
                 std::optional<double> otherwise = std::nullopt) {
    const Field* field = otherwise ? find(key) : need(key);
    return field == nullptr ? otherwise.value_or(low) : constant(*field, wanted, low, high);
  }

  std::size_t vessel_called(const std::string& name) {
    const std::vector<std::string> vessels = names_of("vessels");
    const auto it = std::ranges::find(vessels, name);
    if (it != vessels.end()) return static_cast<std::size_t>(it - vessels.begin());
    refuse(ErrorCode::unknown_name, fmt::format("no vessel is called '{}'", name), suggest(name, vessels, ""));
    return 0;
  }
  std::size_t vessel(std::string_view key) {
    const Field* field = need(key);
    return field == nullptr ? 0 : vessel_called(value_of(*field));
  }

  /// "FLOAT.body", of a body that can move.
  BodyId body(std::string_view key) {
    const Field* field = need(key);
    if (field == nullptr) return {};
    const std::string value = value_of(*field);
    const std::size_t dot = std::min(value.find('.'), value.size());
    const BodyId id = build_.description.find_body(value.substr(0, dot));
    if (id && value.substr(dot) == ".body" && !build_.description.bodies[id.index()].fixed) return id;
    std::vector<std::string> bodies;
    for (const state::BodyDescription& each : build_.description.bodies) {
      if (!each.fixed) bodies.push_back(each.name + ".body");
    }
    refuse(ErrorCode::unknown_name, fmt::format("'{}' is not a movable body", value),
           suggest(value, bodies, "add a body that is not fixed") + "; it is written like FLOAT.body");
    return {};
  }

  // Parts.

  void read_vessel() {
    Vessel out;
    out.area_m2 = measure("area", kAreaDimension, 1e-6, 1e4);
    out.height_m = measure("height", kLengthDimension, 1e-3, 100);
    out.floor_m = measure("floor", kLengthDimension, -kHighest_m, kHighest_m, 0);
    const double start_m3 = measure("start", kVolumeDimension, 0, 1e6, 0);
    if (const Field* air = find("air")) out.air = air_called(value_of(*air));
    const double most_m3 = out.capacity_m3() * (out.air == kOpenAir ? 1 : 1 - kLeastStartAir);
    // Of a start that fills it, a rounded digit is not an error.
    if (start_m3 > most_m3 * (1 + 1e-9))
      refuse(ErrorCode::conflict, fmt::format("the start is more than the {:.6g} l that find room", most_m3 * 1e3),
             "start with less, or make it larger; a closed one needs a hundredth of air");
    VesselLoad load;
    load.vent = formula("vent", {});
    if (find("vent") != nullptr && out.air == kOpenAir)
      refuse(ErrorCode::missing, "there is a 'vent', but no 'air' that is shut in", "give the air a name: air BELL");
    if (find("on") != nullptr) load.body = body("on");
    const std::size_t i = s_.vessels.size();
    s_.memory[s_.slots.water + i] = std::min(start_m3, most_m3);
    s_.memory[s_.slots.level + i] = std::min(start_m3, most_m3) / out.area_m2;
    s_.vessels.push_back(out);
    s_.loads.push_back(std::move(load));
  }

  std::size_t air_called(const std::string& name) {
    if (!is_formula_name(name))
      refuse(ErrorCode::invalid_value, fmt::format("'{}' cannot be the name of an air", name),
             "name it, as in 'air BELL': vessels that name the same air share it");
    const auto it = std::ranges::find(airs_, name);
    if (it == airs_.end()) airs_.push_back(name);
    return static_cast<std::size_t>(std::ranges::find(airs_, name) - airs_.begin());
  }

  /// Every shut-in air begins at the pressure of the room.
  void fill_airs() {
    s_.airs = airs_.size();
    s_.slots.air = s_.memory.size();
    for (std::size_t air = 0; air < airs_.size(); ++air) {
      const Waters start{s_.vessels, std::span(s_.memory).subspan(s_.slots.water, s_.vessels.size()), {}};
      keep("air." + airs_[air], kAtmosphere_pa * air_volume_m3(start, air));
    }
  }

  void read_pipe() {
    Pipe out;
    const Field* from = need("from");
    const Field* to = need("to");
    if (from == nullptr || to == nullptr) return;
    read_end(*from, std::nullopt, out.from, out.from_m);
    read_end(*to, out.from_m, out.to, out.to_m);
    if (out.from == kOpenAir)
      refuse(ErrorCode::conflict, "no water comes from air", "let it come from a vessel, or write a feed");
    if (!error_ && out.from == out.to)
      refuse(ErrorCode::conflict, fmt::format("both ends are in '{}'", names_of("vessels")[out.from]),
             "lead it to another vessel, or to air");
    const double bore_m = measure("bore", kLengthDimension, 1e-4, 10);
    out.effective_m2 = measure("discharge", {}, 0.01, 1, 0.6) * kPi * bore_m * bore_m / 4;
    out.one_way = find("oneway") != nullptr;
    out.siphon = find("crest") != nullptr;
    out.crest_m = measure("crest", kLengthDimension, -kHighest_m, kHighest_m, 0);
    if (out.siphon && (out.crest_m < out.from_m || out.crest_m > out.from_m + kMostSuction_m))
      refuse(ErrorCode::conflict,
             fmt::format("the crest at {:g} m does not stand 0 to {:g} m over the mouth at {:g} m", out.crest_m,
                         kMostSuction_m, out.from_m),
             "write the height of its highest point; the atmosphere lifts water no further");
    s_.pipes.push_back(out);
    s_.open.push_back(formula("open", {}));
  }

  /// "TANK at 0.5 m", "air at 0.2 m"; without a height it is `otherwise`.
  void read_end(const Field& field, std::optional<double> otherwise, std::size_t& end, double& mouth_m) {
    const std::string value = value_of(field);
    const std::size_t at = std::min(value.find(" at "), value.size());
    const std::string name = value.substr(0, at);
    if (name != "air") end = vessel_called(name);
    if (error_) return;
    if (at < value.size()) {
      const Field height{field.key, field.begin + at + 4, field.end};
      mouth_m = constant(height, kLengthDimension, -kHighest_m, kHighest_m);
    } else if (otherwise) {
      mouth_m = *otherwise;
    } else {
      refuse(ErrorCode::missing, fmt::format("'{}' has no height", value),
             fmt::format("write one after it, as in '{}'", list_->example));
    }
    if (end == kOpenAir) return;
    const Vessel& its = s_.vessels[end];
    // Into an open vessel water may fall from above.
    const bool may_be_over = field.key == "to" && its.air == kOpenAir;
    if (mouth_m < its.floor_m || (mouth_m > its.floor_m + its.height_m && !may_be_over))
      refuse(ErrorCode::conflict,
             fmt::format("'{}' {:g} m is not between the floor and the rim of '{}'", field.key, mouth_m, name),
             fmt::format("write a height from {:g} to {:g} m", its.floor_m, its.floor_m + its.height_m));
  }

  void read_feed() {
    const std::size_t into = vessel("into");
    if (need("flow") != nullptr) s_.feeds.push_back({into, formula("flow", kFlowDimension)});
  }

  void read_float() {
    Float out;
    out.in = vessel("in");
    out.body = body("of");
    out.area_m2 = measure("area", kAreaDimension, 1e-6, 100);
    out.height_m = measure("height", kLengthDimension, 1e-3, 10);
    out.bottom_m = measure("bottom", kLengthDimension, -10, 10, -out.height_m / 2);
    if (error_) return;
    if (out.area_m2 > s_.vessels[out.in].area_m2)
      refuse(ErrorCode::conflict,
             fmt::format("it is wider than the vessel, which has {:g} m2", s_.vessels[out.in].area_m2),
             "give it a smaller area, or the vessel a larger one");
    const double mass_kg = build_.description.bodies[out.body.index()].mass_kg;
    if (out.area_m2 > kMostLift_m2_kg * mass_kg)
      refuse(ErrorCode::conflict, fmt::format("the body of {:g} kg is too light for the area", mass_kg),
             fmt::format("give it {:g} kg or more, or a smaller area", out.area_m2 / kMostLift_m2_kg));
    out.drag_n_s_m =
        2 * kFloatDamping * std::sqrt(kWaterDensity_kg_m3 * kGravity_m_s2 * out.area_m2 * std::max(0.0, mass_kg));
    s_.floats.push_back(out);
  }

  void count_steps() {
    std::size_t steps = 0;
    for (const std::vector<Op>& ops : s_.open)
      steps += ops.size();
    for (const Feed& feed : s_.feeds)
      steps += feed.flow.size();
    for (const VesselLoad& load : s_.loads)
      steps += load.vent.size();
    text_.clear();
    if (steps > kMostSteps)
      refuse(ErrorCode::too_large, fmt::format("the formulas have {} steps", steps),
             fmt::format("{} at most: make two machines of this one", kMostSteps));
  }

  const Build& build_;
  NetworkSettings s_;
  std::vector<FormulaValue> values_;
  std::set<std::string> taken_;
  std::vector<std::string> airs_;
  std::optional<Error> error_;
  // The part that is being read.
  const List* list_ = nullptr;
  std::string text_;
  std::vector<Field> fields_;
};

}  // namespace

std::span<const PartValue> part_values() {
  return kPartValues;
}

std::string_view part_name(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  // Without a colon too, so that a quantity finds its value, and the author hears of the colon.
  text = text.substr(0, text.find(':'));
  return text.substr(0, text.find_first_of(kBlanks));
}

Expected<NetworkSettings> read_network(const Build& build) {
  return NetworkReader(build).read();
}

}  // namespace mechane::machines
