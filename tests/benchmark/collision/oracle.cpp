#include "tests/benchmark/collision/oracle.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <memory>
#include <thread>
#include <utility>

#include "tests/benchmark/collision/solid_query.hpp"

namespace mechane::benchmark {
namespace {

constexpr double kNear = 0.005;    // of the diagonal: exact answers are kept this far outside
constexpr double kCounts = 0.002;  // of the diagonal: a contact this deep must not be missed, nor be made up

constexpr double kEdgeBand_m = 0.001;
constexpr double kEdgeCosine = 0.8660254;  // of 30 degrees

/// The edges of a mesh in which two faces meet at an angle.
class SharpEdges {
 public:
  explicit SharpEdges(const SceneObject& object) {
    const geometry::Mesh& mesh = object.skin_O.triangles.empty() ? object.mesh_O : object.skin_O;
    std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3> normals;
    for (const auto& t : mesh.triangles) {
      const Vec3 n =
          (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]).normalized();
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t from = t[i];
        const std::uint32_t to = t[(i + 1) % 3];
        const auto [other, fresh] = normals.try_emplace(std::minmax(from, to), n);
        if (!fresh && other->second.dot(n) < kEdgeCosine) edges_.emplace_back(mesh.vertices[from], mesh.vertices[to]);
      }
    }
  }
  [[nodiscard]] bool are_near(const Vec3& p) const {
    return std::any_of(edges_.begin(), edges_.end(), [&](const auto& edge) {
      const Vec3 along = edge.second - edge.first;
      const double share = std::clamp(along.dot(p - edge.first) / along.squaredNorm(), 0.0, 1.0);
      return (edge.first + share * along - p).norm() < kEdgeBand_m;
    });
  }

 private:
  std::vector<std::pair<Vec3, Vec3>> edges_;
};

void ask(const SceneObject& object, std::size_t index, const SolidQuery& query, const SharpEdges& edges,
         const HandStep& hand, std::vector<Oracle::Answer>& out) {
  const Pose X_OW = object.X_WO.inverse();
  const double reach = kNear * object.diagonal_m;
  for (std::uint32_t i = 0; i < kHandPoints; ++i) {
    const Vec3 p = X_OW * Vec3(hand.x[i], hand.y[i], hand.z[i]);
    if (object.box_O.squaredExteriorDistance(p.cast<float>()) > reach * reach * 1.01) continue;
    const bool inside = query.winding(p) > 0;
    const auto closest = query.closest(p);
    if (!inside && closest.distance_m > reach) continue;
    const Vec3 out_O = inside ? Vec3(closest.p - p) : Vec3(p - closest.p);
    // On the very surface no direction is left: the triangle's own.
    const Vec3 n_O = closest.distance_m > 1e-9 ? Vec3(out_O.normalized()) : query.triangle_normal(closest.triangle);
    out.push_back({i, static_cast<std::uint8_t>(index), inside ? -closest.distance_m : closest.distance_m,
                   object.X_WO.rotate(n_O), p.cast<float>(), edges.are_near(closest.p)});
  }
}

double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
}

/// What is gathered of one object before the quantiles are taken.
struct Gathered {
  Agreement counts;
  std::vector<double> errors_pct, angles_deg, faces_deg;
};

/// The hit of each point with each object: at most one, objects do not overlap.
class HitOfPoint {
 public:
  HitOfPoint() : hit_(kHandPoints, kNone) {}
  void set(const Hits& hits) {
    std::fill(hit_.begin(), hit_.end(), kNone);
    for (std::size_t h = 0; h < hits.count; ++h)
      hit_[hits.point[h]] = h;
  }
  /// The hit's index; none when the point hit nothing or another object.
  [[nodiscard]] std::size_t find(const Hits& hits, std::size_t point, std::size_t object) const {
    const std::size_t h = hit_[point];
    return h != kNone && hits.object[h] == object ? h : kNone;
  }
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

 private:
  std::vector<std::size_t> hit_;
};

