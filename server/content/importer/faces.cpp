#include "server/content/importer/faces.hpp"

#include <algorithm>
#include <cmath>

#include "server/content/importer/polygon.hpp"

namespace mechane::content {
namespace {

/// Where more faces than this meet in a point, each keeps its own normal: comparing all with all would take too long.
constexpr std::size_t kMostSmoothed = 256;

/// Makes the normals that a geometry does not give.
class Normals {
 public:
  explicit Normals(const Faces& faces) : faces_(faces), least_cosine_(std::cos(std::min(faces.crease_rad, kPi))) {
    std::uint32_t begin = 0;
    std::vector<Vec3> ring;
    for (const std::uint32_t end : faces.ends) {
      ring.clear();
      for (std::uint32_t i = begin; i < end; ++i)
        ring.push_back(faces.points[faces.corners[i].point]);
      const double sense = faces.counter_clockwise ? 1 : -1;
      areas_.emplace_back(sense * area_vector(ring));
      begin = end;
    }
    if (faces.crease_rad > 0) gather();
  }

  /// Of a face at one of its points.
  [[nodiscard]] Vec3f at(std::size_t face, std::uint32_t point) const {
    const Vec3 own = areas_[face].normalized();
    if (first_.empty()) return own.cast<float>();
    const std::span<const std::uint32_t> around(by_point_.data() + first_[point], first_[point + 1] - first_[point]);
    if (around.size() > kMostSmoothed) return own.cast<float>();
    Vec3 sum = Vec3::Zero();
    for (const std::uint32_t other : around) {
      const double norm = areas_[other].norm();
      if (norm > 0 && areas_[other].dot(own) >= (least_cosine_ - 1e-9) * norm) sum += areas_[other];
    }
    return (sum.norm() > 0 ? Vec3(sum.normalized()) : own).cast<float>();
  }

 private:
  /// The faces around each point, in one list.
  void gather() {
    first_.assign(faces_.points.size() + 1, 0);
    for (const Faces::Corner& corner : faces_.corners)
      ++first_[corner.point + 1];
    for (std::size_t i = 1; i < first_.size(); ++i)
      first_[i] += first_[i - 1];
    by_point_.resize(faces_.corners.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    std::uint32_t begin = 0;
    for (std::uint32_t face = 0; face < faces_.ends.size(); ++face) {
      for (; begin < faces_.ends[face]; ++begin)
        by_point_[next[faces_.corners[begin].point]++] = face;
    }
  }

  const Faces& faces_;
  double least_cosine_;
  std::vector<Vec3> areas_;           // by face: twice the area, along the normal
  std::vector<std::uint32_t> first_;  // by point, into by_point_; empty where nothing is smoothed
  std::vector<std::uint32_t> by_point_;
};

/// X3D's default uv of a point.
class BoxMapping {
 public:
  explicit BoxMapping(const Faces& faces) {
    for (const Faces::Corner& corner : faces.corners)
      box_.extend(faces.points[corner.point]);
    if (box_.isEmpty()) return;
    const Vec3 size = box_.sizes();
    size.maxCoeff(&s_);
    for (Eigen::Index k = 2; k >= 0; --k) {
      if (k != s_ && (t_ == s_ || size[k] >= size[t_])) t_ = k;
    }
    scale_ = size[s_] > 0 ? 1 / size[s_] : 0;
  }
  [[nodiscard]] Eigen::Vector2f operator()(const Vec3& p) const {
    const Vec3 from = scale_ * (p - box_.min());
    return {static_cast<float>(from[s_]), static_cast<float>(from[t_])};
  }

 private:
  Eigen::AlignedBox3d box_;
  Eigen::Index s_ = 0;
  Eigen::Index t_ = 0;
  double scale_ = 0;
};

}  // namespace

void Faces::add(std::span<const Corner> face) {
  corners.insert(corners.end(), face.begin(), face.end());
  ends.push_back(static_cast<std::uint32_t>(corners.size()));
}

ImportedMesh mesh_of(const Faces& faces, bool textured) {
  ImportedMesh mesh;
  const Normals normals(faces);
  const BoxMapping mapping(faces);
  std::vector<Vec3> ring;
  std::uint32_t begin = 0;
  for (std::size_t face = 0; face < faces.ends.size(); ++face) {
    const std::span<const Faces::Corner> corners(faces.corners.data() + begin, faces.ends[face] - begin);
    begin = faces.ends[face];
    ring.clear();
    for (const Faces::Corner& corner : corners)
      ring.push_back(faces.points[corner.point]);
    const auto triangles = triangulate(ring);
    if (triangles.empty()) continue;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Faces::Corner& corner : corners) {
      mesh.positions.push_back(faces.points[corner.point].cast<float>());
      mesh.normals.push_back(corner.normal != Faces::kNone ? faces.normals[corner.normal]
                                                           : normals.at(face, corner.point));
      if (!textured) continue;
      const Eigen::Vector2f uv = corner.uv != Faces::kNone ? faces.uv[corner.uv] : mapping(faces.points[corner.point]);
      mesh.uv.emplace_back(uv.x(), 1 - uv.y());
    }
    for (const auto& t : triangles) {
      for (const std::size_t k : {0, faces.counter_clockwise ? 1 : 2, faces.counter_clockwise ? 2 : 1})
        mesh.indices.push_back(first + t[k]);
    }
  }
  return mesh;
}

}  // namespace mechane::content
