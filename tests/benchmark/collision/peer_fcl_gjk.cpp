// FCL's GJK and EPA (libccd) on convex parts, the other rival of the paper's Figure 15a: the hull of each piece of our own
// decomposition against the hulls of the hand's segments. One contact a pair: listed apart.
#include <algorithm>
#include <cmath>

#include <LinearMath/btConvexHullComputer.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>

#include "server/base/assert.hpp"
#include "server/collision/samples.hpp"
#include "server/collision_build/object_builder.hpp"
#include "server/geometry/pieces/decompose.hpp"
#include "tests/benchmark/collision/culling.hpp"
#include "tests/benchmark/collision/fcl_common.hpp"
#include "tests/benchmark/collision/method.hpp"
#include "tests/benchmark/collision/resolution.hpp"

namespace mechane::benchmark {
namespace {

using Convex = fcl::Convexd;

struct Hull {
  std::shared_ptr<Convex> shape;
  geometry::Sphere bound;
};

Hull hull_of(std::span<const Vec3> points) {
  btConvexHullComputer computer;
  computer.compute(points.front().data(), sizeof(Vec3), static_cast<int>(points.size()), 0, 0);
  auto vertices = std::make_shared<std::vector<Vec3>>();
  for (int i = 0; i < computer.vertices.size(); ++i)
    vertices->push_back(Vec3(computer.vertices[i].x(), computer.vertices[i].y(), computer.vertices[i].z()));
  auto faces = std::make_shared<std::vector<int>>();
  for (int f = 0; f < computer.faces.size(); ++f) {
    const btConvexHullComputer::Edge* first = &computer.edges[computer.faces[f]];
    std::vector<int> around;
    const btConvexHullComputer::Edge* edge = first;
    do {
      around.push_back(edge->getSourceVertex());
      edge = edge->getNextEdgeOfFace();
    } while (edge != first);
    faces->push_back(static_cast<int>(around.size()));
    faces->insert(faces->end(), around.begin(), around.end());
  }
  const geometry::Sphere bound = collision::bounding_sphere(*vertices);
  return {std::make_shared<Convex>(vertices, computer.faces.size(), faces), bound};
}

/// As our builder cuts it by default.
std::vector<Hull> hulls_of(const SceneObject& object) {
  const collision_build::BuildConfig ours;
  geometry::DecomposeConfig config;
  config.max_concavity = ours.max_concavity;
  config.max_parts = ours.max_pieces;
  config.seed = ours.seed;
  const auto cut = geometry::decompose(object.mesh_O, config);
  MECHANE_ASSERT(cut.has_value());
  if (cut->pieces.size() < 2) return {hull_of(object.mesh_O.vertices)};
  std::vector<Hull> hulls;
  for (const geometry::Piece& piece : cut->pieces) {
    std::vector<Vec3> points = piece.surface_points;
    points.insert(points.end(), piece.cut_points.begin(), piece.cut_points.end());
    if (points.size() >= 4) hulls.push_back(hull_of(points));
  }
  return hulls;
}

class FclGjk final : public Method {
 public:
  explicit FclGjk(const Scene& scene) : scene_(scene), request_(1, true) {
    const Stopwatch watch;
    for (const SceneObject& object : scene.objects) {
      hulls_.push_back(hulls_of(object));
      X_WO_.push_back(fcl_transform(object.X_WO));
    }
    build_s_ = watch.seconds();
    for (const Segment& segment : scene.hand)
      segments_.push_back(hull_of(segment.mesh_S.vertices).shape);
  }

  [[nodiscard]] std::string name() const override { return "fcl_gjk"; }
  [[nodiscard]] std::vector<std::size_t> bytes_by_object() const override {
    std::vector<std::size_t> bytes;
    for (const auto& hulls : hulls_) {
      bytes.push_back(0);
      for (const Hull& hull : hulls) {
        // The faces' indices, and the neighbours that the search for the farthest vertex walks over: two for each edge, and a count.
        const std::size_t corners = hull.shape->getFaces().size();
        const std::size_t edges = corners - static_cast<std::size_t>(hull.shape->getFaceCount());
        bytes.back() += sizeof(Hull) + sizeof(Convex) +
                        hull.shape->getVertices().size() * (sizeof(Vec3) + sizeof(int)) +
                        (corners + edges) * sizeof(int);
      }
    }
    return bytes;
  }
  [[nodiscard]] double build_s() const override { return build_s_; }
  [[nodiscard]] bool answers_points() const override { return false; }
  [[nodiscard]] double mesh_contacts_per_step() const override { return contacts_ / std::max(steps_, 1.0); }
  [[nodiscard]] std::vector<std::pair<std::string, double>> extra_metrics() const override {
    double hulls = 0;
    for (const auto& of_object : hulls_)
      hulls += static_cast<double>(of_object.size());
    return {{"hulls.fcl_gjk", hulls}, {"failed_pairs.fcl_gjk", failed_}};
  }

  void step(const HandStep& hand, Hits&) override {
    ++steps_;
    for (std::size_t k = 0; k < hulls_.size(); ++k) {
      const SceneObject& object = scene_.objects[k];
      if (!reaches(object, object.R_OW * hand.center + object.p_OW, hand.radius)) continue;
      for (std::size_t s = 0; s < kSegments; ++s) {
        const Vec3f p_O = object.R_OW * Vec3f(hand.segment_x[s], hand.segment_y[s], hand.segment_z[s]) + object.p_OW;
        if (!reaches(object, p_O, hand.segment_r[s])) continue;
        const fcl::Transform3d X_WS = fcl_transform(hand.X_WS[s]);
        for (const Hull& hull : hulls_[k]) {
          const double reach = static_cast<double>(hand.segment_r[s]) + hull.bound.radius;
          if ((p_O.cast<double>() - hull.bound.center).squaredNorm() <= reach * reach)
            collide(*segments_[s], X_WS, *hull.shape, X_WO_[k]);
        }
      }
    }
  }

 private:
  void collide(const Convex& segment, const fcl::Transform3d& X_WS, const Convex& hull, const fcl::Transform3d& X_WO) {
    result_.clear();
    try {
      fcl::collide(&segment, X_WS, &hull, X_WO, request_, result_);
    } catch (const std::exception&) {  // its EPA gives up on some pairs
      ++failed_;
    }
    contacts_ += static_cast<double>(result_.numContacts());
  }

  const Scene& scene_;
  double build_s_ = 0;
  double steps_ = 0;
  double contacts_ = 0;
  double failed_ = 0;
  fcl::CollisionRequestd request_;
  fcl::CollisionResultd result_;
  std::vector<std::vector<Hull>> hulls_;
  std::vector<std::shared_ptr<Convex>> segments_;
  std::vector<fcl::Transform3d> X_WO_;
};

}  // namespace

MethodPtr make_fcl_gjk(const Scene& scene) {
  return std::make_unique<FclGjk>(scene);
}

}  // namespace mechane::benchmark
