// The village: its visits lead to a machine's step, each sign to its own machine; nothing but a finger on a sign leads anywhere.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "server/content/imported_scene.hpp"
#include "server/content/mesh_import.hpp"
#include "tests/support/exhibit_play.hpp"

namespace mechane {
namespace {

using state::VisitMove;

struct Sign {
  const char* name;
  const char* opens;
};

constexpr Sign kSigns[] = {
    {"SCREW", "archimedes-screw"}, {"CATAPULT", "catapult"},    {"COMPOUND_CRANE", "compound-pulley-crane"},
    {"CRANE", "pulley-crane"},     {"SPHERE", "aiolos-sphere"}, {"CROSSBOW", "crossbow"},
    {"ODOMETER", "odometer"},      {"PUMP", "ktesibios-pump"}};
constexpr double kFace_m = 0.010;    // of a board, before its middle
const Vec3 kMiddle_B(0, -0.106, 0);  // of a board, below its bar

void PrintTo(const Sign& sign, std::ostream* out) {
  *out << sign.name;
}

const test::Exhibit& village() {
  static const test::Exhibit kExhibit("village");
  return kExhibit;
}

std::string step_of(const Sign& sign) {
  return std::string("to-") + sign.opens;
}

BodyId body_of(const Sign& sign) {
  return village().description().find_body(std::string("SIGN_") + sign.name);
}

/// Where a board's middle is at the start, in W.
Vec3 middle_of(const Sign& sign) {
  return village().description().bodies[body_of(sign).index()].X_WB * kMiddle_B;
}

std::filesystem::path model_file() {
  return std::filesystem::path(village().description().folder) / "../models/village.glb";
}

VisitMove reach(BodyId body, const Vec3& p_BG, double duration_s) {
  VisitMove move;
  move.kind = VisitMove::Kind::reach;
  move.body = body;
  move.p_BG = p_BG;
  move.duration_s = duration_s;
  return move;
}

VisitMove reach(const Vec3& p_W, double duration_s) {
  return reach(village().description().find_body("STAND"), p_W, duration_s);  // whose frame is the world's
}

VisitMove wait(double duration_s) {
  VisitMove move;
  move.duration_s = duration_s;
  return move;
}

/// Plays these moves in place of those of 'pointing'.
test::PlayedVisit play(std::vector<VisitMove> moves, test::PlayOptions options = {}) {
  options.change = [moves = std::move(moves), before = options.change](state::WorldDescription& world) {
    std::ranges::find(world.visits, "pointing", &state::VisitDescription::name)->moves = moves;
    if (before) before(world);
  };
  return village().play("pointing", options);
}

std::vector<VisitMove> finger_on(const Sign& sign) {
  return {reach(middle_of(sign) + Vec3(0, 0, 0.25), 1.5), reach(body_of(sign), kMiddle_B + Vec3(0, 0, kFace_m), 0.6),
          wait(1)};
}

void expect_nothing_chosen(const test::PlayedVisit& visit) {
  EXPECT_EQ(visit.stopped_at, "choose") << visit;
  EXPECT_EQ(visit.steps.size(), 1u) << visit;
}

std::vector<std::string> names_of(const std::vector<test::PlayedStep>& steps) {
  std::vector<std::string> names;
  for (const test::PlayedStep& step : steps)
    names.push_back(step.name);
  return names;
}

TEST(VillageVisits, TheIndexOfAWholeHandDoesToo) {
  const test::PlayedVisit visit = village().play_with_glove("pointing");
  ASSERT_GE(visit.steps.size(), 2u) << visit;
  EXPECT_EQ(visit.steps[1].name, "to-archimedes-screw") << visit;
}

TEST(VillageVisits, AFingerOnASignLeadsToItsMachineAndWhoIsNotSentOnIsBackAtTheSigns) {
  double farthest_deg = 0, at_last_deg = 0, swung_until_s = 0;
  test::PlayOptions options;
  options.patience_s = 8;
  options.watch = [&](const state::WorldState& state) {
    at_last_deg = village().value(state, "swing_screw");
    farthest_deg = std::max(farthest_deg, at_last_deg);
    if (std::abs(at_last_deg) > 1) swung_until_s = static_cast<double>(state.tick) * kTickSeconds;
  };
  const test::PlayedVisit visit = village().play("pointing", options);
  const std::vector<std::string> wanted{"choose", "to-archimedes-screw", "choose"};
  EXPECT_EQ(names_of(visit.steps), wanted) << visit;
  EXPECT_TRUE(std::ranges::all_of(visit.moves, &visitor::MoveResult::ok)) << visit;
  ASSERT_GE(visit.steps.size(), 2u);
  EXPECT_LT(visit.steps[0].seconds, 4) << visit;
  EXPECT_NEAR(visit.steps[1].seconds, 6, 0.1) << visit;
  EXPECT_GT(farthest_deg, 2) << "the sign gives way under the finger";
  EXPECT_LT(farthest_deg, 21) << "and not further than its stop";
  EXPECT_LT(swung_until_s, 3.7 + 2.5) << "it hangs straight again soon after the finger has gone";
  EXPECT_EQ(village().play("pointing", options).state_hash, visit.state_hash);
}

TEST(VillageVisits, BetweenSignsTooQuicklyOnTheWallAndAWalkStillEndWell) {
  const test::PlayedVisit visit = village().play("mistakes-choose");
  ASSERT_GE(visit.steps.size(), 2u) << visit;
  EXPECT_EQ(visit.steps[1].name, "to-odometer") << visit;
  EXPECT_GT(visit.steps[0].seconds, 18) << "none of what came before has chosen\n" << visit;
  EXPECT_TRUE(std::ranges::all_of(visit.moves, &visitor::MoveResult::ok)) << visit;
  EXPECT_EQ(village().play("mistakes-choose").state_hash, visit.state_hash);
}

class EachSign : public testing::TestWithParam<Sign> {};

TEST_P(EachSign, LeadsToItsOwnStep) {
  const test::PlayedVisit visit = play(finger_on(GetParam()));
  ASSERT_GE(visit.steps.size(), 2u) << visit;
  EXPECT_EQ(visit.steps[1].name, step_of(GetParam())) << visit;
  const state::WorldDescription& world = village().description();
  const StepId step = world.find_step(step_of(GetParam()));
  ASSERT_TRUE(step);
  EXPECT_EQ(world.steps[step.index()].opens, GetParam().opens);
  const std::filesystem::path scenarios = std::filesystem::path(world.folder) / "..";
  EXPECT_TRUE(std::filesystem::exists(scenarios / GetParam().opens / (std::string(GetParam().opens) + ".x3d")));
}

/// The first words of this key in an exhibit's file: those of its title, which stands before all others.
std::string words_of(const std::string& exhibit, const std::string& key) {
  std::ifstream in(std::filesystem::path(village().description().folder) / ".." / exhibit / (exhibit + ".x3d"));
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string before = "name='" + key + "' value='\"";
  const std::size_t from = text.find(before) + before.size();
  return text.substr(from, text.find("\"'", from) - from);
}

TEST_P(EachSign, IsCalledAsTheExhibitThatItOpens) {
  const state::Texts& title = village().description().bodies[body_of(GetParam()).index()].title;
  EXPECT_EQ(title, (state::Texts{{"el", words_of(GetParam().opens, "title.el")},
                                 {"en", words_of(GetParam().opens, "title.en")}}));
  EXPECT_FALSE(title.at("en").empty());
}

TEST_P(EachSign, IsChosenOnMostOfItsBoardAndNotBesideIt) {
  const auto stopped_at = [](const Vec3& beside) {
    const Vec3 face_B = kMiddle_B + beside + Vec3(0, 0, kFace_m);
    return play({reach(middle_of(GetParam()) + beside + Vec3(0, 0, 0.25), 1.5), reach(body_of(GetParam()), face_B, 0.6),
                 wait(1)})
        .stopped_at;
  };
  for (const Vec3& beside : {Vec3(0.05, 0, 0), Vec3(-0.05, 0, 0), Vec3(0, 0.05, 0), Vec3(0, -0.05, 0)}) {
    EXPECT_EQ(stopped_at(beside), step_of(GetParam())) << beside.transpose();
    EXPECT_EQ(stopped_at(2 * beside), "choose") << 2 * beside.transpose();
  }
}

TEST_P(EachSign, ThatIsTakenAwayOrIsNotAskedLeadsNowhere) {
  const std::string name = GetParam().name;
  test::PlayOptions options;
  options.change = [&](state::WorldDescription& world) { test::take_away(world, "SIGN_" + name); };
  // The hand goes where the sign was.
  const Vec3 middle_W = middle_of(GetParam());
  expect_nothing_chosen(
      play({reach(middle_W + Vec3(0, 0, 0.25), 1.5), reach(middle_W + Vec3(0, 0, kFace_m), 0.6), wait(1)}, options));
  options.change = [&](state::WorldDescription& world) { test::switch_off(world, "POINT_" + name); };
  expect_nothing_chosen(play(finger_on(GetParam()), options));
}

TEST_P(EachSign, IsNotChosenByAPalm) {
  // A right hand upright, its palm to the sign: x up, y to the visitor.
  test::PlayOptions options;
  Mat3 R_WH;
  R_WH << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  options.device.hand = client::HandKind::glove;
  options.player.shapes_hand = false;  // the test does
  options.player.X_WH_rest.R = Quat(R_WH);
  double farthest_deg = 0;
  std::string swing = std::string("swing_") + GetParam().name;
  std::ranges::transform(swing, swing.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  options.watch = [&](const state::WorldState& state) {
    farthest_deg = std::max(farthest_deg, village().value(state, swing));
  };
  const Vec3 wrist_W = middle_of(GetParam()) + Vec3(0, -0.05, 0);  // the palm's middle is 5 cm before the wrist
  expect_nothing_chosen(play({reach(wrist_W + Vec3(0, 0, 0.3), 1.5), reach(wrist_W, 0.8), wait(1.5)}, options));
  EXPECT_GT(farthest_deg, 2) << "it did touch the sign";
}

TEST_P(EachSign, IsChosenByTheIndexOfAGlove) {
  // A flat right hand, its fingers to the sign, its back up: x away from the visitor.
  test::PlayOptions options;
  Mat3 R_WH;
  R_WH << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  options.device.hand = client::HandKind::glove;
  options.player.shapes_hand = false;  // the test does
  options.player.X_WH_rest.R = Quat(R_WH);
  const Vec3 wrist_W = middle_of(GetParam()) + Vec3(0.031, 0, 0.2);  // the index is 31 mm to the left of the wrist
  const test::PlayedVisit visit = play({reach(wrist_W + Vec3(0, 0, 0.2), 1.5), reach(wrist_W, 0.8), wait(1)}, options);
  ASSERT_GE(visit.steps.size(), 2u) << visit;
  EXPECT_EQ(visit.steps[1].name, step_of(GetParam())) << visit;
}

INSTANTIATE_TEST_SUITE_P(Village, EachSign, testing::ValuesIn(kSigns),
                         [](const auto& sign) { return std::string(sign.param.name); });

TEST(VillageSigns, AFingerBetweenTwoChoosesNothing) {
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 3; ++column) {
      const Vec3 between_W = 0.5 * (middle_of(kSigns[4 * row + column]) + middle_of(kSigns[4 * row + column + 1]));
      // At the boards' faces, and poked through between them.
      expect_nothing_chosen(play({reach(between_W + Vec3(0, 0, 0.2), 1.5), reach(between_W + Vec3(0, 0, 0.015), 0.5),
                                  wait(0.6), reach(between_W - Vec3(0, 0, 0.05), 0.5), wait(0.6)}));
    }
  }
  for (int column = 0; column < 4; ++column) {
    const Vec3 between_W = 0.5 * (middle_of(kSigns[column]) + middle_of(kSigns[4 + column]));
    expect_nothing_chosen(play({reach(between_W + Vec3(0, 0, 0.3), 1.5), reach(between_W, 0.6), wait(0.8)}));
  }
}

TEST(VillageSigns, AQuickBrushChoosesNothing) {
  for (const Sign& sign : {kSigns[0], kSigns[4]}) {
    const Vec3 row_W(0, middle_of(sign).y(), middle_of(sign).z() + kFace_m + 0.006);
    expect_nothing_chosen(play({reach(row_W + Vec3(-0.55, 0, 0.1), 1.5), reach(row_W + Vec3(-0.55, 0, 0), 0.4),
                                reach(row_W + Vec3(0.55, 0, 0), 0.8), reach(row_W + Vec3(0.55, 0, 0.2), 0.4)}));
  }
}

TEST(VillageSigns, AreLargeEnoughForAFingerAndApartEnoughForTwo) {
  const auto scene = content::import_mesh(model_file());
  ASSERT_TRUE(scene) << scene.error().to_string();
  std::vector<Eigen::AlignedBox3d> boxes_W;
  for (const Sign& sign : kSigns) {
    const auto parts = content::collision_parts(*scene, std::string("SIGN_") + sign.name);
    ASSERT_TRUE(parts) << parts.error().to_string();
    Eigen::AlignedBox3d box_W;
    for (const auto& part : *parts) {
      for (const Vec3& p_B : part.mesh.vertices)
        box_W.extend(village().description().bodies[body_of(sign).index()].X_WB * p_B);
    }
    EXPECT_GE(box_W.sizes().x(), 0.12) << sign.name;
    EXPECT_GE(box_W.sizes().y(), 0.12) << sign.name;
    // A hand reaches it where the others' workspace is.
    EXPECT_LE(std::abs(box_W.center().x()), 0.45) << sign.name;
    EXPECT_GE(box_W.min().y(), 0.8) << sign.name;
    EXPECT_LE(box_W.max().y(), 1.35) << sign.name;
    EXPECT_GE(box_W.min().z(), 0.0) << sign.name;
    EXPECT_LE(box_W.max().z(), 0.5) << sign.name;
    for (std::size_t other = 0; other < boxes_W.size(); ++other)
      EXPECT_GE(box_W.exteriorDistance(boxes_W[other]), 0.04) << sign.name << " and " << kSigns[other].name;
    boxes_W.push_back(box_W);
  }
}

TEST(VillageSigns, TheModelIsSmallEnoughToBeTheFirstThingSeen) {
  EXPECT_LT(std::filesystem::file_size(model_file()), 5'000'000u);
}

}  // namespace
}  // namespace mechane
