// From a document to a world: names become ids, X3D's physics nodes become bodies and joints, metadata become agents, machines, steps.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "server/base/error.hpp"
#include "server/scenario/solid.hpp"
#include "server/state/description.hpp"
#include "server/x3d/document.hpp"

namespace mechane::scenario {

/// Where mesh files come from. The server's makes and caches collision objects; a checker's only looks whether the file is there.
class ObjectLoader {
 public:
  virtual ~ObjectLoader() = default;
  /// The collision object of a node of a mesh file (its children named part_*, or each child mesh). Errors name the file and the node.
  /// A loader that builds nothing returns null.
  [[nodiscard]] virtual Expected<std::shared_ptr<const collision::Object>> load(const std::filesystem::path& file,
                                                                                const std::string& node) = 0;
  /// Whether a mesh file has a node, for bodies that are only drawn. A loader that does not look says yes.
  [[nodiscard]] virtual Expected<void> find_node(const std::filesystem::path&, const std::string&) { return {}; }
  /// What the mesh of a node says of a body's mass; nothing from a loader that does not look into meshes. This one imports the file anew,
  /// and is asked only for bodies whose inertia is not given. Errors: those of content::import_mesh and collision_parts.
  [[nodiscard]] virtual Expected<std::optional<Solid>> solid(const std::filesystem::path& file,
                                                             const std::string& node);
  /// Whether solid() costs little: it is then asked for every body, to check the mass.
  [[nodiscard]] virtual bool has_meshes_at_hand() const { return false; }
  /// The name of the file's bytes: content::content_hash(). Fails where the file cannot be read.
  [[nodiscard]] virtual Expected<std::string> content_hash(const std::filesystem::path& file) = 0;
};

/// What a loader's content_hash() is: content::content_hash() of the file.
[[nodiscard]] Expected<std::string> hash_file(const std::filesystem::path& file);

/// A world. Every name in it is resolved; every component's parameters hold against its type's schema. All problems go to `problems`,
/// errors and warnings; the Error is the first error. Calls the loader once a touchable body. One thread, not in a tick; the same
/// document and meshes give the same description and content_hash.
[[nodiscard]] Expected<state::WorldDescription> compile(const x3d::Document& document, ObjectLoader& loader,
                                                        x3d::Problems& problems);

/// read_document and compile in one.
[[nodiscard]] Expected<state::WorldDescription> read_scenario(const std::filesystem::path& file, ObjectLoader& loader,
                                                              x3d::Problems& problems);

}  // namespace mechane::scenario
