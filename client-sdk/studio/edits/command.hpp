// The commands by which a draft is changed, as values; COMMANDS.md has their JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "server/base/error.hpp"
#include "server/base/math.hpp"
#include "server/state/component_type.hpp"
#include "server/state/description.hpp"

namespace mechane::studio {

/// `path` as authoring::Editor's: "activities/use/steps/fill/hintSeconds", "INNER/mechane:haptic/stiffness".
struct SetValue {
  std::string path;
  state::Parameter value;
};
struct AddSet {
  std::string path;
  std::string after;  ///< a sibling; empty: as the last one
};
/// A set of the metadata to another place among its siblings.
struct ReorderSet {
  std::string path;
  std::string after;  ///< a sibling; empty: before the others
};
struct RemoveEntry {
  std::string path;
};
/// A field of the X3D node with that DEF, as X3D writes it.
struct SetField {
  std::string node;
  std::string field;
  std::string value;
};
enum class NameKind : std::uint8_t { thing, quantity, activity, step, visit, effect };
struct RenameEverywhere {
  NameKind kind = NameKind::thing;
  std::string from;
  std::string to;
};
/// A part of the library.
struct InsertPart {
  std::string part;
  std::string name;  ///< its DEF; empty, or taken: a free one
  Vec3 p_WB = Vec3::Zero();
};
/// A body whose shape is a node of a mesh file.
struct InsertMesh {
  std::string url;   ///< as the exhibit's file names it: "files/arm.glb"
  std::string node;  ///< in the mesh file
  double mass_kg = 0;
  std::string name;  ///< its DEF; empty, or taken: a free one
  Vec3 p_WB = Vec3::Zero();
};
/// A body with its shapes; its joints stay with the first one.
struct DuplicateBody {
  std::string node;
  std::optional<Vec3> p_WB;  ///< none: beside the first one
};
/// A body with its shapes, its joints and the ROUTEs to it; or another node that nothing uses.
struct DeleteNode {
  std::string node;
};
struct MoveNode {
  std::string node;
  Pose X_WB;
};
/// A joint of two bodies, body2 moving against body1; or of one and the room. All in W as it stands at the start.
struct JoinBodies {
  state::JointKind kind = state::JointKind::hinge;
  std::string body1;
  std::string body2;            ///< empty: the room
  Vec3 p_WA = Vec3::Zero();     ///< the anchor; a slider has none
  Vec3 axis_W = Vec3::UnitY();  ///< of length 1; a ball has none
  std::string name;             ///< its DEF; empty, or taken: a free one
};
/// A Viewpoint where an author looks from.
struct AddView {
  std::string name;              ///< its DEF; empty, or taken: a free one
  Pose X_WV;                     ///< the eye looks along -z, y up
  double field_of_view_rad = 0;  ///< 0: X3D's own
  std::string description;       ///< its name in lists; empty: none
};
/// What the file says of itself: <meta name='license' content='CC0-1.0'/>.
struct SetMeta {
  std::string name;
  std::string value;  ///< empty: it says nothing of that
};
using Command = std::variant<SetValue, AddSet, ReorderSet, RemoveEntry, SetField, RenameEverywhere, InsertPart,
                             InsertMesh, DuplicateBody, DeleteNode, MoveNode, JoinBodies, AddView, SetMeta>;

/// Commands for one revision of a draft: one step.
struct CommandList {
  std::int64_t revision = 0;
  std::vector<Command> commands;
};

inline constexpr std::size_t kMostCommandBytes = std::size_t{64} << 10U;
inline constexpr std::size_t kMostCommands = 500;

/// Reads {"revision": 3, "commands": [...]}. Errors: too_large; invalid_value, with the command: "commands/2/path".
[[nodiscard]] Expected<CommandList> parse_command_list(std::string_view json);
/// One command. Errors: the same, with the field.
[[nodiscard]] Expected<Command> parse_command(std::string_view json);
/// {"revision": 3, "step": "use/lift"}: what is tried, and from where; no step: from the beginning. Errors: too_large, invalid_value.
struct TrialRequest {
  std::int64_t revision = 0;
  std::string step;
};
[[nodiscard]] Expected<TrialRequest> parse_trial(std::string_view json);
/// The revision of {"revision": 3}, and {"title": "..."}; `longest` in bytes. Errors: invalid_value.
[[nodiscard]] Expected<std::int64_t> parse_revision(std::string_view json);
[[nodiscard]] Expected<std::string> parse_stated(std::string_view json, std::string_view field, std::size_t longest);

/// What a command does, in a few words for the list of steps: "set hintSeconds".
[[nodiscard]] std::string title_of(const Command& command);
[[nodiscard]] std::string title_of(const std::vector<Command>& commands);

[[nodiscard]] std::string_view word_of(NameKind kind);

}  // namespace mechane::studio
