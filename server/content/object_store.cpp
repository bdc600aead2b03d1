#include "server/content/object_store.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "server/base/byte_order.hpp"
#include "server/base/whole_file.hpp"
#include "server/collision/object_io.hpp"
#include "server/content/content_hash.hpp"
#include "server/content/mesh_import.hpp"
#include "server/log/log.hpp"

namespace mechane::content {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kSecondsBetweenLines = 5;

/// The name of the object's cache file: a hash of everything that can change the object.
std::string cache_name(const std::string& geometry, const collision_build::BuildConfig& config) {
  const std::string key = fmt::format(
      "part file {} build {} geometry {} error {:a} {:a} miss {:a} probes {:a} solid {} {:a} "
      "parts {} {:a} {} {} maps {}{}{} bounds {} resolution {} "
      "spacing {:a} samples {} seam {:a} seed {}",
      collision::kPartFileVersion, kObjectBuildVersion, geometry, config.max_error_share, config.max_error_m,
      config.miss_share, config.probe_depth_m, static_cast<int>(config.solid.kind), config.solid.thickness_m,
      static_cast<int>(config.parts), config.max_concavity, config.max_pieces, config.grid_cells, config.radial_maps,
      config.bricks, config.fields ? " united field" : "", static_cast<int>(config.bounds), config.map_resolution,
      config.sample_spacing_m, config.max_samples_per_part, config.seam_gap_m, config.seed);
  return content_hash(std::as_bytes(std::span(key))) + ".part";
}

/// The hash of all that the builder uses: names, corners and triangles of the parts, and nothing of their looks.
std::string geometry_hash(const std::vector<geometry::NamedMesh>& parts) {
  std::vector<std::byte> bytes;
  VectorSink sink(bytes);
  for (const geometry::NamedMesh& part : parts) {
    put_string(sink, part.name);
    put_varint(sink, part.mesh.vertices.size());
    for (const Vec3& p : part.mesh.vertices) {
      for (const double x : p)
        put(sink, std::bit_cast<std::uint64_t>(x));
    }
    put_varint(sink, part.mesh.triangles.size());
    for (const auto& triangle : part.mesh.triangles) {
      for (const std::uint32_t corner : triangle)
        put(sink, corner);
    }
  }
  return content_hash(bytes);
}

/// The hash in a file; nothing where the file is missing or contains something else.
std::optional<std::string> read_hash(const fs::path& file) {
  std::ifstream in(file);
  std::string hash;
  if (!(in >> hash) || hash.size() != 32 || hash.find_first_not_of("0123456789abcdef") != std::string::npos)
    return std::nullopt;
  return hash;
}

/// The object in a cache file; null where the file is missing or damaged.
std::shared_ptr<const collision::Object> read_cached(const fs::path& file) {
  std::error_code code;
  if (!fs::exists(file, code)) return nullptr;
  Expected<collision::Object> object = collision::load_object(file);
  if (object) return std::make_shared<const collision::Object>(std::move(*object));
  log::warning(fmt::format("{}: {}; it is built again", file.string(), object.error().what));
  return nullptr;
}

const char* setting(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value == '/' ? value : nullptr;  // the XDG rules: a relative path counts as absent
}

}  // namespace

fs::path default_cache_folder() {
  if (const char* cache = setting("XDG_CACHE_HOME")) return fs::path(cache) / "mechane";
  if (const char* home = setting("HOME")) return fs::path(home) / ".cache/mechane";
  std::error_code code;
  return fs::temp_directory_path(code) / fmt::format("mechane-{}", getuid());
}

ObjectStore::ObjectStore(fs::path cache_folder, ImportLimits limits)
    : cache_folder_(cache_folder.empty() ? default_cache_folder() : std::move(cache_folder)),
      limits_(std::move(limits)) {}

Expected<std::string> ObjectStore::geometry_of(const fs::path& file, const std::string& node) {
  const Expected<std::string> hash = content_hash(file);
  if (!hash) return tl::unexpected(hash.error());
  const std::string key = fmt::format("import {} mesh {} node {}:{}", kObjectImportVersion, *hash, node.size(), node);
  const fs::path note = cache_folder_ / (content_hash(std::as_bytes(std::span(key))) + ".geometry");
  if (const auto known = read_hash(note)) return *known;
  const auto parts = parts_of(file, node);
  if (!parts) return tl::unexpected(parts.error());
  const std::string geometry = geometry_hash(*parts);
  // Where this fails, keeping the object fails too, which load() logs.
  (void)write_whole(note, std::as_bytes(std::span(geometry)), WholeFile::shared);
  return geometry;
}