void compare_answer(const Oracle::Answer& exact, double diagonal, const Hits& hits, std::size_t hit, Gathered& into) {
  const double depth = -exact.distance_m;
  into.counts.deepest_pct = std::max(into.counts.deepest_pct, 100 * depth / diagonal);
  if (hit == HitOfPoint::kNone) {
    if (depth <= 0) return;
    into.errors_pct.push_back(100 * depth / diagonal);
    if (depth > kCounts * diagonal) ++into.counts.missed;
    return;
  }
  const double said = hits.depth_m[hit];
  // Outside by a little and said to be inside by a little: the error is that of the depth, which is 0.
  into.errors_pct.push_back(100 * std::abs(said - std::max(depth, 0.0)) / diagonal);
  if (depth <= 0 && said > kCounts * diagonal) ++into.counts.false_hits;
  if (depth > kCounts * diagonal && said > kCounts * diagonal) {
    const Vec3 n(hits.n_x[hit], hits.n_y[hit], hits.n_z[hit]);
    into.angles_deg.push_back(180 / kPi * std::atan2(n.cross(exact.n_W).norm(), n.dot(exact.n_W)));
    if (!exact.at_edge) into.faces_deg.push_back(into.angles_deg.back());
  }
}

}  // namespace

Oracle::Oracle(const Scene& scene, std::size_t steps) {
  std::vector<std::unique_ptr<SolidQuery>> queries;
  for (const SceneObject& object : scene.objects)
    queries.push_back(std::make_unique<SolidQuery>(object));
  const std::vector<SharpEdges> edges(scene.objects.begin(), scene.objects.end());
  steps = std::min(steps, scene.steps.size());
  steps_.resize(steps);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    const auto hand = std::make_unique<HandStep>();
    for (std::size_t i = next++; i < steps; i = next++) {
      steps_[i].step = (2 * i + 1) * scene.steps.size() / (2 * steps);
      scene.fill(steps_[i].step, *hand);
      for (std::size_t k = 0; k < scene.objects.size(); ++k)
        ask(scene.objects[k], k, *queries[k], edges[k], *hand, steps_[i].near);
    }
  };
  std::vector<std::jthread> others;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i)
    others.emplace_back(work);
  work();
}

std::array<std::vector<KnownPoint>, kSceneObjects> Oracle::known_points() const {
  std::array<std::vector<KnownPoint>, kSceneObjects> points;
  for (const Step& step : steps_)
    for (const Answer& answer : step.near)
      points[answer.object].push_back({answer.p_O, answer.distance_m});
  return points;
}

std::array<Agreement, kSceneObjects> compare(const Scene& scene, const Oracle& oracle, Method& method) {
  std::array<Gathered, kSceneObjects> gathered;
  const auto hand = std::make_unique<HandStep>();
  const auto hits = std::make_unique<Hits>();
  HitOfPoint hit_of;
  std::vector<bool> judged(kHandPoints);
  for (const Oracle::Step& step : oracle.steps()) {
    scene.fill(step.step, *hand);
    hits->count = 0;
    method.step(*hand, *hits);
    hit_of.set(*hits);
    judged.assign(kHandPoints, false);
    for (const Oracle::Answer& exact : step.near) {
      const std::size_t hit = hit_of.find(*hits, exact.point, exact.object);
      compare_answer(exact, scene.objects[exact.object].diagonal_m, *hits, hit, gathered[exact.object]);
      if (hit != HitOfPoint::kNone) judged[exact.point] = true;
    }
    for (std::size_t h = 0; h < hits->count; ++h) {  // hits far outside of what they claim to be in
      if (judged[hits->point[h]]) continue;
      Gathered& into = gathered[hits->object[h]];
      const double diagonal = scene.objects[hits->object[h]].diagonal_m;
      into.errors_pct.push_back(100 * static_cast<double>(hits->depth_m[h]) / diagonal);
      if (hits->depth_m[h] > kCounts * diagonal) ++into.counts.false_hits;
    }
  }
  std::array<Agreement, kSceneObjects> result;
  for (std::size_t k = 0; k < kSceneObjects; ++k) {
    result[k] = gathered[k].counts;
    result[k].points = gathered[k].errors_pct.size();
    result[k].error_p50_pct = quantile(gathered[k].errors_pct, 0.5);
    result[k].error_p99_pct = quantile(gathered[k].errors_pct, 0.99);
    result[k].error_max_pct = quantile(gathered[k].errors_pct, 1);
    result[k].normal_p50_deg = quantile(gathered[k].angles_deg, 0.5);
    result[k].faces_p99_deg = quantile(gathered[k].faces_deg, 0.99);
    result[k].normal_p99_deg = quantile(gathered[k].angles_deg, 0.99);
  }
  return result;
}

}  // namespace mechane::benchmark
