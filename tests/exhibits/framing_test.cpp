// In each exhibit's good visits the hand and what it works on are large in the picture, and above the captions.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "client-sdk/scene/step_view.hpp"
#include "tests/support/pointer_play.hpp"
#include "tests/support/shipped_exhibits.hpp"

namespace mechane {
namespace {

constexpr double kAspect = 16.0 / 9;
constexpr std::uint64_t kTicksPerLook = 40;
/// Captions of two lines cover this share of the picture's height.
constexpr double kCaption = 0.33;
/// How long the hand may be covered while the view follows it.
constexpr double kCovered_s = 1;
/// The view has narrowed by this time after a hand has taken something.
constexpr double kArrives_s = scene::StepView::kRemembers_s + 1.5;

class Framing : public testing::TestWithParam<std::string> {};

/// Looks at a visit as a display would.
class Onlooker {
 public:
  Onlooker(visitor::ShownExhibit& shown, const state::WorldDescription& description)
      : shown_(shown), description_(description) {}

  void see(const state::WorldState& state) {
    if (state.tick % kTicksPerLook != 0) return;
    test::show(state, description_, frame_, status_);
    const picture::RenderScene scene = shown_.scene(frame_, &status_);
    const double now_s = static_cast<double>(state.tick) * kTickSeconds;
    view_.follow(scene.work_W, scene.camera, kAspect, TimePoint(std::chrono::milliseconds(state.tick)));
    const bool works = !scene.work_W.isEmpty() && std::ranges::any_of(frame_.hands, &client::HandPose::holding);
    if (!works) {
      took_s_ = covered_s_ = now_s;
    } else {
      judge(scene, now_s);
    }
  }

  std::vector<double> sizes;     ///< of hand and part while it is held, as shares of the picture's height
  double longest_covered_s = 0;  ///< of a hand that holds something, by captions

 private:
  void judge(const picture::RenderScene& scene, double now_s) {
    const picture::Camera camera = view_.shown(scene.camera, kAspect);
    const double half = picture::whole_window(camera, kAspect).half_height;
    Eigen::AlignedBox3d hand_W;
    for (const picture::Occluder& segment : scene.occluders)
      hand_W.extend(segment.p_WO.cast<double>());
    if (picture::seen_box(camera, hand_W).min().y() > half * (2 * kCaption - 1)) covered_s_ = now_s;
    longest_covered_s = std::max(longest_covered_s, now_s - covered_s_);
    if (now_s - took_s_ < kArrives_s) return;
    sizes.push_back(picture::seen_box(camera, scene.work_W).sizes().maxCoeff() / (2 * half));
  }

  visitor::ShownExhibit& shown_;
  const state::WorldDescription& description_;
  scene::StepView view_;
  client::Frame frame_;
  client::WorldStatus status_;
  double took_s_ = 0;     ///< since when the hand has held something
  double covered_s_ = 0;  ///< when it was last not covered
};

TEST_P(Framing, HandAndPartAreAFifthOfThePictureAndAboveTheCaptions) {
  const test::Exhibit exhibit(GetParam());
  const auto shown = test::show_exhibit(exhibit.description());
  bool held = false;
  for (const state::VisitDescription& script : exhibit.description().visits) {
    if (script.name.starts_with("mistakes")) continue;
    Onlooker onlooker(*shown, exhibit.description());
    test::PlayOptions options;
    options.watch = [&](const state::WorldState& state) { onlooker.see(state); };
    EXPECT_TRUE(test::arrived(exhibit.play(script.name, options), exhibit.description())) << script.name;
    EXPECT_LE(onlooker.longest_covered_s, kCovered_s) << script.name;
    std::vector<double>& sizes = onlooker.sizes;
    if (sizes.size() < 10) continue;  // nothing was held for long
    held = true;
    std::ranges::sort(sizes);
    // The pump's lever takes the hand up and down by more than a metre, and all of that is shown.
    EXPECT_GE(sizes.front(), GetParam() == "ktesibios-pump" ? 0.15 : 0.2) << script.name;
  }
  EXPECT_EQ(held, GetParam() != "village") << "only its signs are not held";
}

INSTANTIATE_TEST_SUITE_P(Shipped, Framing, testing::ValuesIn(test::shipped_exhibits()),
                         [](const auto& of) { return test::test_name(of.param); });

}  // namespace
}  // namespace mechane
