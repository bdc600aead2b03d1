// Many bodies of one RigidBody: the set `copies` in its mechane:body. They are ordinary bodies to all that comes after.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "server/scenario/compilation.hpp"
#include "server/x3d/shape_tree.hpp"

namespace mechane::scenario {
namespace {

/// The ways to say where copies stand; the keys that belong to each.
constexpr std::string_view kWays[] = {"step", "ringCentre", "positions"};

/// Whether exactly one way is given.
bool one_way(Compilation& c, const Fields& fields, int line) {
  std::vector<std::string> given;
  for (const std::string_view way : kWays)
    if (fields.given(way)) given.emplace_back(way);
  if (given.size() == 1) return true;
  if (given.empty()) {
    c.problems.error(
        ErrorCode::missing, line, fields.where(), "where the copies stand is not written",
        "add step for a row, step with columns and rowStep for a grid, ringCentre for a ring, or positions");
  } else {
    c.problems.error(ErrorCode::conflict, fields.line(given.back()), fields.where(),
                     fmt::format("{} both say where the copies stand", fmt::join(given, " and ")), "keep one of them");
  }
  return false;
}

/// Keys that need another one beside them.
void check_partners(Compilation& c, const Fields& fields) {
  constexpr std::pair<std::string_view, std::string_view> kNeeds[] = {
      {"columns", "rowStep"}, {"rowStep", "columns"}, {"columns", "step"}, {"ringAxis", "ringCentre"}};
  for (const auto& [key, needed] : kNeeds) {
    if (fields.given(key) && !fields.given(needed))
      c.problems.error(ErrorCode::conflict, fields.line(key), fields.where(),
                       fmt::format("{} does nothing without {}", key, needed),
                       fmt::format("add {}, or remove it", needed));
  }
}

bool is_whole(Compilation& c, const Fields& fields, std::string_view key) {
  const double number = fields.number(key);
  if (number == std::floor(number)) return true;
  c.problems.error(ErrorCode::invalid_value, fields.line(key), fields.where(),
                   fmt::format("{} is {}; it must be a whole number", key, number), "write a whole number");
  return false;
}

/// How many there are; 0 after a problem.
std::size_t count_of(Compilation& c, const Fields& fields) {
  const Key& count = copies_table().key("count", ValueKind::number);
  if (!fields.given("positions"))
    return fields.given("count") && is_whole(c, fields, "count") ? static_cast<std::size_t>(fields.number("count")) : 0;
  const std::size_t numbers = fields.numbers("positions").size();
  const double places = static_cast<double>(numbers) / 3;
  if (numbers % 3 != 0 || places < count.min || places > count.max) {
    c.problems.error(
        ErrorCode::invalid_value, fields.line("positions"), fields.where(),
        fmt::format("positions has {} numbers: three for each copy, {} to {} copies", numbers, count.min, count.max),
        "write x y z of each");
    return 0;
  }
  if (fields.given("count") && fields.number("count") != places)
    c.problems.error(ErrorCode::conflict, fields.line("count"), fields.where(),
                     fmt::format("count is {}, and positions has places for {}", fields.number("count"), places),
                     "remove count");
  return numbers / 3;
}

std::vector<Pose> in_rows(const Fields& fields, std::size_t count, const Pose& first) {
  const Vec3 step = fields.vector("step"), row_step = fields.vector("rowStep");
  const auto columns = fields.given("columns") ? static_cast<std::size_t>(fields.number("columns")) : count;
  std::vector<Pose> poses(count, first);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t column = i % columns, row = i / columns;
    poses[i].p += static_cast<double>(column) * step + static_cast<double>(row) * row_step;
  }
  return poses;
}

std::vector<Pose> in_ring(Compilation& c, const Fields& fields, std::size_t count, const Pose& first) {
  const Vec3 centre = fields.vector("ringCentre");
  Vec3 axis = fields.given("ringAxis") ? fields.vector("ringAxis") : Vec3(Vec3::UnitY());
  std::vector<Pose> poses(count, first);
  if (axis.norm() < 1e-9) {
    c.problems.error(ErrorCode::invalid_value, fields.line("ringAxis"), fields.where(), "ringAxis has no length",
                     "write a direction, like 0 1 0");
    return {};
  }
  axis.normalize();
  for (std::size_t i = 1; i < count; ++i) {
    const Quat turn(Eigen::AngleAxisd(2 * kPi * static_cast<double>(i) / static_cast<double>(count), axis));
    poses[i] = {centre + turn * (first.p - centre), (turn * first.R).normalized()};
  }
  return poses;
}

std::vector<Pose> as_listed(const Fields& fields, const Pose& first) {
  const std::vector<double> numbers = fields.numbers("positions");
  std::vector<Pose> poses(numbers.size() / 3, first);
  for (std::size_t i = 0; i < poses.size(); ++i)
    poses[i].p = Vec3(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
  return poses;
}

/// Two at one place would burst apart, and one too far away is not seen.
void check_places(Compilation& c, const Fields& fields, const std::string& name, const std::vector<Pose>& poses,
                  int line) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (poses[i].p.cwiseAbs().maxCoeff() > state::kFarthest_m) {
      c.problems.error(ErrorCode::invalid_value, line, fields.where(),
                       fmt::format("{} stands farther than {} m away", copy_name(name, i), state::kFarthest_m),
                       "write a shorter step, or fewer copies");
      return;
    }
    for (std::size_t j = 0; j < i; ++j) {
      if ((poses[i].p - poses[j].p).norm() > 1e-9) continue;
      c.problems.error(ErrorCode::conflict, line, fields.where(),
                       fmt::format("{} and {} stand at the same place", copy_name(name, j), copy_name(name, i)),
                       "let each step and each place differ");
      return;
    }
  }
}

