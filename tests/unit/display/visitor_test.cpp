#include "client-sdk/display/visitor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "client-sdk/display/kiosk_setup.hpp"
#include "client-sdk/picture/sight.hpp"
#include "server/log/log.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/display/scripted_client.hpp"

namespace mechane::display {
namespace {

using picture::OverlayAction;
using pointer::PointerEvent;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr picture::PixelSize kGlass{640, 360};
/// Where nothing else than a test's button is.
constexpr picture::PixelPlace kOnButton{10, 10};

/// A window without a screen: what happens in it is put in.
class WindowOfTest final : public Window {
 public:
  std::vector<DisplayKey> keys;
  std::vector<picture::PixelPlace> clicks;
  std::vector<PointerEvent> events;

  [[nodiscard]] std::string renderer_name() const override { return {}; }
  [[nodiscard]] picture::PixelSize size() const override { return kGlass; }
  void present() override {}
  [[nodiscard]] bool lost() const override { return false; }
  [[nodiscard]] Expected<void> renew() override { return {}; }
  [[nodiscard]] int first_row() const override { return 0; }
  [[nodiscard]] bool has_quad_buffer() const override { return false; }
  [[nodiscard]] bool close_wanted() const override { return false; }
  [[nodiscard]] bool take_picture_wanted() override { return false; }
  [[nodiscard]] std::vector<picture::PixelPlace> take_clicks() override { return std::exchange(clicks, {}); }
  [[nodiscard]] std::vector<PointerEvent> take_pointer_events() override { return std::exchange(events, {}); }
  [[nodiscard]] std::vector<DisplayKey> take_keys() override { return std::exchange(keys, {}); }
};

/// A hand that holds whatever it is pressed on, at once.
class HandOfTest final : public pointer::PointerTouch {
 public:
  void press(const picture::Sight&, picture::PixelPlace, const picture::Touched&) override { holds_ = true; }
  void move(picture::PixelPlace) override {}
  void deepen(double) override {}
  void turn(double) override {}
  void release() override { holds_ = false; }
  [[nodiscard]] pointer::PointerView view() override {
    pointer::PointerView view;
    if (holds_) view.phase = pointer::PointerView::Phase::holding;
    return view;
  }
  [[nodiscard]] pointer::PointerLinkState state() override { return pointer::PointerLinkState::joined; }

 private:
  bool holds_ = false;
};

/// A display in English in the world of a well, whose bucket can be taken.
class VisitorTest : public testing::Test {
 protected:
  VisitorTest() {
    auto client = std::make_unique<ScriptedClient>();
    client_ = client.get();
    source_.client = std::move(client);
    options_.language = "en";
    settings_.attract_after_s = 10;
    enter("world-1");
    layout_.size = kGlass;
    last_ = {kGlass, picture::Stereo::mono, &layout_, false};
  }

