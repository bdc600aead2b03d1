// Any triangles as an object for touch: an Error that says what, where and what to do, or an object that is whole, that its report
// describes, that can be read again from its file, and that can be queried without a fault. This is what happens to a mesh after the import
// in `mechane fit` and in the server.
//
// Bytes: how to build (1), nodes less one (1, modulo 3); per node its vertices (1), its triangles (1), then the vertices as three
// floats, or as three signed bytes in centimetres, and the triangles as three bytes each. What is missing at the end reads as zero.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <span>
#include <string>
#include <vector>

#include "server/collision/object_io.hpp"
#include "server/collision/samples.hpp"
#include "server/collision/superquadric_object.hpp"
#include "server/collision_build/object_builder.hpp"
#include "server/geometry/superquadric.hpp"

namespace {

using mechane::Error;
using mechane::Pose;
using mechane::Quat;
using mechane::Vec3;
namespace collision = mechane::collision;
namespace collision_build = mechane::collision_build;
namespace geometry = mechane::geometry;

void require(bool holds, const char* what) {
  if (holds) return;
  std::cerr << "mesh_fuzz: " << what << "\n";
  std::abort();
}

class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> data) : data_(data) {}
  std::uint8_t byte() {
    if (data_.empty()) return 0;
    const std::uint8_t b = data_.front();
    data_ = data_.subspan(1);
    return b;
  }
  float number() {
    std::array<std::uint8_t, 4> raw{};
    for (std::uint8_t& b : raw)
      b = byte();
    float value = 0;
    std::memcpy(&value, raw.data(), sizeof value);
    return value;
  }

 private:
  std::span<const std::uint8_t> data_;
};

enum Flag : std::uint8_t { kWholeFloats = 1, kAsGiven = 2, kDecomposed = 4, kBricks = 8, kLarge = 16, kNoSeam = 32 };

geometry::Mesh read_mesh(Bytes& bytes, std::uint8_t flags) {
  geometry::Mesh mesh;
  const std::size_t vertices = bytes.byte();
  const std::size_t triangles = bytes.byte();
  const auto coordinate = [&]() -> double {
    if ((flags & kWholeFloats) != 0) return static_cast<double>(bytes.number());
    return (flags & kLarge ? 1.0 : 0.01) * static_cast<std::int8_t>(bytes.byte());
  };
  for (std::size_t i = 0; i < vertices; ++i) {
    const double x = coordinate();
    const double y = coordinate();
    mesh.vertices.emplace_back(x, y, coordinate());
  }
  for (std::size_t i = 0; i < triangles; ++i) {
    const std::uint32_t a = bytes.byte();
    const std::uint32_t b = bytes.byte();
    mesh.triangles.push_back({a, b, bytes.byte()});
  }
  return mesh;
}

/// Small values where large ones take time, so that an execution takes some milliseconds.
collision_build::BuildConfig config_of(std::uint8_t flags) {
  collision_build::BuildConfig config;
  config.parts = (flags & kAsGiven) != 0      ? collision_build::Parts::as_given
                 : (flags & kDecomposed) != 0 ? collision_build::Parts::decomposed
                                              : collision_build::Parts::automatic;
  config.max_concavity = 0.1;
  config.max_pieces = 4;
  config.grid_cells = 10;
  config.max_error_share = 0.1;
  config.max_error_m = 1000;
  config.miss_share = 0.1;
  config.radial_maps = (flags & kBricks) == 0;
  config.bricks = !config.radial_maps;
  config.map_resolution = config.radial_maps ? 8 : 0;
  config.sample_spacing_m = 0.02;
  config.max_samples_per_part = 64;
  config.seam_gap_m = (flags & kNoSeam) != 0 ? 0 : 0.001;
  return config;
}

void check_error(const Error& error) {
  require(!error.what.empty() && !error.where.empty() && !error.remedy.empty(),
          "an error without what, where or remedy");
}

