// Embree: the closest triangle to each point by a point query, exact. The side is told by the angle-weighted normal of the closest
// feature (Baerentzen and Aanaes 2005).
#include <cmath>
#include <limits>
#include <map>

#include <embree3/rtcore.h>

#include "server/base/assert.hpp"
#include "tests/benchmark/collision/culling.hpp"
#include "tests/benchmark/collision/method.hpp"
#include "tests/benchmark/collision/resolution.hpp"

namespace mechane::benchmark {
namespace {

struct Triangle {
  Vec3f a, ab, ac;
  // Normals of the features: face; corners a, b, c; edges ab, bc, ca.
  Vec3f face;
  std::array<Vec3f, 3> corner, edge;
};

enum class Feature { face, corner0, corner1, corner2, edge0, edge1, edge2 };

struct Closest {
  Vec3f p = Vec3f::Zero();
  float square = std::numeric_limits<float>::infinity();
  const Triangle* triangle = nullptr;
  Feature feature = Feature::face;
};

/// Ericson, Real-Time Collision Detection, 5.1.5, with the feature that is closest.
std::pair<Vec3f, Feature> closest_feature(const Triangle& t, const Vec3f& p) {
  const Vec3f ap = p - t.a;
  const float d1 = t.ab.dot(ap);
  const float d2 = t.ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {t.a, Feature::corner0};
  const Vec3f bp = ap - t.ab;
  const float d3 = t.ab.dot(bp);
  const float d4 = t.ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {t.a + t.ab, Feature::corner1};
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {t.a + t.ab * (d1 / (d1 - d3)), Feature::edge0};
  const Vec3f cp = ap - t.ac;
  const float d5 = t.ab.dot(cp);
  const float d6 = t.ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {t.a + t.ac, Feature::corner2};
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {t.a + t.ac * (d2 / (d2 - d6)), Feature::edge2};
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6)
    return {t.a + t.ab + (t.ac - t.ab) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))), Feature::edge1};
  const float scale = 1 / (va + vb + vc);
  return {t.a + t.ab * (vb * scale) + t.ac * (vc * scale), Feature::face};
}

const Vec3f& normal_of(const Triangle& t, Feature feature) {
  const int at = static_cast<int>(feature);
  if (at == 0) return t.face;
  return at <= 3 ? t.corner[static_cast<std::size_t>(at - 1)] : t.edge[static_cast<std::size_t>(at - 4)];
}

std::vector<Triangle> make_triangles(const geometry::Mesh& mesh) {
  std::vector<Vec3> corner(mesh.vertices.size(), Vec3::Zero());
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3> edge;
  const auto key = [](std::uint32_t a, std::uint32_t b) { return std::pair(std::min(a, b), std::max(a, b)); };
  const auto face = [&](const std::array<std::uint32_t, 3>& t) -> Vec3 {
    const Vec3& a = mesh.vertices[t[0]];
    return (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).normalized();
  };
  for (const auto& t : mesh.triangles) {
    const Vec3 n = face(t);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 u = (mesh.vertices[t[(i + 1) % 3]] - mesh.vertices[t[i]]).normalized();
      const Vec3 v = (mesh.vertices[t[(i + 2) % 3]] - mesh.vertices[t[i]]).normalized();
      corner[t[i]] += std::atan2(u.cross(v).norm(), u.dot(v)) * n;
      const auto at = edge.try_emplace(key(t[i], t[(i + 1) % 3]), Vec3::Zero()).first;
      at->second += n;
    }
  }
  std::vector<Triangle> triangles;
  for (const auto& t : mesh.triangles) {
    Triangle triangle;
    triangle.a = mesh.vertices[t[0]].cast<float>();
    triangle.ab = (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cast<float>();
    triangle.ac = (mesh.vertices[t[2]] - mesh.vertices[t[0]]).cast<float>();
    triangle.face = face(t).cast<float>();
    for (std::size_t i = 0; i < 3; ++i) {
      triangle.corner[i] = corner[t[i]].normalized().cast<float>();
      triangle.edge[i] = edge.at(key(t[i], t[(i + 1) % 3])).normalized().cast<float>();
    }
    triangles.push_back(triangle);
  }
  return triangles;
}

/// What a query hands to Embree's callback.
struct Search {
  const std::vector<Triangle>* triangles;
  Closest best;
};

bool visit_triangle(RTCPointQueryFunctionArguments* arguments) {
  auto& search = *static_cast<Search*>(arguments->userPtr);
  const Vec3f p(arguments->query->x, arguments->query->y, arguments->query->z);
  const Triangle& triangle = (*search.triangles)[arguments->primID];
  const auto [q, feature] = closest_feature(triangle, p);
  const float square = (p - q).squaredNorm();
  if (square >= search.best.square) return false;
  search.best = {q, square, &triangle, feature};
  if (square >= arguments->query->radius * arguments->query->radius) return false;
  arguments->query->radius = std::sqrt(square);
  return true;  // the radius has shrunk
}