  void enter(const std::string& world) {
    client_->enter(world);
    client::WorldPresentation presentation = *client_->presented;
    client::Activity& activity = presentation.activities.front();
    activity.questions.push_back(activity.questions.front());
    activity.questions.back().name = "why";
    presentation.affordances = {{client::Affordance::Kind::taken, "", 1, {}, {}, {}}};
    client_->presented = std::make_shared<client::WorldPresentation>(presentation);
    client_->between = recording::frame_of_visit(1, Duration{0}, {});
  }
  /// Shows this visit while nobody is there: of one world, and of another from 100 ms on.
  void open_invitation(const std::vector<int>& times_ms = {0, 40, 80, 120, 160}) {
    const std::vector<std::byte> bytes = recording::file_of_visit(times_ms, 100);
    const auto file =
        folder_.write("visit.seen", std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    attract_ = AttractLoop::open(file.string(), assets()).value();
  }
  [[nodiscard]] scene::AssetSource assets() const { return {folder_.path().string(), nullptr}; }
  [[nodiscard]] News& news() {
    if (!news_) news_.emplace(options_, source_, assets());
    return *news_;
  }
  [[nodiscard]] Visitor& visitor() {
    if (!visitor_) {
      News& heard = news();
      visitor_.emplace(options_, &window_, heard, std::move(attract_), std::make_unique<HandOfTest>());
    }
    return *visitor_;
  }

  [[nodiscard]] static TimePoint at(double s) {
    return TimePoint(std::chrono::hours(3)) + std::chrono::duration_cast<Duration>(std::chrono::duration<double>(s));
  }
  [[nodiscard]] picture::RenderScene scene() { return news().world().build(news().frame(), client_->state()); }
  /// One picture. True: all uploaded assets are to be replaced.
  bool picture(double s) {
    (void)news().take(at(s));
    visitor().take(
        last_, [this] { return scene(); }, at(s));
    return visitor().invite(settings_, at(s));
  }
  /// Takes the commands that were sent since the last call.
  [[nodiscard]] std::vector<std::string> sent() { return std::exchange(client_->sent, {}); }
  [[nodiscard]] picture::RenderScene written(double s) {
    picture::RenderScene written = scene();
    visitor().write(written, last_, at(s));
    return written;
  }

  /// The last picture had this button, and no other.
  void cover(picture::PixelPlace place, const OverlayAction& action) {
    layout_.targets = {{static_cast<float>(place.x) - 5, static_cast<float>(place.y) - 5, 10, 10, action}};
  }
  void press(const OverlayAction& action) {
    cover(kOnButton, action);
    window_.clicks.push_back(kOnButton);
  }
  [[nodiscard]] picture::PixelPlace bucket() {
    const auto sight = picture::seen_place(scene().camera, picture::Stereo::mono, kGlass, {1, 1})->sight;
    return *picture::pixel_of(sight, client_->between->bodies[1].X_WB.p);
  }
  void mouse(PointerEvent::Kind kind, picture::PixelPlace place) { window_.events.push_back({kind, place.x, place.y}); }

  test::ScratchFolder folder_;
  DisplayOptions options_;
  client::DisplaySettings settings_;
  DisplaySource source_;
  ScriptedClient* client_ = nullptr;
  WindowOfTest window_;
  draw::OverlayLayout layout_;
  LastPicture last_;
  std::unique_ptr<AttractLoop> attract_;
  std::optional<News> news_;
  std::optional<Visitor> visitor_;
};

TEST_F(VisitorTest, TheServerIsToldTheLanguageOncePerWorldAndWhenItChanges) {
  picture(0);
  picture(1);
  EXPECT_THAT(sent(), ElementsAre("language en"));
  window_.keys = {DisplayKey::language};
  picture(2);
  picture(3);
  EXPECT_THAT(sent(), ElementsAre("language el"));
  EXPECT_EQ(visitor().language(), "el");
  EXPECT_EQ(scene().overlay.title, "Το πηγάδι");
  enter("world-2");
  picture(4);
  picture(5);
  EXPECT_THAT(sent(), ElementsAre("language el"));
}

TEST_F(VisitorTest, ALanguageThatCouldNotBeToldIsToldLater) {
  client_->link = client::LinkState::lost;
  picture(0);
  EXPECT_THAT(sent(), IsEmpty());
  client_->link = client::LinkState::joined;
  client_->sends = false;
  picture(1);
  client_->sends = true;
  picture(2);
  picture(3);
  EXPECT_THAT(sent(), ElementsAre("language en"));
}

TEST_F(VisitorTest, WhereTheWorldDoesNotSpeakTheLanguageTheServerIsToldWhatIsShown) {
  client::WorldPresentation foreign = *client_->presented;
  foreign.languages = {"fr", "de"};
  client_->presented = std::make_shared<client::WorldPresentation>(foreign);
  picture(0);
  EXPECT_THAT(sent(), ElementsAre("language fr"));
}

TEST_F(VisitorTest, AnswersAreSentInOrderAndADoubleTapIsOne) {
  client_->status->done = true;
  picture(0);
  picture(5);
  EXPECT_TRUE(written(5).overlay.panel);
  (void)sent();
  press({OverlayAction::Kind::answer, "by-rope"});
  window_.clicks.push_back(kOnButton);
  picture(6);
  press({OverlayAction::Kind::answer, "by-rope"});
  picture(7);
  EXPECT_THAT(sent(), ElementsAre("answer how by-rope", "answer why by-rope"));
}

TEST_F(VisitorTest, AnAnswerThatCouldNotBeSentIsLoggedOnce) {
  client_->status->done = true;
  picture(0);
  picture(5);
  client_->sends = false;
  log::start("test", log::Level::warning);  // counts its warnings from zero
  press({OverlayAction::Kind::answer, "by-rope"});
  picture(6);
  picture(7);
  EXPECT_EQ(log::trouble().count, 1U);
  EXPECT_NE(log::trouble().last.find("'how'"), std::string::npos);
}

TEST_F(VisitorTest, QuestionsAreNotCoveredByACloseUp) {
  client_->status->done = true;
  picture(0);
  for (const bool asks : {false, true}) {
    picture(asks ? 5 : 0);
    picture::RenderScene drawn = scene();
    drawn.inset.emplace();
    visitor().write(drawn, last_, at(asks ? 5 : 0));
    EXPECT_EQ(drawn.overlay.panel.has_value(), asks);
    EXPECT_EQ(drawn.inset.has_value(), !asks);
  }
}

TEST_F(VisitorTest, QuestionsDoNotCoverAPoseAndEndWhileItIsAskedFor) {
  client_->status->done = true;
  client_->at_hand = {{.kind = client::HandKind::glove, .calibration = {client::CalibrationStep::fist}}};
  picture(0);
  for (int s = 5; s < 60; ++s) {
    picture(s);
    picture::RenderScene drawn = scene();
    drawn.overlay.pose = news().calibration().at(at(s), "en");
    drawn.inset.emplace();
    visitor().write(drawn, last_, at(s));
    ASSERT_TRUE(drawn.overlay.pose && !drawn.overlay.panel && !drawn.inset);
    ASSERT_EQ(written(s).overlay.panel.has_value(), s < 50) << s;
  }
}

TEST_F(VisitorTest, AClickIsOnTheThingThatIsSeenButNotThroughAButtonOrAPanel) {
  picture(0);
  (void)sent();
  window_.clicks = {bucket()};
  picture(1);
  EXPECT_THAT(sent(), ElementsAre("click BUCKET"));
  last_.has_panel = true;
  window_.clicks = {bucket()};
  picture(2);
  last_.has_panel = false;
  const picture::PixelPlace place = bucket();
  cover(place, {OverlayAction::Kind::activity, "use"});
  window_.clicks = {place};
  picture(3);
  EXPECT_THAT(sent(), ElementsAre("start use"));
}

TEST_F(VisitorTest, AKeyAndAButtonLeadHomeFromElsewhere) {
  picture(0);
  (void)sent();
  window_.keys = {DisplayKey::home};
  picture(1);
  EXPECT_THAT(sent(), ElementsAre("open "));
  for (const auto& [home, requests] : {std::pair("village", 1U), std::pair("well-world-1", 0U)}) {
    client_->server.emplace().scenarios = {home, "other"};
    picture(2);
    press({OverlayAction::Kind::home});
    picture(3);
    EXPECT_EQ(sent().size(), requests) << home;
  }
}

TEST_F(VisitorTest, TheForcesKeyShowsArrowsAndHidesThem) {
  picture(0);
  const std::size_t without = scene().instances.size();
  window_.keys = {DisplayKey::forces};
  picture(1);
  EXPECT_EQ(scene().instances.size(), without + 2);
  window_.keys = {DisplayKey::forces};
  picture(2);
  EXPECT_EQ(scene().instances.size(), without);
}

TEST_F(VisitorTest, ForcesAreShownFromTheStartIfAskedForAndTheKeyHidesThem) {
  options_.forces = true;
  picture(0);
  const std::size_t with = scene().instances.size();
  window_.keys = {DisplayKey::forces};
  picture(1);
  EXPECT_EQ(scene().instances.size() + 2, with);
}

TEST_F(VisitorTest, WhatWasPointedAtIsForgottenWithItsWorld) {
  picture(0);
  EXPECT_FALSE(visitor().pointed_at());
  mouse(PointerEvent::Kind::move, bucket());
  picture(1);
  ASSERT_TRUE(visitor().pointed_at());
  EXPECT_EQ(visitor().pointed_at()->object, 1U);
  visitor().forget_world();
  EXPECT_FALSE(visitor().pointed_at());
}

TEST_F(VisitorTest, ThePointerTakesWhatIsUnderItButNotThroughAPanelOrAButton) {
  picture(0);
  const auto drags_when_pressed = [this](double s) {
    mouse(PointerEvent::Kind::press, bucket());
    picture(s);
    return visitor().drags();
  };
  last_.has_panel = true;
  EXPECT_FALSE(drags_when_pressed(1));
  last_.has_panel = false;
  cover(bucket(), {OverlayAction::Kind::language, "el"});
  EXPECT_FALSE(drags_when_pressed(2));
  layout_.targets.clear();
  EXPECT_TRUE(drags_when_pressed(3));
  mouse(PointerEvent::Kind::release, bucket());
  picture(4);
  EXPECT_FALSE(visitor().drags());
}

TEST_F(VisitorTest, TheButtonUnderTheMouseIsMarked) {
  picture(0);
  EXPECT_FALSE(written(0).overlay.meant);
  const OverlayAction greek{OverlayAction::Kind::language, "el"};
  cover({100, 100}, greek);
  mouse(PointerEvent::Kind::move, {100, 100});
  picture(1);
  EXPECT_EQ(written(1).overlay.meant, greek);
}

TEST_F(VisitorTest, ARecordingCannotBeTouched) {
  options_.source.play = "visit.seen";
  picture(0);
  mouse(PointerEvent::Kind::move, bucket());
  mouse(PointerEvent::Kind::press, bucket());
  picture(1);
  EXPECT_FALSE(visitor().pointed_at());
  EXPECT_FALSE(visitor().drags());
}

TEST_F(VisitorTest, AnInvitationAsksForOtherAssetsExactlyWhenOthersAreShown) {
  open_invitation();
  EXPECT_FALSE(picture(0));
  EXPECT_FALSE(picture(9.9));
  EXPECT_EQ(visitor().invitation(), nullptr);
  EXPECT_TRUE(picture(10));
  EXPECT_NE(visitor().invitation(), nullptr);
  EXPECT_FALSE(picture(10.05));
  EXPECT_TRUE(picture(10.13)) << "its second world";
  window_.keys = {DisplayKey::large_text};
  EXPECT_TRUE(picture(10.15)) << "the kiosk's own world";
  EXPECT_EQ(visitor().invitation(), nullptr);
  EXPECT_FALSE(picture(10.2));
}

TEST_F(VisitorTest, EachInvitationIsFromItsBeginning) {
  open_invitation({0, 5'000, 60'000});
  const auto seen_at = [this](double s) {
    picture(s);
    return visitor().invitation() != nullptr ? visitor().invitation()->build(at(s), "en", {}).time_s : -1;
  };
  picture(0);
  EXPECT_EQ(seen_at(10), 0);
  EXPECT_EQ(seen_at(16), 5);
  window_.keys = {DisplayKey::large_text};
  picture(17);
  EXPECT_EQ(seen_at(27), 0);
}

TEST_F(VisitorTest, WhoMovesThePointerIsThere) {
  open_invitation();
  picture(0);
  mouse(PointerEvent::Kind::move, bucket());
  picture(9);
  EXPECT_FALSE(picture(18));
  EXPECT_TRUE(picture(19));
}

TEST_F(VisitorTest, AnyTouchEndsAnInvitationAndDoesNothingElse) {
  open_invitation();
  double s = 0;
  picture(s);
  (void)sent();
  const auto ends = [&](const auto& touch) {
    picture(s += 11);
    EXPECT_NE(visitor().invitation(), nullptr);
    touch();
    const bool replaced = picture(s += 0.016);
    EXPECT_EQ(visitor().invitation() == nullptr, replaced);
    EXPECT_FALSE(visitor().drags());
    return replaced;
  };
  EXPECT_TRUE(ends([&] { window_.keys = {DisplayKey::high_contrast}; }));
  EXPECT_TRUE(ends([&] { window_.clicks = {bucket()}; }));
  EXPECT_TRUE(ends([&] { mouse(PointerEvent::Kind::move, bucket()); }));
  EXPECT_TRUE(ends([&] { mouse(PointerEvent::Kind::press, bucket()); }));
  EXPECT_TRUE(ends([&] { client_->between->hands[0].X_WS[0].p.x() += 0.1; }));
  EXPECT_TRUE(ends([&] { settings_.attract = false; }));
  settings_.attract = true;
  EXPECT_FALSE(ends([&] { window_.events = {{PointerEvent::Kind::gone}}; })) << "a window that loses the focus";
  EXPECT_THAT(sent(), IsEmpty());
}

TEST_F(VisitorTest, WhatIsLetGoDuringAnInvitationIsLetGo) {
  open_invitation();
  picture(0);
  mouse(PointerEvent::Kind::press, bucket());
  picture(1);
  ASSERT_TRUE(visitor().drags());
  picture(20);  // a mouse that holds still
  ASSERT_NE(visitor().invitation(), nullptr);
  mouse(PointerEvent::Kind::release, bucket());
  picture(21);
  EXPECT_FALSE(visitor().drags());
  EXPECT_EQ(visitor().invitation(), nullptr);
}

TEST_F(VisitorTest, WithoutARecordedVisitNobodyIsInvited) {
  picture(0);
  EXPECT_FALSE(picture(100));
  EXPECT_EQ(visitor().invitation(), nullptr);
}

TEST_F(VisitorTest, SettingsFromAfarAreApplied) {
  client_->status->done = true;
  client_->server.emplace().scenarios = {"village"};
  picture(0);
  (void)sent();
  client::DisplaySettings requested;
  requested.language = "el";
  requested.high_contrast = true;
  requested.ask = "none";
  requested.home_after_s = 30;
  visitor().change(visit::panel_settings(requested));
  picture(5);
  EXPECT_EQ(visitor().language(), "el") << "nobody is there";
  EXPECT_TRUE(visitor().style().high_contrast);
  const picture::OverlayContent words = written(5).overlay;
  EXPECT_TRUE(words.style.high_contrast);
  EXPECT_FALSE(words.panel) << "no questions";
  picture(30);
  picture(31);
  EXPECT_THAT(sent(), ElementsAre("language el", "open "));
}

TEST_F(VisitorTest, ALanguageFromAfarWaitsForTheVisitorToGo) {
  window_.keys = {DisplayKey::large_text};
  picture(0);
  client::DisplaySettings requested;
  requested.language = "el";
  visitor().change(visit::panel_settings(requested));
  picture(1);
  EXPECT_EQ(visitor().language(), "en");
  picture(91);
  EXPECT_EQ(visitor().language(), "el");
}

}  // namespace
}  // namespace mechane::display
