#include "client-sdk/studio/edits/command.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client-sdk/studio/edits/request_fields.hpp"
#include "server/base/utf8.hpp"

namespace mechane::studio {
namespace {

using CommandJson = nlohmann::json;

constexpr int kDeepest = 8;
constexpr std::size_t kLongestText = 16'000, kLongestPath = 500, kMostValues = 2'000, kLongestMeta = 2'000;
constexpr double kFarthestMove_m = state::kFarthest_m, kShortestDirection = 1e-6;
/// In the order of state::JointKind.
constexpr std::array<std::string_view, 3> kJointKinds{"hinge", "slider", "ball"};
constexpr double kWidestView_rad = 3.1;
constexpr std::array<std::string_view, 6> kNameKinds{"thing", "quantity", "activity", "step", "visit", "effect"};

class CommandFields : public RequestFields {
 public:
  using RequestFields::RequestFields;

  std::string text(const char* name, std::size_t longest = kLongestPath) {
    const CommandJson* value = find(name);
    if (value != nullptr && value->is_string() && !is_empty_text(name) &&
        value->get_ref<const std::string&>().size() <= longest)
      return *value;
    blame(name, fmt::format("a text of 1 to {} bytes", longest));
    return {};
  }
  [[nodiscard]] bool is_empty_text(const char* name) const {
    const CommandJson* value = find(name);
    return value != nullptr && value->is_string() && value->get_ref<const std::string&>().empty();
  }
  std::string text_or_none(const char* name) { return has(name) && !is_empty_text(name) ? text(name) : std::string(); }
  template <std::size_t Count>
  std::array<double, Count> numbers(const char* name) {
    std::array<double, Count> out{};
    const CommandJson* value = find(name);
    bool right = value != nullptr && value->is_array() && value->size() == Count;
    for (std::size_t i = 0; right && i < Count; ++i) {
      right = (*value)[i].is_number();
      if (right) out[i] = (*value)[i].get<double>();
      right = right && std::abs(out[i]) <= kFarthestMove_m;  // false of what is not finite
    }
    if (!right) blame(name, fmt::format("a list of {} numbers", Count));
    return out;
  }
  Vec3 point(const char* name) {
    const auto p = numbers<3>(name);
    return {p[0], p[1], p[2]};
  }
  /// Of any length that can be a direction's; of length 1 then.
  Vec3 direction(const char* name) {
    const Vec3 given = point(name);
    if (given.norm() >= kShortestDirection) return given.normalized();
    blame(name, "[x, y, z], a direction, such as [0, 0, 1]");
    return Vec3::UnitY();
  }
  double amount(const char* name, double least, double most) {
    const CommandJson* value = find(name);
    const double given = value != nullptr && value->is_number() ? value->get<double>() : -1;
    if (given >= least && given <= most) return given;
    blame(name, fmt::format("a number of {} to {}", least, most));
    return most;
  }
  Pose pose(const char* name) {
    const auto n = numbers<7>(name);
    const Quat R(n[6], n[3], n[4], n[5]);
    if (R.norm() < 0.5 || R.norm() > 2) {
      blame(name, "[x, y, z, qx, qy, qz, qw], with a unit quaternion");
      return {};
    }
    return {{n[0], n[1], n[2]}, R.normalized()};
  }
  std::int64_t whole_number(const char* name) {
    const CommandJson* value = find(name);
    if (value != nullptr && value->is_number_integer() && value->get<double>() >= 0 && value->get<double>() < 1e15)
      return value->get<std::int64_t>();
    blame(name, "a whole number");
    return 0;
  }
  state::Parameter value(const char* name) {
    const CommandJson* given = find(name);
    if (given != nullptr)
      if (auto read = value_of(*given)) return *read;
    blame(name, "a number, true, false, a text, or a list of numbers or of texts");
    return false;
  }

