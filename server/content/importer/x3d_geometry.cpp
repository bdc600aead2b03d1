#include "server/content/importer/x3d_geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "server/content/importer/x3d_solids.hpp"

namespace mechane::content {
namespace {

using Corner = Faces::Corner;

/// More corners of one polygon would take minutes to cut into triangles.
constexpr std::size_t kMostPolygonCorners = 5000;
/// No coordinate of a model is larger (ImportLimits::largest_m is far below); beyond it a float's products overflow.
constexpr double kLargestNumber = 1e9;

/// Reads one node. Its methods return false, or an Error, once they have found a fault.
class GeometryReader {
 public:
  GeometryReader(const x3d::Document& document, x3d::NodeId id, std::uint64_t most_corners)
      : document_(document), id_(id), node_(document, id), most_(most_corners) {}

  Expected<Faces> read() {
    Expected<Faces> faces = dispatch();
    if (!faces) return faces;
    for (const Vec3& p : faces->points) {
      if (!(p.cwiseAbs().maxCoeff() <= kLargestNumber))
        return fault(ErrorCode::invalid_value, "a point lies too far away", "write coordinates in metres");
    }
    return faces;
  }

 private:
  tl::unexpected<Error> fault(ErrorCode code, std::string what, std::string remedy) const {
    return fail_at(document_, id_, code, std::move(what), std::move(remedy));
  }

  Expected<Faces> dispatch() {
    const std::string_view type = node_.type();
    if (type == "Box") return box();
    if (type == "Sphere") return faces_of_sphere(node_);
    if (type == "Cone") return faces_of_cone(node_);
    if (type == "Cylinder") return faces_of_cylinder(node_);
    if (type == "Extrusion") return extrusion();
    if (type == "ElevationGrid") return elevation_grid();
    return composed();
  }

  Expected<void> check_count(std::uint64_t corners) const {
    if (corners <= most_) return {};
    return fault(ErrorCode::too_large, fmt::format("it has {} corners; {} more are allowed", corners, most_),
                 "simplify the shape");
  }

  Expected<Faces> box() const {
    if (node_.vector("size").minCoeff() > 0) return faces_of_box(node_);
    return fault(ErrorCode::invalid_value, "a side of the box is not above 0 m", "write three lengths above 0");
  }

  Expected<Faces> extrusion() const {
    const std::size_t section = node_.numbers("crossSection").size() / 2, spine = node_.numbers("spine").size() / 3;
    if (section < 2 || spine < 2)
      return fault(ErrorCode::missing, "crossSection or spine has fewer than two points", "write two or more");
    if (node_.numbers("scale").empty() || node_.numbers("orientation").empty())
      return fault(ErrorCode::missing, "scale or orientation is empty", "leave it out, or write one value");
    if (section > kMostPolygonCorners) return too_many_corners(section);
    if (auto good = check_count(4 * std::uint64_t{section} * spine); !good) return tl::unexpected(good.error());
    return faces_of_extrusion(node_);
  }

  Expected<Faces> elevation_grid() const {
    const auto points_along = [&](const char* field) {
      const double points = node_.number(field);
      return static_cast<std::uint64_t>(points >= 0 ? std::min(points, 1e9) : 0);  // whatever stands there
    };
    const std::uint64_t nx = points_along("xDimension");
    const std::uint64_t nz = points_along("zDimension");
    const std::vector<double> height = node_.numbers("height");
    if (nx < 2 || nz < 2)
      return fault(ErrorCode::missing, "xDimension or zDimension is below 2",
                   "write the number of points on each side");
    if (nx > height.size() || nz > height.size() / nx) {
      return fault(ErrorCode::invalid_value, fmt::format("it has {} heights, and needs {} x {}", height.size(), nx, nz),
                   "write xDimension times zDimension heights");
    }
    if (auto good = check_count(4 * (nx - 1) * (nz - 1)); !good) return tl::unexpected(good.error());
    Faces faces;
    const double dx = node_.number("xSpacing"), dz = node_.number("zSpacing");
    for (std::uint64_t k = 0; k < nz; ++k) {
      for (std::uint64_t i = 0; i < nx; ++i) {
        faces.points.emplace_back(dx * double(i), height[k * nx + i], dz * double(k));
        faces.uv.emplace_back(float(i) / float(nx - 1), float(k) / float(nz - 1));
      }
    }
    const auto corner = [&](std::uint64_t i, std::uint64_t k) {
      const auto at = static_cast<std::uint32_t>(k * nx + i);
      return Corner{at, at};
    };
    for (std::uint64_t k = 0; k + 1 < nz; ++k) {
      for (std::uint64_t i = 0; i + 1 < nx; ++i)
        faces.add(std::array{corner(i, k), corner(i, k + 1), corner(i + 1, k + 1), corner(i + 1, k)});
    }
    take_flags(faces);
    faces.crease_rad = node_.number("creaseAngle");
    return faces;
  }

  void take_flags(Faces& faces) const {
    faces.counter_clockwise = node_.boolean("ccw");
    faces.seen_from_both_sides = !node_.boolean("solid");
  }

  tl::unexpected<Error> too_many_corners(std::size_t count) const {
    return fault(ErrorCode::too_large,
                 fmt::format("a polygon has {} corners; {} are allowed", count, kMostPolygonCorners),
                 "divide it into smaller ones");
  }

