#include "client-sdk/display/pointer_input.hpp"

#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "client-sdk/display/pointer_aid.hpp"
#include "client-sdk/display/procedural_mesh.hpp"

namespace mechane::display {
namespace {

constexpr PixelSize kGlass{1280, 720};

/// A thing of 5 cm that can be taken, before a wall that cannot; seen from (0, 0, 3).
struct Shelf {
  RenderScene scene;
  SceneAssets assets;
  std::vector<client::SceneObject> objects{2};
  client::WorldStatus status;
  client::WorldPresentation presentation;

  explicit Shelf(const Vec3& p_W) {
    scene.camera.p_WC = Vec3(0, 0, 3);
    assets.meshes.push_back(box_mesh(Vec3(0.05, 0.05, 0.05)));
    assets.meshes.push_back(box_mesh(Vec3(8, 8, 0.1)));
    objects[1].index = 1;
    objects[1].X_WB.p = p_W;
    objects[1].movable = true;
    for (std::uint32_t i = 0; i < 2; ++i) {
      Instance instance;
      instance.mesh = 1 - i;
      instance.X_WM.translation() = i == 0 ? Vec3f(0, 0, -1) : Vec3f(p_W.cast<float>());
      instance.object = i;
      scene.instances.push_back(instance);
    }
    presentation.ways = {{client::Way::Kind::taken, "HOLD", 1, {}, {}, {}}};
    status.enabled_agents = {"HOLD"};
  }
  [[nodiscard]] PointerScene under() const {
    return {scene, assets, Stereo::mono, kGlass, nullptr, objects, &status, &presentation};
  }
  [[nodiscard]] Sight sight() const { return seen_place(scene.camera, Stereo::mono, kGlass, {1, 1})->sight; }
};

double between(double low, double high) {
  return low + (high - low) * (*rc::gen::inRange(0, 100'000)) / 100'000.0;
}

RC_GTEST_PROP(PointerPick, a_finger_within_its_breadth_of_a_thing_means_it, ()) {
  const Vec3 p_W(between(-1, 1), between(-0.6, 0.6), between(-0.5, 1));
  const Shelf shelf(p_W);
  PixelPlace at = *pixel_of(shelf.sight(), p_W);
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
  const PixelPlace edge = *pixel_of(shelf.sight(), Vec3(0.025, 0, 0.025));
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
  OverlayContent english, greek, busy;
  busy.note = "One moment";
  add_pointer_aid(aid, "en", english);
  add_pointer_aid(aid, "el", greek);
  add_pointer_aid(aid, "en", busy);
  EXPECT_EQ(english.note, "Press and hold to take it");
  EXPECT_NE(greek.note, english.note);
  EXPECT_EQ(busy.note, "One moment");
  EXPECT_FALSE(english.dots.empty());
  for (const OverlayDot& dot : english.dots)
    EXPECT_LT(std::hypot(dot.x - 640, dot.y - 360), 30);
}

TEST(PointerAid, WhatIsCarriedSaysHowItIsTurnedByWhatTheVisitorUses) {
  const Shelf shelf({0, 0, 0});
  PointerAid aid{shelf.sight(), {}, {}, {}, PointerLinkState::joined};
  aid.view.phase = PointerView::Phase::holding;
  std::set<std::string> notes;
  for (const PointerMeans means : {PointerMeans::mouse, PointerMeans::fingers, PointerMeans::keys}) {
    for (const char* language : {"en", "el"}) {
      OverlayContent content;
      aid.means = means;
      add_pointer_aid(aid, language, content);
      notes.insert(content.note);
      OverlayContent with_goal;
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
  OverlayContent resting;
  add_pointer_aid(aid, "en", resting);
  EXPECT_EQ(resting.note, "Space takes it; Tab goes to the next");
  aid.view.phase = PointerView::Phase::holding;
  for (const auto drag : {PointerView::Drag::turn, PointerView::Drag::slide}) {
    aid.view.drag = drag;
    OverlayContent content;
    add_pointer_aid(aid, "en", content);
    EXPECT_EQ(content.note.find("Arrows"), 0U) << content.note;
    EXPECT_NE(content.note.find("Space lets go"), std::string::npos) << content.note;
  }
}

/// Keys are at the thing; what then ends that.
struct AtKeys {
  Shelf shelf{Vec3(0.4, 0.1, 0)};
  PointerInput input{"kiosk-1", 0};
  AtKeys() {
    PointerEvent tab;
    tab.kind = PointerEvent::Kind::key_down;
    tab.key = PointerKey::next;
    input.take(tab, shelf.under(), false);
    input.update(shelf.under(), TimePoint(std::chrono::seconds(1)));
  }
  [[nodiscard]] OverlayContent seen() {
    OverlayContent content;
    input.write(content, shelf.under(), "en");
    return content;
  }
};

TEST(PointerKeys, TabLeadsToWhatCanBeTakenAndSaysHow) {
  AtKeys keys;
  EXPECT_EQ(keys.seen().note, "Space takes it; Tab goes to the next");
  EXPECT_FALSE(keys.seen().dots.empty());
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
  OverlayContent content;
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
  EXPECT_EQ(go_on_button(&status, "en")->action, (OverlayAction{OverlayAction::Kind::activity, "use"}));
  status.activity = "use";
  EXPECT_EQ(go_on_button(&status, "el")->action.value, "assemble");
}

}  // namespace
}  // namespace mechane::display