/// What X3D itself says of the RigidBody cannot be meant of one copy.
void check_routes(Compilation& c, x3d::NodeId id, const std::string& name) {
  for (const x3d::RoutedFields& route : c.shapes.routes()) {
    if (route.to != id && route.from != id) continue;
    c.problems.error(ErrorCode::conflict, c.document[id].line, c.document.describe(id),
                     fmt::format("a ROUTE names {}, which is several bodies", name),
                     "write the body that events move as a RigidBody of its own, without copies");
    return;
  }
}

/// Other elements may have the DEF of a copy.
void check_names(Compilation& c, const Fields& fields, const std::string& name, std::size_t count, int line) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!c.document.find_def(copy_name(name, i))) continue;
    c.problems.error(ErrorCode::duplicate, line, fields.where(),
                     fmt::format("another element is called {}, as a copy is", copy_name(name, i)),
                     "rename one of the two");
    return;
  }
}

}  // namespace

std::string copy_name(const std::string& name, std::size_t index) {
  return fmt::format("{}-{}", name, index + 1);
}

std::vector<std::string> copies_in(const x3d::Document& document, x3d::NodeId body) {
  x3d::Problems ignored("");
  const auto set = x3d::read_metadata(document, body, "mechane:body", ignored);
  const x3d::Metadata* copies = set ? set->find("copies") : nullptr;
  if (copies == nullptr) return {};
  const Fields fields(copies, copies_table(), {}, ignored);
  const std::size_t count = fields.given("positions") ? fields.numbers("positions").size() / 3
                            : fields.given("count")   ? static_cast<std::size_t>(fields.number("count"))
                                                      : 0;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i)
    names.push_back(copy_name(x3d::node_name(document, body), i));
  return names;
}

std::vector<Pose> read_copies(Compilation& c, x3d::NodeId id, const Fields& body, const Pose& X_WB) {
  const x3d::Metadata* set = body.set("copies");
  if (set == nullptr) return {};
  const std::string name = x3d::node_name(c.document, id);
  const Fields fields(set, copies_table(), fmt::format("copies of {}", name), c.problems);
  const std::size_t count = count_of(c, fields);
  if (count == 0) return {};
  c.copies[name] = count;
  check_names(c, fields, name, count, set->line);
  check_routes(c, id, name);
  // After a problem they all stand where the first does: their names are known, and cause no more problems.
  std::vector<Pose> poses(count, X_WB);
  if (fields.has_faults() || !one_way(c, fields, set->line)) return poses;
  check_partners(c, fields);
  if (fields.given("columns") && !is_whole(c, fields, "columns")) return poses;
  if (fields.given("step")) poses = in_rows(fields, count, X_WB);
  if (fields.given("positions")) poses = as_listed(fields, X_WB);
  if (fields.given("ringCentre")) poses = in_ring(c, fields, count, X_WB);
  check_places(c, fields, name, poses, set->line);
  poses.resize(count, X_WB);
  return poses;
}

std::vector<std::string> all_copies(const Compilation& c, const std::string& name) {
  const auto found = name.ends_with("-*") ? c.copies.find(name.substr(0, name.size() - 2)) : c.copies.end();
  if (found == c.copies.end()) return {name};
  std::vector<std::string> names;
  for (std::size_t i = 0; i < found->second; ++i)
    names.push_back(copy_name(found->first, i));
  return names;
}

bool report_copies(Compilation& c, const Place& at, const std::string& name) {
  const bool all = name.ends_with("-*");
  const auto found = c.copies.find(all ? name.substr(0, name.size() - 2) : name);
  if (found == c.copies.end()) return false;
  const auto& [def, count] = *found;
  c.problems.error(ErrorCode::unknown_name, at.line, at.text,
                   fmt::format("'{}' is {} bodies, and one is wanted here", name, count),
                   fmt::format("name one of {} to {}; lists of bodies and object:{}-* take all at once",
                               copy_name(def, 0), copy_name(def, count - 1), def));
  return true;
}

std::vector<BodyId> bodies_of(const Compilation& c, x3d::NodeId id) {
  const std::string name = x3d::node_name(c.document, id);
  std::vector<BodyId> bodies;
  for (const std::string& one : c.copies.contains(name) ? all_copies(c, name + "-*") : std::vector{name})
    if (const BodyId body = c.world.find_body(one)) bodies.push_back(body);
  return bodies;
}

}  // namespace mechane::scenario
