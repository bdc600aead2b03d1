// The product's own query, through the collision room.
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

#include "server/base/assert.hpp"
#include "server/collision/point_query.hpp"
#include "server/collision_build/object_builder.hpp"
#include "tests/benchmark/collision/method.hpp"
#include "tests/benchmark/collision/resolution.hpp"

namespace mechane::benchmark {
namespace {

collision_build::BuildConfig config_for(const SceneObject& object, OurMaps maps, double error_share) {
  collision_build::BuildConfig config;
  config.parts = object.parts_O.empty() ? collision_build::Parts::decomposed : collision_build::Parts::as_given;
  config.miss_share *= error_share / config.max_error_share;
  config.max_error_share = error_share;
  config.max_error_m = object.max_error_m;
  config.probe_depth_m = object.probe_depth_m;
  config.bricks = maps != OurMaps::radial_only;
  config.fields = maps == OurMaps::fields;
  config.bounds = maps == OurMaps::boxes ? collision_build::Bounds::boxes : collision_build::Bounds::superquadrics;
  return config;
}

std::size_t bytes_of(const collision::Object& object) {
  std::size_t sum = 0;
  for (const collision::Part& part : object.parts)
    sum += part.map.bytes() + sizeof(part) + sizeof(collision::PlacedPart);
  return sum;
}

// Where copies of the scene stand.
constexpr double kRow_m = 2;
constexpr double kInRow = 15;

class Ours final : public Method {
 public:
  Ours(const Scene& scene, std::string name, std::shared_ptr<const OurObjects> built, collision::InstructionSet set,
       NearLists lists, std::size_t objects)
      : name_(std::move(name)),
        kernels_(collision::kernels_of(set)),
        lists_(lists),
        found_(kHandPoints),
        built_(std::move(built)) {
    for (std::size_t k = 0; k < objects; ++k) {
      const std::size_t of = k % built_->objects.size();
      Pose X_WO = scene.objects[of].X_WO;
      const auto copy = static_cast<double>(k / built_->objects.size());
      if (copy > 0) X_WO.p += kRow_m * Vec3(std::fmod(copy, kInRow), 1 + std::floor(copy / kInRow), 0);
      placed_.emplace_back(built_->objects[of], X_WO);
      near_.emplace_back(kHandPoints, kSegments);
    }
  }

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::vector<std::size_t> bytes_by_object() const override {
    std::vector<std::size_t> bytes;
    for (const collision::Object& object : built_->objects)
      bytes.push_back(bytes_of(object));
    return bytes;
  }
  [[nodiscard]] double build_s() const override { return built_->build_s; }
  [[nodiscard]] std::vector<MapShare> maps() const override {
    std::vector<MapShare> shares;
    for (std::size_t k = 0; k < built_->objects.size(); ++k) {
      for (const collision::Part& part : built_->objects[k].parts)
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
        hand.radius,
        {hand.quad_x.data(), hand.quad_y.data(), hand.quad_z.data(), hand.quad_r.data()},
        rotations_of(hand)};
    for (std::size_t k = 0; k < placed_.size(); ++k) {
      found_.count = 0;
      if (lists_ == NearLists::used) {
        placed_[k].query(points, near_[k], found_, kernels_);
      } else {
        placed_[k].query(points, found_, kernels_);
      }
      const std::size_t count = std::min(found_.count, kHandPoints - out.count);
      const auto copy = [&](const auto& from, auto& to) { std::copy_n(from.begin(), count, &to[out.count]); };
      copy(found_.point, out.point);
      copy(found_.depth_m, out.depth_m);
      copy(found_.n_x, out.n_x);
      copy(found_.n_y, out.n_y);
      copy(found_.n_z, out.n_z);
      std::fill_n(&out.object[out.count], count, static_cast<std::uint8_t>(k));
      out.count += count;
    }
  }

 private:
  std::string name_;
  const collision::Kernels& kernels_;
  NearLists lists_;
  collision::PointHits found_;
  std::shared_ptr<const OurObjects> built_;
  std::vector<collision::PlacedObject> placed_;
  std::vector<collision::NearList> near_;
};

}  // namespace

std::shared_ptr<const OurObjects> build_ours(const Scene& scene, OurMaps maps, double error_share) {
  auto built = std::make_shared<OurObjects>();
  const Stopwatch watch;
  for (const SceneObject& object : scene.objects) {
    const std::array<geometry::NamedMesh, 1> whole = {{{object.name, object.mesh_O}}};
    auto made = object.parts_O.empty()
                    ? collision_build::build_object(whole, config_for(object, maps, error_share))
                    : collision_build::build_object(object.parts_O, config_for(object, maps, error_share));
    if (!made) std::cerr << object.name << ": " << made.error().what << "; " << made.error().remedy << "\n";
    MECHANE_ASSERT(made.has_value());
    built->objects.push_back(std::move(*made));
  }
  built->build_s = watch.seconds();
  return built;
}

MethodPtr make_sqmap(const Scene& scene, const std::string& name, std::shared_ptr<const OurObjects> built,
                     collision::InstructionSet set, NearLists lists) {
  const std::size_t objects = built->objects.size();
  return std::make_unique<Ours>(scene, name, std::move(built), set, lists, objects);
}

MethodPtr make_crowd(const Scene& scene, const std::string& name, std::shared_ptr<const OurObjects> built,
                     std::size_t objects) {
  return std::make_unique<Ours>(scene, name, std::move(built), collision::best_set(), NearLists::used, objects);
}

}  // namespace mechane::benchmark
