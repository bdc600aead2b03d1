#include "client-sdk/fit/fit_mesh.hpp"

#include <algorithm>

#include "client-sdk/fit/output_file.hpp"
#include "client-sdk/fit/report_html.hpp"
#include "client-sdk/fit/summary_json.hpp"
#include "server/base/whole_file.hpp"
#include "server/collision/object_io.hpp"
#include "server/content/content_hash.hpp"
#include "server/content/mesh_import.hpp"
#include "server/geometry/solid/mesh_orient.hpp"

namespace mechane::fit {
namespace {

namespace fs = std::filesystem;

/// All meshes as one.
std::vector<geometry::NamedMesh> one_piece(const std::vector<geometry::NamedMesh>& parts, const std::string& name) {
  geometry::NamedMesh whole{name, {}};
  for (const geometry::NamedMesh& part : parts)
    whole.mesh.append(part.mesh);
  return {std::move(whole)};
}

Expected<void> import_parts(const FitOptions& options, FittedObject& fitted) {
  auto hash = content::content_hash(fitted.mesh_file);
  if (!hash) return tl::unexpected(hash.error());
  fitted.mesh_hash = std::move(*hash);
  const auto scene = content::import_mesh(fitted.mesh_file);
  if (!scene) return tl::unexpected(scene.error());
  auto parts = content::collision_parts(*scene, options.node);
  if (!parts) return tl::unexpected(parts.error().in(fitted.mesh_file.string()));
  fitted.meshes = options.whole ? one_piece(*parts, fitted.mesh_file.stem().string()) : std::move(*parts);
  for (geometry::NamedMesh& part : fitted.meshes) {
    for (Vec3& vertex : part.mesh.vertices)
      vertex *= options.scale;
    if (part.name.empty()) part.name = fitted.mesh_file.stem().string();  // STL and PLY have no names
    if (geometry::turn_outwards(part.mesh) > 0) fitted.turned.push_back(part.name);
  }
  return {};
}

Expected<void> build(FittedObject& fitted, Progress& progress) {
  auto object =
      collision_build::build_object(fitted.meshes, fitted.config, &fitted.report,
                                    [&](std::size_t done, std::size_t parts) { progress.advance(done, parts); });
  if (!object) return tl::unexpected(object.error().in(fitted.mesh_file.string()));
  fitted.object = std::move(*object);
  return {};
}

/// The object is read back, so that all reports are about what a server will read, not about what was in memory.
Expected<void> write_and_read_back(FittedObject& fitted, Interruption& interruption) {
  const std::vector<std::byte> bytes = collision::write_object(fitted.object);
  if (auto written = write_whole(fitted.part_file, bytes, interruption); !written) return written;
  const auto back = read_whole(fitted.part_file, bytes.size());
  if (!back) return tl::unexpected(back.error());
  auto object = collision::read_object(*back);
  if (!object) return tl::unexpected(object.error().in(fitted.part_file.string()));
  if (*back != bytes) {
    return fail(ErrorCode::damaged, "the file does not contain what was written", fitted.part_file.string(),
                "check the disk, then run again");
  }
  fitted.part_file_bytes = bytes.size();
  fitted.object = std::move(*object);
  return {};
}

/// Writes a text beside the part file, with the same name and another extension.
Expected<fs::path> write_beside(const fs::path& part_file, const char* ending, const std::string& text,
                                Interruption& interruption) {
  fs::path file = part_file;
  file.replace_extension(ending);
  if (auto ok = write_whole(file, std::as_bytes(std::span(text)), interruption); !ok) return tl::unexpected(ok.error());
  return file;
}

}  // namespace

fs::path part_file_of(const fs::path& mesh_file, const FitOptions& options) {
  std::string name = mesh_file.stem().string();
  if (!options.node.empty()) name += "-" + options.node;
  std::replace(name.begin(), name.end(), '/', '_');  // a node's name may contain anything
  return (options.folder.empty() ? mesh_file.parent_path() : options.folder) / (name + ".part");
}

Expected<FitResult> fit_mesh(const fs::path& mesh_file, const FitOptions& options, Progress& progress,
                             Interruption& interruption) {
  FittedObject fitted;
  fitted.mesh_file = mesh_file;
  fitted.node = options.node;
  fitted.scale = options.scale;
  fitted.config = options.config;
  fitted.part_file = part_file_of(mesh_file, options);
  const std::string name = mesh_file.filename().string();
  progress.begin({name, "reading"});
  if (auto ok = import_parts(options, fitted); !ok) return tl::unexpected(ok.error());
  const fs::path folder = fitted.part_file.parent_path();
  if (auto ok = prepare_folder(folder.empty() ? "." : folder); !ok) return tl::unexpected(ok.error());
  progress.begin({name, "parts built"});
  if (auto ok = build(fitted, progress); !ok) return tl::unexpected(ok.error());
  progress.begin({name, "writing"});
  if (auto ok = write_and_read_back(fitted, interruption); !ok) return tl::unexpected(ok.error());

  progress.begin({name, "drawing the report"});
  const Surface surface(fitted);
  FitResult result{summarise(fitted, surface), fitted.part_file, {}, {}};
  if (options.json) {
    auto file = write_beside(fitted.part_file, ".json", summary_json(fitted, result.summary), interruption);
    if (!file) return tl::unexpected(file.error());
    result.json_file = std::move(*file);
  }
  if (options.report) {
    const std::string page = html_page(make_report(fitted, surface, result.summary));
    auto file = write_beside(fitted.part_file, ".html", page, interruption);
    if (!file) return tl::unexpected(file.error());
    result.report_file = std::move(*file);
  }
  return result;
}

}  // namespace mechane::fit
