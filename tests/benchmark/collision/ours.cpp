// The product's own query, through the collision room.
#include <array>

#include "server/base/assert.hpp"
#include "server/collision/object_builder.hpp"
#include "server/collision/point_query.hpp"
#include "tests/benchmark/collision/method.hpp"
#include "tests/benchmark/collision/resolution.hpp"

namespace mechane::benchmark {
namespace {

collision::BuildConfig config_for(const SceneObject& object, OurMaps maps) {
  collision::BuildConfig config;
  config.parts = collision::Parts::decomposed;
  config.max_error_m = 1;  // the share alone: these objects have no touchable size of their own
  config.probe_depth_m = 0.015 * object.diagonal_m;
  config.bricks = maps != OurMaps::radial_only;
  return config;
}

class Ours final : public Method {
 public:
  Ours(const Scene& scene, std::string name, OurMaps maps, collision::InstructionSet set)
      : name_(std::move(name)), kernels_(collision::kernels_of(set)), found_(kHandPoints) {
    const Stopwatch watch;
    for (const SceneObject& object : scene.objects) {
      const std::array<geometry::NamedMesh, 1> whole = {{{object.name, object.mesh_O}}};
      auto built = collision::build_object(whole, config_for(object, maps));
      MECHANE_ASSERT(built.has_value());
      objects_.push_back(std::move(*built));
    }
    build_s_ = watch.seconds();
    for (std::size_t k = 0; k < objects_.size(); ++k)
      placed_.emplace_back(objects_[k], scene.objects[k].X_WO);
  }

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::size_t bytes() const override {
    std::size_t sum = 0;
    for (const collision::Object& object : objects_)
      for (const collision::Part& part : object.parts)
        sum += part.map.bytes() + sizeof(part) + sizeof(collision::PlacedPart);
    return sum;
  }
  [[nodiscard]] double build_s() const override { return build_s_; }
  [[nodiscard]] std::vector<MapShare> maps() const override {
    std::vector<MapShare> shares;
    for (std::size_t k = 0; k < objects_.size(); ++k) {
      for (const collision::Part& part : objects_[k].parts)
        shares.push_back({k, part.map.name(), part.map.radial() != nullptr, part.map.bytes()});
    }
    return shares;
  }

  void step(const HandStep& hand, Hits& out) override {
    const collision::PointSet points{
        {hand.x.data(), hand.y.data(), hand.z.data()},
        {hand.cluster_x.data(), hand.cluster_y.data(), hand.cluster_z.data(), hand.cluster_r.data()},
        {hand.segment_x.data(), hand.segment_y.data(), hand.segment_z.data(), hand.segment_r.data()},
        kSegments,
        kSegmentClusters,
        hand.center,
        hand.radius};
    for (std::size_t k = 0; k < placed_.size(); ++k) {
      found_.count = 0;
      placed_[k].query(points, found_, kernels_);
      for (std::size_t i = 0; i < found_.count; ++i)
        out.add(found_.point[i], k, found_.depth_m[i], {found_.n_x[i], found_.n_y[i], found_.n_z[i]});
    }
  }

 private:
  std::string name_;
  const collision::Kernels& kernels_;
  collision::PointHits found_;
  double build_s_ = 0;
  std::vector<collision::Object> objects_;
  std::vector<collision::PlacedObject> placed_;
};

}  // namespace

MethodPtr make_sqmap(const Scene& scene, const std::string& name, OurMaps maps, collision::InstructionSet set) {
  return std::make_unique<Ours>(scene, name, maps, set);
}

}  // namespace mechane::benchmark
