// Edits of whole bodies: a part of the library comes in, a body is copied, taken out or moved. Each gives the new text; what they do not
// touch stays to the byte.
#pragma once

#include <string>
#include <string_view>

#include "client-sdk/studio/edits/command.hpp"
#include "server/base/error.hpp"
#include "server/x3d/document.hpp"

namespace mechane::studio {

/// A text to which something of a new DEF was added.
struct Grown {
  std::string text;
  std::string name;
};

/// Into the first RigidBodyCollection; one is made where there is none. Errors: unknown_name (no such part), invalid_value (a name that
/// cannot be one).
[[nodiscard]] Expected<Grown> with_part(const x3d::Document& document, const InsertPart& insert);

/// A body of a mesh file in the same way, with an Inline of the file where none with a DEF names it. Errors: invalid_value (a name that
/// cannot be one).
[[nodiscard]] Expected<Grown> with_mesh(const x3d::Document& document, const InsertMesh& insert);

/// A copy of a RigidBody after it, with shapes of its own, but the same appearances. Errors: unknown_name.
[[nodiscard]] Expected<Grown> with_copy(const x3d::Document& document, const DuplicateBody& duplicate);

/// Without a body, its joints, the collidables that only it had, and the ROUTEs from and to all these; or without another node of that
/// DEF and its ROUTEs. What else names it stays, and is a problem then. Errors: unknown_name; conflict where something else uses it.
[[nodiscard]] Expected<std::string> without_node(const x3d::Document& document, const std::string& node);

/// A body, a Transform or a Viewpoint at a pose in W; with a body the Transforms that show it (by ROUTEs from it). Errors: unknown_name;
/// not_supported for other nodes, and for what stands in a scaled group.
[[nodiscard]] Expected<std::string> with_pose(const x3d::Document& document, const MoveNode& move);

/// Adds an empty set of ours ("mechane:haptic") to the node of that DEF. The node must not have it. Errors: unknown_name.
[[nodiscard]] Expected<std::string> with_own_set(const x3d::Document& document, const std::string& node,
                                                 const std::string& set);

/// A DEF that nothing in the file has: the name itself, or with a number behind it.
[[nodiscard]] std::string free_name(const x3d::Document& document, const std::string& name);

[[nodiscard]] bool is_joint(const x3d::Document& document, x3d::NodeId id);
[[nodiscard]] bool is_collidable(const x3d::Document& document, x3d::NodeId id);

/// Whether XML, formulas and sources take it as one word: letters a-z, digits, '-' and '_', with a letter first.
[[nodiscard]] bool is_new_name(std::string_view name);
[[nodiscard]] tl::unexpected<Error> no_new_name(const std::string& name);

}  // namespace mechane::studio
