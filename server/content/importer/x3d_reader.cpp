#include "server/content/importer/x3d_reader.hpp"

#include <algorithm>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "server/content/importer/x3d_geometry.hpp"
#include "server/content/importer/x3d_looks.hpp"
#include "server/x3d/node_check.hpp"
#include "server/x3d/shape_tree.hpp"

namespace mechane::content {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostInlines = 8;   // one within another
constexpr std::size_t kMostLevels = 500;  // of groups; USEs can nest them more deeply than elements

/// One file, and what is drawn of it.
struct Source {
  x3d::Document document;
  x3d::ShapeTree tree;

  explicit Source(x3d::Document read) : document(std::move(read)), tree(document) {}
};

Eigen::Affine3d rigid(const Vec3& p, const Quat& R) {
  return Eigen::Affine3d(Eigen::Translation3d(p) * R);
}

/// Where a Transform places what it holds, but for its `translation` and `rotation`: its scale, and its centre of rotation.
Eigen::Affine3d rest_of(const x3d::NodeFields& transform) {
  const Eigen::Translation3d centre(transform.vector("center"));
  const Quat R = transform.rotation("rotation"), S = transform.rotation("scaleOrientation");
  const Vec3 scale = transform.vector("scale");
  return R.conjugate() * centre * R * S * Eigen::Scaling(scale) * S.conjugate() * centre.inverse();
}

class SceneReader {
 public:
  SceneReader(const fs::path& folder, const ImportLimits& limits)
      : limits_(limits), io_(folder, limits.file_bytes), looks_(io_, scene_) {}

  Expected<ImportedScene> read(const fs::path& file) {
    const auto source = open(file);
    if (!source) return tl::unexpected(source.error());
    const x3d::Document& document = (*source)->document;
    const x3d::ShapeTree& tree = (*source)->tree;
    for (const x3d::NodeId body : tree.bodies()) {
      const x3d::NodeFields fields(document, body);
      if (auto good = add(**source, body, rigid(fields.vector("position"), fields.rotation("orientation")), {}); !good)
        return tl::unexpected(good.error());
      const x3d::NodeId picture = tree.picture_of(body);
      if (!picture) continue;
      if (auto good = add_group(**source, picture, {}); !good) return tl::unexpected(good.error());
    }
    for (const x3d::NodeId driven : tree.driven()) {
      if (auto good = add_group(**source, driven, {}); !good) return tl::unexpected(good.error());
    }
    if (!tree.has_scenery()) return std::move(scene_);
    if (auto good = add(**source, document.scene(), Eigen::Affine3d::Identity(), {}); !good)
      return tl::unexpected(good.error());
    return std::move(scene_);
  }

 private:
  using Parent = std::optional<std::uint32_t>;

  /// Reads and checks a file; once, however often it is named.
  Expected<const Source*> open(const fs::path& file) {
    auto& known = sources_[file];
    if (known) return known.get();
    x3d::Problems problems("");
    auto document = x3d::read_document(file, problems);
    if (document) x3d::check_nodes(*document, problems);
    if (problems.has_errors()) {
      Error error = problems.first_error();
      const auto first =
          std::ranges::find(problems.all(), x3d::Severity::error, [](const x3d::Problem& p) { return p.severity; });
      error.line = first->line;
      error.where = fmt::format("line {}{}{}", first->line, first->node.empty() ? "" : ", ", first->node);
      return tl::unexpected(std::move(error));
    }
    known = std::make_unique<Source>(std::move(*document));
    return known.get();
  }

  std::uint32_t add_node(std::string name, const Eigen::Affine3d& X_PN, Parent parent) {
    scene_.nodes.push_back({std::move(name), parent, X_PN, {}});
    return static_cast<std::uint32_t>(scene_.nodes.size() - 1);
  }

  /// An element with all that is drawn below it.
  Expected<void> add(const Source& from, x3d::NodeId id, const Eigen::Affine3d& X_PN, Parent parent) {
    const std::string name = id == from.document.scene() && !parent ? x3d::kScenery : x3d::node_name(from.document, id);
    const std::uint32_t node = add_node(name, X_PN, parent);
    return add_children(from, id, node);
  }

  Expected<void> add_children(const Source& from, x3d::NodeId id, std::uint32_t node) {
    if (++levels_ > kMostLevels || scene_.nodes.size() > limits_.nodes) {
      return fail_at(from.document, id, ErrorCode::too_large,
                     fmt::format("shapes are nested more than {} deep, or have more than {} nodes with all USEs",
                                 kMostLevels, limits_.nodes),
                     "simplify the scene");
    }
    for (const x3d::NodeId child : from.tree.children(id)) {
      if (auto good = add_one(from, child, node); !good) return good;
    }
    --levels_;
    return {};
  }