class EmbreeObject {
 public:
  EmbreeObject(RTCDevice device, const geometry::Mesh& mesh)
      : triangles_(make_triangles(mesh)), scene_(rtcNewScene(device)) {
    RTCGeometry shape = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(shape, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float), mesh.vertices.size()));
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(shape, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(unsigned), mesh.triangles.size()));
    for (const Vec3& v : mesh.vertices)
      for (Eigen::Index i = 0; i < 3; ++i)
        *vertices++ = static_cast<float>(v[i]);
    for (const auto& t : mesh.triangles)
      for (const std::uint32_t index : t)
        *indices++ = index;
    rtcCommitGeometry(shape);
    rtcAttachGeometry(scene_, shape);
    rtcReleaseGeometry(shape);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(scene_);
  }
  ~EmbreeObject() { rtcReleaseScene(scene_); }
  EmbreeObject(const EmbreeObject&) = delete;
  EmbreeObject& operator=(const EmbreeObject&) = delete;

  /// The closest point within the radius; no triangle when there is none.
  [[nodiscard]] Closest closest(const Vec3f& p, float radius) const {
    Search search{&triangles_, {}};
    RTCPointQuery query{p.x(), p.y(), p.z(), 0, radius};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene_, &query, &context, &visit_triangle, &search);
    return search.best;
  }
  [[nodiscard]] std::size_t triangle_bytes() const { return triangles_.size() * sizeof(Triangle); }

 private:
  std::vector<Triangle> triangles_;
  RTCScene scene_;
};

class Embree final : public Method {
 public:
  explicit Embree(const Scene& scene) : scene_(scene), device_(rtcNewDevice("threads=1,set_affinity=0")) {
    MECHANE_ASSERT(device_ != nullptr);
    // Embree tells its memory, buffers and tree, as it takes it.
    rtcSetDeviceMemoryMonitorFunction(
        device_,
        [](void* sum, ssize_t bytes, bool) {
          *static_cast<std::int64_t*>(sum) += bytes;
          return true;
        },
        &taken_);
    const Stopwatch watch;
    for (const SceneObject& object : scene.objects)
      objects_.push_back(std::make_unique<EmbreeObject>(device_, object.mesh_O));
    build_s_ = watch.seconds();
  }
  ~Embree() override {
    objects_.clear();
    rtcReleaseDevice(device_);
  }

  [[nodiscard]] std::string name() const override { return "embree"; }
  [[nodiscard]] std::size_t bytes() const override {
    auto sum = static_cast<std::size_t>(taken_);
    for (const auto& object : objects_)
      sum += object->triangle_bytes();
    return sum;
  }
  [[nodiscard]] double build_s() const override { return build_s_; }

  void step(const HandStep& hand, Hits& out) override {
    for (std::size_t k = 0; k < objects_.size(); ++k) {
      const SceneObject& object = scene_.objects[k];
      visit_near_clusters(hand, object, [&](std::size_t cluster, const Vec3f& c_O, float radius) {
        // Around a cluster's centre: with no surface within its sphere, all of it is on one side. The side that matters is outside,
        // which the deepest a hand presses (far less than the object's own radius) tells.
        const Closest around = objects_[k]->closest(c_O, std::numeric_limits<float>::infinity());
        const float away = std::sqrt(around.square);
        if (away > radius && (c_O - around.p).dot(normal_of(*around.triangle, around.feature)) > 0) return;
        for (std::size_t i = cluster * kClusterPoints; i < (cluster + 1) * kClusterPoints; ++i) {
          const Vec3f p = point_O(hand, object, i);
          // The surface point nearest to the centre bounds the search.
          const float bound = (p - around.p).norm() * 1.001F + 1e-7F;
          answer(object, k, i, p, objects_[k]->closest(p, bound), out);
        }
      });
    }
  }

  static void answer(const SceneObject& object, std::size_t k, std::size_t point, const Vec3f& p, const Closest& found,
                     Hits& out) {
    if (found.triangle == nullptr) return;
    const Vec3f& pseudo = normal_of(*found.triangle, found.feature);
    const Vec3f way = found.p - p;
    if (way.dot(pseudo) <= 0) return;
    const float depth = std::sqrt(found.square);
    out.add(point, k, depth, object.R_OW.transpose() * (depth > 1e-7F ? Vec3f(way / depth) : pseudo));
  }

 private:
  const Scene& scene_;
  double build_s_ = 0;
  std::int64_t taken_ = 0;
  RTCDevice device_;
  std::vector<std::unique_ptr<EmbreeObject>> objects_;
};

}  // namespace

MethodPtr make_embree(const Scene& scene) {
  return std::make_unique<Embree>(scene);
}

}  // namespace mechane::benchmark