 private:
  static std::optional<state::Parameter> value_of(const CommandJson& given) {
    if (given.is_boolean()) return state::Parameter(given.get<bool>());
    const bool list = given.is_array();
    const std::size_t count = list ? given.size() : 1;
    if (count == 0 || count > kMostValues) return std::nullopt;
    std::vector<double> numbers;
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < count; ++i) {
      const CommandJson& one = list ? given[i] : given;
      if (one.is_number() && std::isfinite(one.get<double>())) numbers.push_back(one.get<double>());
      if (one.is_string() && one.get_ref<const std::string&>().size() <= kLongestText) texts.push_back(one);
    }
    if (count == 1 && list && given[0].is_boolean()) return state::Parameter(given[0].get<bool>());
    if (numbers.size() == count) return state::Parameter(std::move(numbers));
    if (texts.size() == count) return state::Parameter(std::move(texts));
    return std::nullopt;
  }
};

Expected<CommandJson> parse_json(std::string_view text) {
  if (text.size() > kMostCommandBytes)
    return fail(ErrorCode::too_large, "this request is too long", "", "send fewer commands at a time");
  CommandJson json = parse_shallow(text, kDeepest);
  if (!json.is_object())
    return fail(ErrorCode::invalid_value, "this request is not a JSON object", "", "send an object {...}");
  return json;
}

Command rename_of(CommandFields& fields) {
  const std::string kind = fields.text("kind");
  const auto known = std::find(kNameKinds.begin(), kNameKinds.end(), kind);
  if (known == kNameKinds.end()) fields.blame("kind", "thing, quantity, activity, step, visit or effect");
  const auto number = known == kNameKinds.end() ? 0 : known - kNameKinds.begin();
  return RenameEverywhere{static_cast<NameKind>(number), fields.text("from"), fields.text("to")};
}

Command join_of(CommandFields& fields) {
  const std::string kind = fields.text("kind");
  const auto known = std::find(kJointKinds.begin(), kJointKinds.end(), kind);
  if (known == kJointKinds.end()) {
    fields.blame("kind", "hinge, slider or ball");
    return RemoveEntry{};
  }
  JoinBodies join;
  join.kind = static_cast<state::JointKind>(known - kJointKinds.begin());
  join.body1 = fields.text("body1");
  join.body2 = fields.text_or_none("body2");
  if (join.kind != state::JointKind::slider) join.p_WA = fields.point("anchor");
  if (join.kind != state::JointKind::ball) join.axis_W = fields.direction("axis");
  join.name = fields.text_or_none("name");
  return join;
}

Command view_of(CommandFields& fields) {
  AddView view{fields.text_or_none("name"), fields.pose("pose"), 0, fields.text_or_none("description")};
  if (fields.has("fieldOfView")) view.field_of_view_rad = fields.amount("fieldOfView", 0.01, kWidestView_rad);
  return view;
}

Command command_of(const std::string& op, CommandFields& fields) {
  if (op == "set") return SetValue{fields.text("path"), fields.value("value")};
  if (op == "add") return AddSet{fields.text("path"), fields.text_or_none("after")};
  if (op == "reorder") return ReorderSet{fields.text("path"), fields.text_or_none("after")};
  if (op == "remove") return RemoveEntry{fields.text("path")};
  if (op == "field") {
    // An empty value is one: that of an empty list.
    const bool empty = fields.is_empty_text("value");
    return SetField{fields.text("node"), fields.text("field"), empty ? "" : fields.text("value", kLongestText)};
  }
  if (op == "rename") return rename_of(fields);
  if (op == "insert" && fields.has("url"))
    return InsertMesh{fields.text("url"), fields.text("node"), fields.amount("mass", 0.001, 1e6),
                      fields.text_or_none("name"), fields.point("position")};
  if (op == "insert") return InsertPart{fields.text("part"), fields.text_or_none("name"), fields.point("position")};
  if (op == "duplicate") {
    DuplicateBody duplicate{fields.text("node"), std::nullopt};
    if (fields.has("position")) duplicate.p_WB = fields.point("position");
    return duplicate;
  }
  if (op == "delete") return DeleteNode{fields.text("node")};
  if (op == "move") return MoveNode{fields.text("node"), fields.pose("pose")};
  if (op == "join") return join_of(fields);
  if (op == "view") return view_of(fields);
  if (op == "meta") {
    const bool empty = fields.is_empty_text("value");
    return SetMeta{fields.text("name"), empty ? "" : fields.text("value", kLongestMeta)};
  }
  fields.blame("op", "set, add, reorder, remove, field, rename, insert, duplicate, delete, move, join, view or meta");
  return RemoveEntry{};
}

Expected<Command> read_command(const CommandJson& json, const std::string& where) {
  CommandFields fields(json, where);
  const std::string op = fields.text("op");
  Command command = command_of(op, fields);
  if (!fields.right()) return fields.fault();
  return command;
}

std::string last_of(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}

}  // namespace

