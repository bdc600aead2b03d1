#include "client-sdk/display/attract_loop.hpp"

#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/recording/recording_samples.hpp"

namespace mechane::display {
namespace {

using std::chrono::milliseconds;

/// Of a hand that feels three newtons.
class Invitation : public testing::Test {
 protected:
  Invitation() {
    const std::vector<std::byte> bytes = recording::file_of_visit({0, 40, 80, 120});
    const auto file =
        folder_.write("visit.seen", std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    loop_ = AttractLoop::open(file.string(), {folder_.path().string(), nullptr}).value();
  }
  [[nodiscard]] picture::RenderScene at(int ms, const std::string& language = "en") {
    (void)loop_->advance(kBegan + milliseconds(ms));
    return loop_->build(kBegan + milliseconds(ms), language, {});
  }
  /// What a display shows that is asked for arrows of force, in a world of its own.
  [[nodiscard]] picture::RenderScene with_forces() {
    recording::RecordedClient client(recording::played({0, 40, 80, 120}), {});
    scene::ShownWorld world({folder_.path().string(), nullptr}, "en");
    world.show_forces(true);
    client.advance(kBegan);
    (void)world.hear(client);
    client::Frame frame;
    EXPECT_TRUE(client.interpolated_frame(kBegan, Duration{0}, frame));
    return world.build(&frame, client::LinkState::joined);
  }

  static constexpr TimePoint kBegan = TimePoint(std::chrono::hours(3));
  test::ScratchFolder folder_;
  std::unique_ptr<AttractLoop> loop_;
};

TEST_F(Invitation, ItsHandIsSeenAndFeelsNothing) {
  const picture::RenderScene invites = at(0), world = with_forces();
  ASSERT_FALSE(invites.occluders.empty()) << "no hand";
  EXPECT_EQ(invites.instances.size() + 2, world.instances.size()) << "an arrow's shaft and its head";
}

TEST_F(Invitation, IsInTheKiosksLanguageFirstAndAsksNothing) {
  const picture::OverlayContent english = at(0).overlay, greek = at(0, "el").overlay;
  EXPECT_EQ(english.title, "The well");
  EXPECT_EQ(english.caption, "Touch to begin");
  EXPECT_EQ(greek.title, "Το πηγάδι");
  EXPECT_EQ(greek.caption, english.hint);
  EXPECT_EQ(greek.hint, english.caption);
  EXPECT_TRUE(english.readouts.empty());
  EXPECT_EQ(english.steps_total, 0U);
  EXPECT_FALSE(english.panel);
}

TEST_F(Invitation, GoesOnBeginsAnewAndFromItsBeginning) {
  const auto seen_at = [&](int ms) { return at(ms).time_s; };
  EXPECT_NEAR(seen_at(0), 0, 1e-9);
  EXPECT_NEAR(seen_at(80), 0.08, 1e-9);
  EXPECT_LT(seen_at(180), 0.08) << "over and over";
  loop_->rewind();
  EXPECT_NEAR(seen_at(230), 0, 1e-9);
}

}  // namespace
}  // namespace mechane::display
