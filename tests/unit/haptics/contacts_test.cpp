#include "server/haptics/contacts.hpp"

#include <memory>
#include <set>

#include <gtest/gtest.h>

#include "tests/support/crank_world.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/touch.hpp"

namespace mechane::haptics {
namespace {

constexpr BodyId kTable{0}, kArrow{1};
constexpr double kArrowRadius_m = 0.004;

/// A table with its top at 0, an arrow that lies on it, and a flat hand above the arrow that is pushed in so far.
struct HandOnTable {
  explicit HandOnTable(double depth_m, bool with_table = true) {
    state::BodyDescription table, arrow;
    table.fixed = true;
    if (with_table) table.object = test::built(test::box(Vec3(0.4, 0.05, 0.4), Vec3(0, -0.05, 0)));
    arrow.object = test::built(test::cylinder(kArrowRadius_m, 0.3, 12));
    arrow.X_WB.p.y() = kArrowRadius_m;
    world.bodies = {table, arrow};
    state = state::WorldState(world);
    state::UserState& user = state.users[0];
    user.present = true;
    user.sample.kind = hand::HandKind::glove;
    user.X_WH.p = Vec3(-0.05, 0.015 - depth_m, 0);
    hand->place(user.sample, user.X_WH, user.X_WS);
    find_contacts(world, *hand, state);
  }
  [[nodiscard]] std::set<std::uint8_t> segments_at(BodyId body) const {
    std::set<std::uint8_t> segments;
    for (const state::Contact& contact : state.users[0].contact_span())
      if (contact.body == body) segments.insert(contact.segment);
    return segments;
  }

  std::shared_ptr<const HandModel> hand = test::shared_hand();
  state::WorldDescription world;
  state::WorldState state{state::WorldDescription{}};
};

/// As of a hand before a camera, which no table stops.
TEST(FindContacts, AThinThingIsTouchedThroughTheManyPointsOfTheTableUnderIt) {
  const HandOnTable hand(0.02);
  EXPECT_EQ(hand.state.users[0].contact_count, state::kMaxContacts) << "or this tests nothing";
  const auto at_arrow = hand.segments_at(kArrow);
  EXPECT_FALSE(at_arrow.empty());
  EXPECT_EQ(at_arrow, HandOnTable(0.02, false).segments_at(kArrow)) << "as if there were no table";
  EXPECT_GE(hand.segments_at(kTable).size(), 10u);
}

}  // namespace
}  // namespace mechane::haptics