Expected<fs::path> ObjectStore::cache_file(const fs::path& file, const std::string& node,
                                           const collision_build::BuildConfig& config) {
  const Expected<std::string> geometry = geometry_of(file, node);
  if (!geometry) return tl::unexpected(geometry.error());
  return cache_folder_ / cache_name(*geometry, config);
}

Expected<std::shared_ptr<const collision::Object>> ObjectStore::load(const fs::path& file, const std::string& node,
                                                                     const collision_build::BuildConfig& config) {
  const Expected<fs::path> cached = cache_file(file, node, config);
  if (!cached) return tl::unexpected(cached.error());
  std::weak_ptr<const collision::Object>& known = known_[*cached];
  if (auto object = known.lock()) return object;
  if (auto object = read_cached(*cached)) {
    known = object;
    return object;
  }
  Expected<collision::Object> built = build(file, node, config);
  if (!built) return tl::unexpected(built.error());
  if (auto kept = write_whole(*cached, collision::write_object(*built), WholeFile::shared); !kept) {
    log::warning(fmt::format("{}; the object is built again at each start", kept.error().to_string()));
  }
  auto object = std::make_shared<const collision::Object>(std::move(*built));
  known = object;
  return object;
}

Expected<collision::Object> ObjectStore::build(const fs::path& file, const std::string& node,
                                               const collision_build::BuildConfig& config) {
  const auto parts = parts_of(file, node);
  if (!parts) return tl::unexpected(parts.error());
  if (progress_) progress_(node, parts->size());
  const std::string name = node.empty() ? "(all)" : node;
  log::info(
      fmt::format("{}, node {}: building it for touch; the result is kept for the next start", file.string(), name));
  collision_build::BuildReport report;
  std::atomic<std::int64_t> next_line_s{kSecondsBetweenLines};
  const auto began = std::chrono::steady_clock::now();
  const auto say = [&](std::size_t done, std::size_t all) {
    const auto s = std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - began).count();
    std::int64_t due = next_line_s.load();
    if (s < due || !next_line_s.compare_exchange_strong(due, s + kSecondsBetweenLines)) return;
    log::info(fmt::format("{}, node {}: {} of {} parts built", file.string(), name, done, all));
  };
  Expected<collision::Object> object = collision_build::build_object(*parts, config, &report, say);
  if (!object) return tl::unexpected(object.error().in(file.string()));
  const auto over = std::count_if(report.parts.begin(), report.parts.end(), [](const auto& part) { return !part.met; });
  log::info(fmt::format(
      "{}, node {}: {} parts of {} KB in {:.1f} s; what is felt is within {:.2f} mm of 99 % of the surface",
      file.string(), name, report.parts.size(), report.bytes / 1024, report.seconds, 1000 * report.error.p99_m));
  if (over > 0) {
    log::info(fmt::format("{}, node {}: {} parts are less exact than required; 'mechane fit' shows where",
                          file.string(), name, over));
  }
  return object;
}

Expected<std::vector<geometry::NamedMesh>> ObjectStore::parts_of(const fs::path& file, const std::string& node) {
  const Expected<const ImportedScene*> scene = scene_of(file);
  if (!scene) return tl::unexpected(scene.error());
  auto parts = collision_parts(**scene, node);
  if (!parts) return tl::unexpected(parts.error().in(file.string()));
  return parts;
}

Expected<const ImportedScene*> ObjectStore::scene_of(const fs::path& file) {
  const Expected<std::string> hash = content_hash(file);
  if (!hash) return tl::unexpected(hash.error());
  if (!last_import_ || last_import_->content_hash != *hash) {
    Expected<ImportedScene> scene = import_mesh(file, limits_);
    if (!scene) return tl::unexpected(scene.error());
    last_import_ = LastImport{*hash, std::move(*scene)};
  }
  return &last_import_->scene;
}

}  // namespace mechane::content