  Expected<void> add_one(const Source& from, x3d::NodeId id, std::uint32_t parent) {
    const std::string& type = from.document[id].name;
    if (type == "Shape") return add_shape(from, id, parent);
    if (type == "Inline") return add_inline(from, id, parent);
    if (type == "CollidableShape" || type == "CollidableOffset") {
      const x3d::NodeFields fields(from.document, id);
      return add(from, id, rigid(fields.vector("translation"), fields.rotation("rotation")), parent);
    }
    if (type == "Transform") return add_group(from, id, parent);
    return add(from, id, Eigen::Affine3d::Identity(), parent);
  }

  /// A Transform as two nodes: one where it places its frame, which is a body's, and within it the rest.
  Expected<void> add_group(const Source& from, x3d::NodeId id, Parent parent) {
    const x3d::NodeFields fields(from.document, id);
    std::uint32_t node = add_node(x3d::node_name(from.document, id),
                                  rigid(fields.vector("translation"), fields.rotation("rotation")), parent);
    const Eigen::Affine3d rest = rest_of(fields);
    if (!rest.isApprox(Eigen::Affine3d::Identity())) node = add_node("", rest, node);
    return add_children(from, id, node);
  }

  Expected<void> add_inline(const Source& from, x3d::NodeId id, std::uint32_t parent) {
    const fs::path named = from.document.path().parent_path() / x3d::inlined_x3d(from.document, id);
    const auto file = io_.allowed(named);
    if (!file) {
      return fail_at(from.document, id, ErrorCode::not_found,
                     fmt::format("the file '{}' is not in the scenario's folder", named.filename().string()),
                     "put it there, and write its path from this file");
    }
    if (++inlines_ > kMostInlines) {
      return fail_at(from.document, id, ErrorCode::too_large,
                     fmt::format("files name each other more than {} deep", kMostInlines), "put them into one file");
    }
    const auto source = open(*file);
    if (!source) {
      Error error = source.error().in(file->filename().string());
      error.line = 0;
      return tl::unexpected(std::move(error));
    }
    const std::uint32_t node = add_node(x3d::node_name(from.document, id), Eigen::Affine3d::Identity(), parent);
    auto added = add_children(**source, (*source)->document.scene(), node);
    if (!added && !inlined_error_) {
      added = tl::unexpected(added.error().in(file->filename().string()));
      added.error().line = 0;  // it is not a line of the outermost file
      inlined_error_ = true;
    }
    --inlines_;
    return added;
  }

  Expected<void> add_shape(const Source& from, x3d::NodeId id, std::uint32_t parent) {
    const x3d::NodeFields shape(from.document, id);
    const std::uint32_t node = add_node(x3d::node_name(from.document, id), Eigen::Affine3d::Identity(), parent);
    const auto key = std::pair(&from.document, id);
    const auto known = shapes_.find(key);
    if (known != shapes_.end()) {
      scene_.nodes[node].meshes.push_back(known->second);
      return {};
    }
    const x3d::NodeId geometry = shape.node("geometry");
    const auto faces = faces_of(from.document, geometry, limits_.vertices - vertices_);
    if (!faces) return tl::unexpected(faces.error());
    const auto material = looks_.material(from.document, shape.node("appearance"), faces->seen_from_both_sides);
    if (!material) return tl::unexpected(material.error());
    const ImportedMaterial& look = scene_.materials[*material];
    const bool textured = look.base_colour_texture || look.emissive_texture || look.metallic_roughness_texture;
    ImportedMesh mesh = mesh_of(*faces, textured);
    mesh.name = x3d::node_name(from.document, id);
    mesh.material = *material;
    vertices_ += mesh.positions.size();
    const auto index = static_cast<std::uint32_t>(scene_.meshes.size());
    scene_.meshes.push_back(std::move(mesh));
    shapes_[key] = index;
    scene_.nodes[node].meshes.push_back(index);
    return {};
  }

  const ImportLimits& limits_;
  FolderIo io_;
  ImportedScene scene_;
  X3dLooks looks_;
  std::map<fs::path, std::unique_ptr<Source>> sources_;
  std::map<std::pair<const x3d::Document*, x3d::NodeId>, std::uint32_t> shapes_;  // meshes of Shapes
  std::uint64_t vertices_ = 0;
  std::size_t levels_ = 0;
  std::size_t inlines_ = 0;
  bool inlined_error_ = false;  // its file has been named
};

}  // namespace

Expected<ImportedScene> read_x3d(const fs::path& file, const ImportLimits& limits) {
  return SceneReader(file.parent_path(), limits).read(file);
}

}  // namespace mechane::content
