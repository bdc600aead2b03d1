// The part of the usual view that shows large where hands work: it follows the step gently, from the same place. Pure:
// the time is an argument.
#pragma once

#include <array>
#include <optional>

#include "client-sdk/picture/camera.hpp"
#include "server/base/clock.hpp"

namespace mechane::scene {

class StepView {
 public:
  /// Half of the height shown where hands work, at least, in metres: a closed hand is a fifth of the picture.
  static constexpr double kLeastHalf_m = 0.30;
  static constexpr double kFollows_s = 0.3;
  /// The view stays wide enough for all that happened within this time, and narrows slowly afterwards.
  static constexpr double kRemembers_s = 3;
  static constexpr double kForgets_s = 0.7;

  /// Takes where hands work (RenderScene::work_W) and the usual view; call it once a picture. The first is used at
  /// once, so that a picture of one moment is as good as one of a film.
  void follow(const Eigen::AlignedBox3d& work_W, const picture::Camera& usual, double aspect, TimePoint now);
  /// Call this in place of follow() while a pointer drags something, which must stay under it.
  void hold(TimePoint now) { seen_ = now; }
  /// The camera to draw with.
  [[nodiscard]] picture::Camera shown(const picture::Camera& usual, double aspect) const;
  /// Whether much of the usual view is not shown.
  [[nodiscard]] bool is_narrow() const { return shown_.share < 0.7; }

 private:
  /// A window of the usual view.
  struct Part {
    double x = 0;  ///< of its middle, as ViewWindow
    double y = 0;
    double share = 1;    ///< of the usual view's height
    double depth_m = 0;  ///< of what hands work on, along the usual view's axis

    /// Goes the share `s` of the way to another.
    void approach(const Part& other, double s);
  };
  void remember(const Eigen::AlignedBox2d& seen, double passed_s);
  [[nodiscard]] Part part_for(const picture::Camera& usual, double aspect) const;

  Eigen::AlignedBox2d worked_;             ///< contains where hands have worked lately, as seen_box()
  std::array<double, 2> lower_since_s_{};  ///< since a hand was at its lower side, along x and y
  std::array<double, 2> upper_since_s_{};
  Part wanted_;
  Part halfway_;  ///< between wanted_ and shown_
  Part shown_;
  Vec3 p_WC_ = Vec3::Zero();  ///< of the usual view
  std::optional<TimePoint> seen_;
};

}  // namespace mechane::scene
