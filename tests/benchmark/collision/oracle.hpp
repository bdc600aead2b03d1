// The exact answer, and how far a method's answer is from it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tests/benchmark/collision/method.hpp"
#include "tests/benchmark/collision/scene.hpp"

namespace mechane::benchmark {

/// What the meshes say of the hand's points at some of the steps, in double precision.
class Oracle {
 public:
  /// Asks at `steps` of the scene's steps, evenly spread. On all cores.
  Oracle(const Scene& scene, std::size_t steps);

  struct Answer {
    std::uint32_t point = 0;
    std::uint8_t object = 0;
    double distance_m = 0;  ///< negative inside
    Vec3 n_W = Vec3::Zero();
    Vec3f p_O = Vec3f::Zero();
    bool at_edge = false;  ///< the nearest place of the surface lies within 1 mm of an edge of over 30 degrees
  };
  /// The answers at one step: only points inside, or outside by less than half a per cent of the diagonal.
  struct Step {
    std::size_t step = 0;
    std::vector<Answer> near;
  };
  [[nodiscard]] std::span<const Step> steps() const { return steps_; }

  /// All near points of each object, for the choice of resolutions.
  [[nodiscard]] std::array<std::vector<KnownPoint>, kSceneObjects> known_points() const;

 private:
  std::vector<Step> steps_;
};

/// A method's answers against the exact ones, for one object.
struct Agreement {
  std::size_t points = 0;                                          ///< inside, by either
  double error_p50_pct = 0, error_p99_pct = 0, error_max_pct = 0;  ///< of the depth, in % of the diagonal
  double normal_p50_deg = 0, normal_p99_deg = 0;                   ///< where both are deeper than 0.2 %
  double faces_p99_deg = 0;                                        ///< the same, of answers that are not at_edge
  std::size_t missed = 0;                                          ///< exact deeper than 0.2 %, no hit
  std::size_t false_hits = 0;                                      ///< hit deeper than 0.2 %, exact outside
  double deepest_pct = 0;                                          ///< exact
};

[[nodiscard]] std::array<Agreement, kSceneObjects> compare(const Scene& scene, const Oracle& oracle, Method& method);

}  // namespace mechane::benchmark