void check_report(const collision::Object& object, const collision_build::BuildReport& report,
                  const collision_build::BuildConfig& config, std::size_t nodes) {
  require(!object.parts.empty() && object.parts.size() <= nodes * std::max<std::size_t>(1, config.max_pieces),
          "the count of parts");
  require(report.parts.size() == object.parts.size(), "a report for each part");
  require(std::isfinite(report.diagonal_m) && report.diagonal_m > 0, "the diagonal");
  std::size_t bytes = 0;
  std::size_t samples = 0;
  for (std::size_t i = 0; i < report.parts.size(); ++i) {
    const collision_build::PartReport& part = report.parts[i];
    require(part.bytes == object.parts[i].map.bytes() && part.map == object.parts[i].map.name(), "whose map it is");
    require(part.error.p99_m >= 0 && part.error.p50_m >= 0, "an error that is a number");
    require(
        !part.met || (part.error.p99_m <= report.budget.depth_p99_m && (part.error.probes > 0 || part.samples == 0)),
        "a budget is met where it was measured");
    require(std::isfinite(part.fit.mean_pct) && std::isfinite(part.fit.max_pct), "the fit's error");
    bytes += part.bytes;
    samples += part.samples;
  }
  require(bytes == report.bytes && samples == collision::sample_count(object), "the sums");
}

void check_object(const collision::Object& object) {
  require(object.bound_O.center.allFinite() && std::isfinite(object.bound_O.radius), "the object's sphere");
  for (const collision::Part& part : object.parts) {
    require(geometry::is_valid(part.superquadric), "a superquadric");
    require(part.X_OQ.p.allFinite() && std::abs(part.X_OQ.R.norm() - 1) < 1e-6, "its pose");
    require(!part.map.empty(), "a part without a map");
    require(part.bound_O.center.allFinite() && part.bound_O.radius >= 0, "its sphere");
  }
  collision::for_each_sample(object, [](const collision::Cluster& cluster, std::size_t lane) {
    require(cluster.sample_O(lane).allFinite(), "a sample that is a number");
  });
}

void ask(const collision::Object& object) {
  static const collision::Object finger = [] {
    geometry::Superquadric shape;
    shape.a = Vec3(0.014, 0.008, 0.008);
    return collision::make_superquadric_object(shape, 0.004);
  }();
  std::array<collision::PointContact, 64> storage;
  const auto touch = [&](const collision::Object& a, const Vec3& p_WA) {
    collision::ContactBuffer buffer(storage);
    collision::find_contacts(a, {p_WA, Quat::Identity()}, object, {}, buffer);
    for (const collision::PointContact& contact : buffer.contacts()) {
      require(contact.p_WC.allFinite(), "a contact's place");
      require(std::isfinite(contact.depth_m) && contact.depth_m > 0, "a contact's depth");
      require(std::abs(contact.n_BA_W.norm() - 1) < 1e-3, "a contact's normal");
    }
  };
  std::size_t count = 0;
  collision::for_each_sample(object, [&](const collision::Cluster& cluster, std::size_t lane) {
    if (count++ < 8) touch(finger, cluster.sample_O(lane).cast<double>());
  });
  touch(finger, object.bound_O.center);
  touch(object, 0.01 * object.bound_O.radius * Vec3::UnitX());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes({data, size});
  const std::uint8_t flags = bytes.byte();
  std::vector<geometry::NamedMesh> nodes(1 + bytes.byte() % 3);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    nodes[i] = {"node" + std::to_string(i), read_mesh(bytes, flags)};
  const collision_build::BuildConfig config = config_of(flags);
  collision_build::BuildReport report;
  const auto object = collision_build::build_object(nodes, config, &report);
  if (!object) {
    check_error(object.error());
    return 0;
  }
  check_object(*object);
  check_report(*object, report, config, nodes.size());
  require(collision::read_object(collision::write_object(*object)).has_value(), "a file that its own reader refuses");
  ask(*object);
  return 0;
}
