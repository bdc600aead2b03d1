// Makes a world of a document: names become ids, X3D's physics nodes bodies and joints, metadata agents, machines and steps.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "server/base/error.hpp"
#include "server/geometry/solid/solid_mesh.hpp"
#include "server/scenario/solid.hpp"
#include "server/state/description.hpp"
#include "server/x3d/document.hpp"

namespace mechane::scenario {

/// Gives the compiler what is in mesh files. The server's loader makes and caches collision objects; a checker's only reads the files.
class ObjectLoader {
 public:
  virtual ~ObjectLoader() = default;
  /// The collision object of a node of a mesh file (its children named part_*, or each child mesh). Errors name the file and the node.
  /// `solid`: what of it is inside. A loader that builds nothing returns null.
  [[nodiscard]] virtual Expected<std::shared_ptr<const collision::Object>> load(const std::filesystem::path& file,
                                                                                const std::string& node,
                                                                                const geometry::SolidChoice& solid) = 0;
  /// Success where a mesh file has the node, for bodies that are only drawn; also from a loader that does not look into files.
  [[nodiscard]] virtual Expected<void> find_node(const std::filesystem::path&, const std::string&) { return {}; }
  /// The solid of a node's mesh, to check or compute a body's mass; none from a loader that does not look into files. This one imports the
  /// file at each call, so it is called only for bodies without an inertia. Errors: those of content::import_mesh and collision_parts.
  [[nodiscard]] virtual Expected<std::optional<Solid>> solid(const std::filesystem::path& file,
                                                             const std::string& node);
  /// Whether solid() costs little: then it is called for every body, to check the mass.
  [[nodiscard]] virtual bool has_meshes_at_hand() const { return false; }
  /// The hash of the file's bytes: content::content_hash(). Fails where the file cannot be read.
  [[nodiscard]] virtual Expected<std::string> content_hash(const std::filesystem::path& file) = 0;
};

/// What a loader's content_hash() returns: content::content_hash() of the file.
[[nodiscard]] Expected<std::string> hash_file(const std::filesystem::path& file);

/// Makes a world. Every name in it is resolved, and every component's parameters fit its type. All problems are added to `problems`; the
/// Error is the first error among them. Calls load() once for each touchable body. One thread, not in a tick; the same document and
/// meshes give the same description and content_hash.
[[nodiscard]] Expected<state::WorldDescription> compile(const x3d::Document& document, ObjectLoader& loader,
                                                        x3d::Problems& problems);

/// read_document and compile in one.
[[nodiscard]] Expected<state::WorldDescription> read_scenario(const std::filesystem::path& file, ObjectLoader& loader,
                                                              x3d::Problems& problems);

}  // namespace mechane::scenario
