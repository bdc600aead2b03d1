// What a kiosk would show of a draft at rest, as the texts of its socket.
#pragma once

#include <string>
#include <vector>

#include "client-sdk/studio/shelf/shelf.hpp"
#include <mechane/client/types.hpp>

namespace mechane::gateway {

/// The mesh files of a scene, as KnownContent hears of them.
struct SceneMeshes {
  client::WorldStatus status;
  std::vector<client::SceneObject> objects;
};

/// {"scene": ..., "presentation": ...}, in the forms of STREAM.md. Shapes of the draft's own file become a .glb beside it, because browsers
/// do not read X3D. Imports the file in a child process, where it has any. Any thread but the loop's. Errors: those of the import and of
/// writing the file.
[[nodiscard]] Expected<std::string> draft_scene(const studio::CompiledDraft& draft, SceneMeshes& meshes);

/// A world as clients see it, after its way over the network.
[[nodiscard]] std::vector<client::SceneObject> scene_objects_of(const state::WorldDescription& world);
[[nodiscard]] client::WorldPresentation presentation_of(const state::WorldDescription& world);

}  // namespace mechane::gateway
