// What an author adds to bodies: a joint between them, a Viewpoint on them. What they do not touch stays to the byte.
#pragma once

#include "client-sdk/studio/edits/body_edits.hpp"
#include "client-sdk/studio/edits/command.hpp"

namespace mechane::studio {

/// With a joint at the end of a RigidBodyCollection, whose own agent switches it on. A body that is fixed becomes body1, the side that
/// stands. Errors: unknown_name (no such body); conflict (one body twice, or nothing of it can move); missing (no collection after the
/// bodies); invalid_value (a name that cannot be one).
[[nodiscard]] Expected<Grown> with_joint(const x3d::Document& document, const JoinBodies& join);

/// With a Viewpoint after the last one of the scene, so that the first one stays the view that displays begin with. Errors:
/// invalid_value (a name that cannot be one).
[[nodiscard]] Expected<Grown> with_view(const x3d::Document& document, const AddView& view);

}  // namespace mechane::studio
