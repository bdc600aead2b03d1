// The product's own query, through the collision room.
#include "server/base/assert.hpp"
#include "server/collision/object_builder.hpp"
#include "tests/benchmark/collision/culling.hpp"
#include "tests/benchmark/collision/method.hpp"
#include "tests/benchmark/collision/resolution.hpp"

namespace mechane::benchmark {
namespace {

/// Each object as one part, in the map that the collision room makes of it.
class Ours final : public Method {
 public:
  explicit Ours(const Scene& scene) : scene_(scene) {
    const Stopwatch watch;
    for (const SceneObject& object : scene.objects) {
      collision::BuildConfig config;
      config.map_resolution = 32;
      const std::array<geometry::NamedMesh, 1> whole = {{{object.name, object.mesh_O}}};
      auto built = collision::build_object(whole, config);
      MECHANE_ASSERT(built.has_value());
      objects_.push_back(std::move(*built));
    }
    build_s_ = watch.seconds();
  }

  [[nodiscard]] std::string name() const override { return "sqmap"; }
  [[nodiscard]] std::size_t bytes() const override {
    std::size_t sum = 0;
    for (const collision::Object& object : objects_)
      for (const collision::Part& part : object.parts)
        sum += part.map.texels().size_bytes() + sizeof(part);
    return sum;
  }
  [[nodiscard]] double build_s() const override { return build_s_; }

  void step(const HandStep& hand, Hits& out) override {
    for (std::size_t k = 0; k < objects_.size(); ++k) {
      const SceneObject& object = scene_.objects[k];
      const collision::Part& part = objects_[k].parts.front();
      const Pose X_QO = part.X_OQ.inverse();
      const Eigen::Matrix3f R_QO = X_QO.R.toRotationMatrix().cast<float>();
      const Vec3f p_QO = X_QO.p.cast<float>();
      const Eigen::Matrix3f R_WQ = (R_QO * object.R_OW).transpose();
      visit_near_clusters(hand, object, [&](std::size_t cluster, const Vec3f&, float) {
        for (std::size_t i = cluster * kClusterPoints; i < (cluster + 1) * kClusterPoints; ++i) {
          const auto hit = part.map.evaluate(R_QO * point_O(hand, object, i) + p_QO);
          if (hit.hit) out.add(i, k, hit.depth_m, R_WQ * hit.n_Q);
        }
      });
    }
  }

 private:
  const Scene& scene_;
  double build_s_ = 0;
  std::vector<collision::Object> objects_;
};

}  // namespace

MethodPtr make_sqmap(const Scene& scene) {
  return std::make_unique<Ours>(scene);
}

}  // namespace mechane::benchmark
