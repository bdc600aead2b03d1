// FCL: trees of oriented boxes (OBBRSS) over the hand's segments and the objects. It collides meshes and returns contacts of
// triangles, not depths of points: listed apart.
#include <algorithm>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>

#include "tests/benchmark/collision/culling.hpp"
#include "tests/benchmark/collision/fcl_common.hpp"
#include "tests/benchmark/collision/method.hpp"
#include "tests/benchmark/collision/resolution.hpp"

namespace mechane::benchmark {
namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<Model> make_model(const geometry::Mesh& mesh) {
  auto model = std::make_shared<Model>();
  model->beginModel(static_cast<int>(mesh.triangles.size()), static_cast<int>(mesh.vertices.size()));
  std::vector<fcl::Triangle> triangles;
  for (const auto& t : mesh.triangles)
    triangles.emplace_back(t[0], t[1], t[2]);
  model->addSubModel(mesh.vertices, triangles);
  model->endModel();
  return model;
}

enum class Asked { contacts, yes_or_no };

class Fcl final : public Method {
 public:
  Fcl(const Scene& scene, Asked asked) : scene_(scene), asked_(asked) {
    const Stopwatch watch;
    for (const SceneObject& object : scene.objects) {
      objects_.push_back(make_model(object.mesh_O));
      X_WO_.push_back(fcl_transform(object.X_WO));
    }
    build_s_ = watch.seconds();
    for (const Segment& segment : scene.hand)
      segments_.push_back(make_model(segment.mesh_S));
    constexpr std::size_t kAll = 1U << 20U;
    request_ = asked == Asked::contacts ? fcl::CollisionRequestd(kAll, true) : fcl::CollisionRequestd(1, false);
  }

  [[nodiscard]] std::string name() const override { return asked_ == Asked::contacts ? "fcl_contacts" : "fcl_yesno"; }
  [[nodiscard]] std::size_t bytes() const override {
    std::size_t sum = 0;
    for (const auto& object : objects_)
      sum += static_cast<std::size_t>(object->getNumBVs()) * sizeof(fcl::BVNode<fcl::OBBRSSd>) +
             static_cast<std::size_t>(object->num_tris) * (sizeof(fcl::Triangle) + sizeof(unsigned)) +
             static_cast<std::size_t>(object->num_vertices) * sizeof(fcl::Vector3d);
    return sum;
  }
  [[nodiscard]] double build_s() const override { return build_s_; }
  [[nodiscard]] bool answers_points() const override { return false; }
  [[nodiscard]] double mesh_contacts_per_step() const override { return contacts_ / std::max(steps_, 1.0); }

  void step(const HandStep& hand, Hits&) override {
    ++steps_;
    for (std::size_t k = 0; k < objects_.size(); ++k) {
      const SceneObject& object = scene_.objects[k];
      if (!reaches(object, object.R_OW * hand.center + object.p_OW, hand.radius)) continue;
      for (std::size_t s = 0; s < kSegments; ++s) {
        const Vec3f p_W(hand.segment_x[s], hand.segment_y[s], hand.segment_z[s]);
        if (!reaches(object, object.R_OW * p_W + object.p_OW, hand.segment_r[s])) continue;
        result_.clear();
        fcl::collide(segments_[s].get(), fcl_transform(hand.X_WS[s]), objects_[k].get(), X_WO_[k], request_, result_);
        contacts_ += static_cast<double>(result_.numContacts());
      }
    }
  }

 private:
  const Scene& scene_;
  Asked asked_;
  double build_s_ = 0;
  double steps_ = 0;
  double contacts_ = 0;
  fcl::CollisionRequestd request_;
  fcl::CollisionResultd result_;
  std::vector<std::shared_ptr<Model>> objects_, segments_;
  std::vector<fcl::Transform3d> X_WO_;
};

}  // namespace

MethodPtr make_fcl_contacts(const Scene& scene) {
  return std::make_unique<Fcl>(scene, Asked::contacts);
}

MethodPtr make_fcl_yesno(const Scene& scene) {
  return std::make_unique<Fcl>(scene, Asked::yes_or_no);
}

}  // namespace mechane::benchmark