Expected<CommandList> parse_command_list(std::string_view text) {
  const auto json = parse_json(text);
  if (!json) return tl::unexpected(json.error());
  CommandFields fields(*json, "");
  CommandList list;
  list.revision = fields.whole_number("revision");
  const CommandJson* commands = fields.find("commands");
  const bool listed =
      commands != nullptr && commands->is_array() && !commands->empty() && commands->size() <= kMostCommands;
  if (!listed) fields.blame("commands", fmt::format("a list of 1 to {} commands", kMostCommands));
  if (!fields.right()) return fields.fault();
  for (std::size_t i = 0; i < commands->size(); ++i) {
    auto command = read_command((*commands)[i], fmt::format("commands/{}", i));
    if (!command) return tl::unexpected(command.error());
    list.commands.push_back(std::move(*command));
  }
  return list;
}

Expected<Command> parse_command(std::string_view text) {
  const auto json = parse_json(text);
  if (!json) return tl::unexpected(json.error());
  return read_command(*json, "");
}

Expected<TrialRequest> parse_trial(std::string_view text) {
  const auto json = parse_json(text);
  if (!json) return tl::unexpected(json.error());
  CommandFields fields(*json, "");
  TrialRequest request{fields.whole_number("revision"), fields.text_or_none("step")};
  if (!fields.right()) return fields.fault();
  return request;
}

Expected<std::int64_t> parse_revision(std::string_view text) {
  const auto json = parse_json(text);
  if (!json) return tl::unexpected(json.error());
  CommandFields fields(*json, "");
  const std::int64_t revision = fields.whole_number("revision");
  if (!fields.right()) return fields.fault();
  return revision;
}

Expected<std::string> parse_stated(std::string_view text, std::string_view field, std::size_t longest) {
  const auto json = parse_json(text);
  if (!json) return tl::unexpected(json.error());
  CommandFields fields(*json, "");
  std::string stated = fields.text(std::string(field).c_str(), longest);
  if (!fields.right()) return fields.fault();
  return stated;
}

std::string title_of(const Command& command) {
  struct Titles {
    std::string operator()(const SetValue& c) const { return "set " + last_of(c.path); }
    std::string operator()(const AddSet& c) const { return "add " + last_of(c.path); }
    std::string operator()(const ReorderSet& c) const { return "move " + last_of(c.path); }
    std::string operator()(const RemoveEntry& c) const { return "remove " + last_of(c.path); }
    std::string operator()(const SetField& c) const { return fmt::format("set {} of {}", c.field, c.node); }
    std::string operator()(const RenameEverywhere& c) const { return fmt::format("rename {} to {}", c.from, c.to); }
    std::string operator()(const InsertPart& c) const { return "insert " + c.part; }
    std::string operator()(const InsertMesh& c) const { return "insert " + last_of(c.url); }
    std::string operator()(const DuplicateBody& c) const { return "duplicate " + c.node; }
    std::string operator()(const DeleteNode& c) const { return "delete " + c.node; }
    std::string operator()(const MoveNode& c) const { return "move " + c.node; }
    std::string operator()(const JoinBodies& c) const {
      return fmt::format("{} of {}", kJointKinds.at(static_cast<std::size_t>(c.kind)),
                         c.body2.empty() ? c.body1 : fmt::format("{} and {}", c.body1, c.body2));
    }
    std::string operator()(const AddView& c) const { return c.name.empty() ? "add a view" : "add view " + c.name; }
    std::string operator()(const SetMeta& c) const { return "set " + c.name; }
  };
  return std::string(utf8_beginning(std::visit(Titles{}, command), 100));
}

std::string title_of(const std::vector<Command>& commands) {
  const std::string first = commands.empty() ? "" : title_of(commands.front());
  return commands.size() < 2 ? first : fmt::format("{}, and {} more", first, commands.size() - 1);
}

std::string_view word_of(NameKind kind) {
  return kNameKinds.at(static_cast<std::size_t>(kind));
}

}  // namespace mechane::studio
