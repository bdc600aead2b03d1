#include "client-sdk/pointer/pointer_input.hpp"

#include <set>
#include <tuple>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "client-sdk/picture/procedural_mesh.hpp"
#include "client-sdk/pointer/pointer_aid.hpp"

namespace mechane::pointer {
namespace {

constexpr picture::PixelSize kGlass{1280, 720};

/// A thing of 5 cm that can be taken, before a wall that cannot; seen from (0, 0, 3).
struct Shelf {
  picture::RenderScene scene;
  picture::SceneAssets assets;
  std::vector<client::SceneObject> objects{2};
  client::WorldStatus status;
  client::WorldPresentation presentation;

  explicit Shelf(const Vec3& p_W) {
    scene.camera.p_WC = Vec3(0, 0, 3);
    assets.meshes.push_back(picture::box_mesh(Vec3(0.05, 0.05, 0.05)));
    assets.meshes.push_back(picture::box_mesh(Vec3(8, 8, 0.1)));
    objects[1].index = 1;
    objects[1].X_WB.p = p_W;
    objects[1].movable = true;
    for (std::uint32_t i = 0; i < 2; ++i) {
      picture::Instance instance;
      instance.mesh = 1 - i;
      instance.X_WM.translation() = i == 0 ? Vec3f(0, 0, -1) : Vec3f(p_W.cast<float>());
      instance.object = i;
      scene.instances.push_back(instance);
    }
    presentation.affordances = {{client::Affordance::Kind::taken, "HOLD", 1, {}, {}, {}}};
    status.enabled_agents = {"HOLD"};
  }
  [[nodiscard]] PointerScene under() const {
    return {scene, assets, picture::Stereo::mono, kGlass, nullptr, objects, &status, &presentation};
  }
  [[nodiscard]] picture::Sight sight() const {
    return picture::seen_place(scene.camera, picture::Stereo::mono, kGlass, {1, 1})->sight;
  }
};

double between(double low, double high) {
  return low + (high - low) * (*rc::gen::inRange(0, 100'000)) / 100'000.0;
}

RC_GTEST_PROP(PointerPick, a_finger_within_its_breadth_of_a_thing_means_it, ()) {
  const Vec3 p_W(between(-1, 1), between(-0.6, 0.6), between(-0.5, 1));
  const Shelf shelf(p_W);
  picture::PixelPlace at = *pixel_of(shelf.sight(), p_W);
  const double angle = between(0, 2 * kPi);
  // The thing is at least 12 pixels wide to each side of its middle; a fingertip is 17.
  at.x += 18 * std::cos(angle);
  at.y += 18 * std::sin(angle);
  const auto touched = under_finger(shelf.under(), shelf.sight(), at).takeable;
  RC_ASSERT(touched.has_value());
  RC_ASSERT(touched->object == 1U);
  RC_ASSERT((touched->p_WT - p_W).norm() < 0.1);
}

TEST(PointerPick, WhatNoStepLetsOneTakeIsNotTaken) {
  Shelf shelf({0, 0, 0});
  EXPECT_TRUE(under_finger(shelf.under(), shelf.sight(), {640, 360}).takeable);
  EXPECT_FALSE(under_finger(shelf.under(), shelf.sight(), {240, 360}).takeable) << "the wall";
  shelf.status.enabled_agents.clear();
  EXPECT_FALSE(under_finger(shelf.under(), shelf.sight(), {640, 360}).takeable);
}

TEST(PointerPick, WhatCannotBeTakenIsSeenAllTheSame) {
  const Shelf shelf({0, 0, 0});
  EXPECT_EQ(under_finger(shelf.under(), shelf.sight(), {640, 360}).seen->object, 1U);
  EXPECT_EQ(under_finger(shelf.under(), shelf.sight(), {240, 360}).seen->object, 0U) << "the wall";
}

TEST(PointerInput, PointsAtWhatItWouldTakeOrIsOn) {
  const Shelf shelf({0, 0, 0});
  PointerInput input("kiosk-1", 0);
  TimePoint now{std::chrono::seconds(10)};
  EXPECT_FALSE(input.pointed_at());
  const auto hover = [&](double x) {
    PointerEvent event;
    event.kind = PointerEvent::Kind::move;
    event.finger = kMouse;
    event.x = x;
    event.y = 360;
    input.take(event, shelf.under(), false);
    input.update(shelf.under(), now += std::chrono::seconds(1));
    return input.pointed_at()->object;
  };
  EXPECT_EQ(hover(240), 0U);
  EXPECT_EQ(hover(640), 1U);
  const picture::PixelPlace edge = *pixel_of(shelf.sight(), Vec3(0.025, 0, 0.025));
  EXPECT_EQ(hover(edge.x + 8), 1U) << "a fingertip beside it, before the wall";
  PointerEvent left;
  left.kind = PointerEvent::Kind::left;
  input.take(left, shelf.under(), false);
  EXPECT_FALSE(input.pointed_at());
}

TEST(PointerPick, WhatIsHiddenIsNotTaken) {
  Shelf shelf({0, 0, -2});
  EXPECT_FALSE(under_finger(shelf.under(), shelf.sight(), {640, 360}).takeable);
  EXPECT_TRUE(places_to_take(shelf.under(), shelf.sight()).empty());
}

TEST(PointerPick, KeysFindAPlaceToTakeEachThingBy) {
  const Shelf shelf({0.4, 0.1, 0});
  const auto places = places_to_take(shelf.under(), shelf.sight());
  ASSERT_EQ(places.size(), 1U);
  EXPECT_TRUE(under_finger(shelf.under(), shelf.sight(), places[0]).takeable);
}

TEST(PointerAid, WordsAreInTheVisitorsLanguageAndNotOverAnothersNote) {
  const Shelf shelf({0, 0, 0});
  PointerAid aid{shelf.sight(), {}, Vec3(0, 0, 0.025), {}, PointerLinkState::none};
  picture::OverlayContent english, greek, busy;
  busy.note = "One moment";
  add_pointer_aid(aid, "en", english);
  add_pointer_aid(aid, "el", greek);
  add_pointer_aid(aid, "en", busy);
  EXPECT_EQ(english.note, "Press and hold to take it");
  EXPECT_NE(greek.note, english.note);
  EXPECT_EQ(busy.note, "One moment");
  EXPECT_FALSE(english.dots.empty());
  for (const picture::OverlayDot& dot : english.dots)
    EXPECT_LT(std::hypot(dot.x - 640, dot.y - 360), 30);
}

TEST(PointerAid, WhatIsCarriedSaysHowItIsTurnedByWhatTheVisitorUses) {
  const Shelf shelf({0, 0, 0});
  PointerAid aid{shelf.sight(), {}, {}, {}, PointerLinkState::joined};
  aid.view.phase = PointerView::Phase::holding;
  std::set<std::string> notes;
  for (const PointerMeans means : {PointerMeans::mouse, PointerMeans::fingers, PointerMeans::keys}) {
    for (const char* language : {"en", "el"}) {
      picture::OverlayContent content;
      aid.means = means;
      add_pointer_aid(aid, language, content);
      notes.insert(content.note);
      picture::OverlayContent with_goal;
      aid.view.p_WG = Vec3::Zero();
      add_pointer_aid(aid, language, with_goal);
      aid.view.p_WG.reset();
      notes.insert(with_goal.note);
    }
  }
  EXPECT_EQ(notes.size(), 12U);
  EXPECT_TRUE(notes.contains("Drag to carry it; two fingers turn it, bring it nearer or farther"));
}

TEST(PointerAid, WhoUsesKeysIsToldOfKeys) {
  const Shelf shelf({0, 0, 0});
  PointerAid aid{shelf.sight(), {}, Vec3(0, 0, 0.025), {}, PointerLinkState::joined, PointerMeans::keys};
  picture::OverlayContent resting;
  add_pointer_aid(aid, "en", resting);
  EXPECT_EQ(resting.note, "Space takes it; Tab goes to the next");
  aid.view.phase = PointerView::Phase::holding;
  for (const auto drag : {PointerView::Drag::turn, PointerView::Drag::slide}) {
    aid.view.drag = drag;
    picture::OverlayContent content;
    add_pointer_aid(aid, "en", content);
    EXPECT_EQ(content.note.find("Arrows"), 0U) << content.note;
    EXPECT_NE(content.note.find("Space lets go"), std::string::npos) << content.note;
  }
}

/// A hand without a server, and the thing that it takes, which goes along wherever its leeway lets it.
class HandNearby final : public PointerTouch {
 public:
  PointerSenses senses;
  double turned_rad = 0;  // about the axle, where there is one

  void press(const picture::Sight& sight, picture::PixelPlace place, const picture::Touched& touched) override {
    hand_.press(sight, place, touched);
  }
  void move(picture::PixelPlace place) override { hand_.move(place); }
  void deepen(double notches) override { hand_.deepen(notches); }
  void turn(double angle_rad) override { hand_.turn(angle_rad); }
  void release() override { hand_.release(); }
  [[nodiscard]] PointerView view() override { return hand_.view(); }
  [[nodiscard]] PointerLinkState state() override { return PointerLinkState::joined; }

  void pass(double seconds) {
    constexpr double kStep_s = 0.002;
    for (int k = 0; k < static_cast<int>(std::lround(seconds / kStep_s)); ++k) {
      const auto input = hand_.advance(kStep_s, senses);
      if (input) follow(*input);
    }
  }

 private:
  void follow(const client::HandSample& input) {
    const bool held = std::exchange(senses.holding, input.grasp_intent > 0.5);
    const Pose X_before = std::exchange(X_WH_, input.X_WH);
    if (!held || !senses.holding) return;
    if (!senses.leeway.axle) {
      senses.X_WB = X_WH_ * X_before.inverse() * senses.X_WB;
      return;
    }
    const auto& [p_W, a_W] = *senses.leeway.axle;
    const Vec3 from = X_before.p - p_W, to = X_WH_.p - p_W;
    const double angle = std::atan2(from.cross(to).dot(a_W), from.dot(to) - from.dot(a_W) * to.dot(a_W));
    const Quat turn(Eigen::AngleAxisd(angle, a_W));
    senses.X_WB = {p_W + turn * (senses.X_WB.p - p_W), turn * senses.X_WB.R};
    turned_rad += angle;
  }

  PointerHand hand_;
  Pose X_WH_;
};

/// Keys are at the thing; what they then do, and what ends that.
struct AtKeys {
  Shelf shelf{Vec3(0.4, 0.1, 0)};
  HandNearby* hand = nullptr;
  PointerInput input;
  TimePoint now{std::chrono::seconds(1)};

  AtKeys() : AtKeys(std::make_unique<HandNearby>()) {}
  explicit AtKeys(std::unique_ptr<HandNearby> nearby) : hand(nearby.get()), input(std::move(nearby)) {
    hand->senses.X_WB = shelf.objects[1].X_WB;
    hand->senses.leeway = shelf.under().leeway(1);
    say(PointerEvent::Kind::key_down, PointerKey::next);
    input.update(shelf.under(), now);
  }
  [[nodiscard]] picture::OverlayContent seen() {
    picture::OverlayContent content;
    input.write(content, shelf.under(), "en");
    return content;
  }
  void say(PointerEvent::Kind kind, PointerKey key) {
    PointerEvent event;
    event.kind = kind;
    event.key = key;
    input.take(event, shelf.under(), false);
  }
  /// Twenty-five pictures a second.
  void pass(double seconds) {
    constexpr double kPicture_s = 0.04;
    for (int k = 0; k < static_cast<int>(std::lround(seconds / kPicture_s)); ++k) {
      input.update(shelf.under(), now += std::chrono::milliseconds(40));
      hand->pass(kPicture_s);
    }
  }
  void hold(PointerKey key, double seconds) {
    say(PointerEvent::Kind::key_down, key);
    pass(seconds);
    say(PointerEvent::Kind::key_up, key);
    pass(1);
  }
  void take() {
    hold(PointerKey::take, 1);
    ASSERT_EQ(hand->view().phase, PointerView::Phase::holding);
  }
  /// Where a point of the thing is seen.
  [[nodiscard]] picture::PixelPlace thing_at(const Vec3& p_B = Vec3::Zero()) const {
    return *pixel_of(shelf.sight(), hand->senses.X_WB * p_B);
  }
};

TEST(PointerKeys, TabLeadsToWhatCanBeTakenAndSaysHow) {
  AtKeys keys;
  EXPECT_EQ(keys.seen().note, "Space takes it; Tab goes to the next");
  EXPECT_FALSE(keys.seen().dots.empty());
}

TEST(PointerKeys, SpaceTakesWhatTheyAreAtAndLetsItGo) {
  AtKeys keys;
  EXPECT_TRUE(keys.input.is_away());
  keys.take();
  EXPECT_TRUE(keys.hand->senses.holding);
  EXPECT_LT((keys.hand->view().p_WH - keys.hand->senses.X_WB.p).norm(), 0.1);
  keys.hold(PointerKey::take, 1);
  EXPECT_FALSE(keys.hand->senses.holding);
  EXPECT_TRUE(keys.input.is_away());
}

TEST(PointerKeys, ArrowsCarryWhatTheyHoldWhileTheyAreDown) {
  for (const auto& [key, right, down] : {std::tuple(PointerKey::right, 1, 0), std::tuple(PointerKey::left, -1, 0),
                                         std::tuple(PointerKey::down, 0, 1), std::tuple(PointerKey::up, 0, -1)}) {
    AtKeys keys;
    keys.take();
    const picture::PixelPlace from = keys.thing_at();
    keys.hold(key, 0.4);
    const picture::PixelPlace to = keys.thing_at();
    const double way = 0.4 * 0.3 * kGlass.height;
    EXPECT_NEAR(to.x - from.x, right * way, 8) << static_cast<int>(key);
    EXPECT_NEAR(to.y - from.y, down * way, 8) << static_cast<int>(key);
    keys.pass(1);
    EXPECT_NEAR(std::hypot(keys.thing_at().x - to.x, keys.thing_at().y - to.y), 0, 1) << "no key is down";
  }
}

TEST(PointerKeys, ArrowsTurnACrankAsAClockGoesAndBack) {
  for (const double facing : {1.0, -1.0}) {  // the axle's own sense means nothing to who sees the crank
    for (const auto& [key, clockwise] : {std::pair(PointerKey::right, 1), std::pair(PointerKey::down, 1),
                                         std::pair(PointerKey::left, -1), std::pair(PointerKey::up, -1)}) {
      AtKeys keys;
      keys.hand->senses.leeway.axle = AffordanceLine{{0.4, 0.4, 0}, {0, 0, facing}};
      keys.take();
      keys.hold(key, 0.8);
      EXPECT_NEAR(keys.hand->turned_rad, -facing * clockwise * 0.8 * 2 * kPi / 3, 0.15) << static_cast<int>(key);
    }
  }
}

TEST(PointerKeys, PageUpTakesItFartherAndPageDownNearer) {
  for (const auto& [key, farther] : {std::pair(PointerKey::farther, 1), std::pair(PointerKey::nearer, -1)}) {
    AtKeys keys;
    keys.take();
    const double depth_m = picture::depth_of(keys.shelf.sight(), keys.hand->senses.X_WB.p);
    const picture::PixelPlace from = keys.thing_at();
    keys.hold(key, 0.8);
    EXPECT_NEAR(std::log(picture::depth_of(keys.shelf.sight(), keys.hand->senses.X_WB.p) / depth_m), farther * 0.19,
                0.02);
    EXPECT_NEAR(std::hypot(keys.thing_at().x - from.x, keys.thing_at().y - from.y), 0, 5) << "under the ring";
  }
}

TEST(PointerKeys, QAndETurnWhatTheyHoldAsItIsSeen) {
  for (const auto& [key, clockwise] : {std::pair(PointerKey::turn_right, 1), std::pair(PointerKey::turn_left, -1)}) {
    AtKeys keys;
    keys.take();
    keys.hold(key, 0.4);
    const picture::PixelPlace middle = keys.thing_at(), end = keys.thing_at(Vec3(0.02, 0, 0));
    EXPECT_NEAR(std::atan2(end.y - middle.y, end.x - middle.x), clockwise * 0.4 * 1.2, 0.08);
  }
}

TEST(PointerKeys, ArrowsLeadTheRingWhereNothingIsHeldAndSpaceTakesNothingThere) {
  AtKeys keys;
  const float from = keys.seen().dots.front().x;
  keys.hold(PointerKey::right, 0.8);
  EXPECT_NEAR(keys.seen().dots.front().x - from, 0.8 * 0.3 * kGlass.height, 2);
  keys.hold(PointerKey::take, 1);
  EXPECT_TRUE(keys.input.is_away());
}

TEST(PointerKeys, AnotherWorldOrAMouseThatMovesEndsThem) {
  AtKeys another;
  another.input.forget_world();
  EXPECT_TRUE(another.seen().dots.empty()) << "a ring about nothing";
  AtKeys mouse;
  PointerEvent move;
  move.kind = PointerEvent::Kind::move;
  move.x = 100;
  move.y = 100;
  mouse.input.take(move, mouse.shelf.under(), false);
  mouse.input.update(mouse.shelf.under(), TimePoint(std::chrono::seconds(2)));
  EXPECT_TRUE(mouse.seen().dots.empty());
}

TEST(PointerAid, NobodyTouchesNothingIsDrawn) {
  const Shelf shelf({0, 0, 0});
  picture::OverlayContent content;
  add_pointer_aid({shelf.sight(), {}, {}, {}, PointerLinkState::none}, "en", content);
  EXPECT_TRUE(content.dots.empty());
  EXPECT_TRUE(content.note.empty());
}

TEST(GoOnButton, LeadsToTheNextActivityAndFromTheLastToTheFirst) {
  client::WorldStatus status;
  status.activities = {"assemble", "use"};
  status.activity = "assemble";
  EXPECT_FALSE(go_on_button(&status, "en"));
  EXPECT_FALSE(go_on_button(nullptr, "en"));
  status.done = true;
  EXPECT_EQ(go_on_button(&status, "en")->action,
            (picture::OverlayAction{picture::OverlayAction::Kind::activity, "use"}));
  status.activity = "use";
  EXPECT_EQ(go_on_button(&status, "el")->action.value, "assemble");
}

}  // namespace
}  // namespace mechane::pointer