  /// IndexedFaceSet, IndexedTriangleSet, TriangleSet: all are read as lists of indices with -1 behind each face.
  Expected<Faces> composed() const {
    Faces faces;
    if (!read_points(faces))
      return fault(ErrorCode::missing, "it has no points",
                   "give it <Coordinate point='...'/> with three numbers a point");
    const bool by_faces = node_.type() == "IndexedFaceSet";
    std::vector<double> points, uv, normals;
    if (by_faces) {
      points = node_.numbers("coordIndex");
      uv = node_.numbers("texCoordIndex");
      normals = node_.numbers("normalIndex");
    } else {
      if (!triangle_indices(faces.points.size(), points))
        return fault(ErrorCode::invalid_value, "the last triangle is incomplete", "write three corners a triangle");
    }
    if (auto good = check_count(points.size()); !good) return tl::unexpected(good.error());
    read_uv(faces);
    read_normals(faces);
    if (uv.empty()) uv = points;
    const bool by_corner = node_.boolean("normalPerVertex");
    if (normals.empty() && by_corner) normals = points;
    if (auto good = add_faces(points, uv, normals, by_corner, faces); !good) return tl::unexpected(good.error());
    take_flags(faces);
    faces.crease_rad = by_faces ? node_.number("creaseAngle") : (by_corner ? kPi : 0);
    return faces;
  }

  bool read_points(Faces& faces) const {
    const x3d::NodeId id = node_.node("coord");
    const bool known = id && (document_[id].name == "Coordinate" || document_[id].name == "CoordinateDouble");
    const std::vector<double> numbers = known ? x3d::NodeFields(document_, id).numbers("point") : std::vector<double>{};
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
      faces.points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    return !faces.points.empty();
  }

  void read_uv(Faces& faces) const {
    const x3d::NodeId id = node_.node("texCoord");
    if (!id || document_[id].name != "TextureCoordinate") return;
    const std::vector<double> numbers = x3d::NodeFields(document_, id).numbers("point");
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2)
      faces.uv.emplace_back(float(numbers[i]), float(numbers[i + 1]));
  }

  void read_normals(Faces& faces) const {
    const x3d::NodeId id = node_.node("normal");
    if (!id || document_[id].name != "Normal") return;
    const std::vector<double> numbers = x3d::NodeFields(document_, id).numbers("vector");
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
      const Vec3 n(numbers[i], numbers[i + 1], numbers[i + 2]);
      faces.normals.push_back(n.norm() > 0 ? Vec3f(n.normalized().cast<float>()) : Vec3f::UnitY());
    }
  }

  /// The corners of a set of triangles with a -1 behind each; false where the last one is incomplete.
  bool triangle_indices(std::size_t points, std::vector<double>& indices) const {
    std::vector<double> corners;
    if (node_.type() == "IndexedTriangleSet") {
      corners = node_.numbers("index");
    } else {
      for (std::size_t i = 0; i < points; ++i)
        corners.push_back(double(i));
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      indices.push_back(corners[i]);
      if (i % 3 == 2) indices.push_back(-1);
    }
    return corners.size() % 3 == 0;
  }

  /// Of one of the lists, at a place of it, into a table of `size` values. None where the table is empty.
  Expected<std::uint32_t> index_at(const std::vector<double>& list, std::size_t at, std::size_t size,
                                   std::string_view of) const {
    if (size == 0) return Faces::kNone;
    if (at >= list.size()) {
      return fault(ErrorCode::invalid_value, fmt::format("it has too few indices of {}", of),
                   fmt::format("write one for each of coordIndex, or leave them out"));
    }
    const double index = list[at];
    if (index >= 0 && index < double(size)) return static_cast<std::uint32_t>(index);
    return fault(ErrorCode::invalid_value, fmt::format("index {} is out of range: there are {} {}", index, size, of),
                 fmt::format("write indices from 0 to {}", size - 1));
  }

  Expected<void> add_faces(const std::vector<double>& points, const std::vector<double>& uv,
                           const std::vector<double>& normals, bool normal_by_corner, Faces& faces) const {
    std::vector<Corner> face;
    std::size_t number = 0;
    const auto close = [&]() -> Expected<void> {
      if (face.size() > kMostPolygonCorners) return too_many_corners(face.size());
      if (face.size() >= 3) faces.add(face);
      face.clear();
      ++number;
      return {};
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i] == -1) {
        if (auto good = close(); !good) return good;
        continue;
      }
      const auto point = index_at(points, i, faces.points.size(), "points");
      const auto texture = index_at(uv, i, faces.uv.size(), "texture coordinates");
      const auto normal = normal_by_corner  ? index_at(normals, i, faces.normals.size(), "normals")
                          : normals.empty() ? face_normal(number, faces)
                                            : index_at(normals, number, faces.normals.size(), "normals");
      for (const auto* index : {&point, &texture, &normal}) {
        if (!*index) return tl::unexpected(index->error());
      }
      face.push_back({*point, *texture, *normal});
    }
    return close();
  }

  /// The normals' own order, where they are one a face and have no indices.
  Expected<std::uint32_t> face_normal(std::size_t face, const Faces& faces) const {
    if (faces.normals.empty() || face < faces.normals.size())
      return faces.normals.empty() ? Faces::kNone : static_cast<std::uint32_t>(face);
    return fault(ErrorCode::invalid_value, "it has fewer normals than faces", "write one a face, or leave them out");
  }

  const x3d::Document& document_;
  x3d::NodeId id_;
  x3d::NodeFields node_;
  std::uint64_t most_;
};

}  // namespace

tl::unexpected<Error> fail_at(const x3d::Document& document, x3d::NodeId id, ErrorCode code, std::string what,
                              std::string remedy) {
  const int line = document[id].line;
  return fail(code, std::move(what), {fmt::format("line {}, {}", line, document.describe(id)), line},
              std::move(remedy));
}

Expected<Faces> faces_of(const x3d::Document& document, x3d::NodeId geometry, std::uint64_t most_corners) {
  return GeometryReader(document, geometry, most_corners).read();
}

}  // namespace mechane::content
