// Ten gestures of a stylus and of a glove, through the server's contacts and the whole loop of a client: what the device is given, against
// the traces in gestures.txt.
#include <cmath>
#include <functional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "client-sdk/haptic/haptic_loop.hpp"
#include "client-sdk/haptic/simulated_stylus.hpp"
#include "tests/support/floor_server.hpp"
#include "tests/support/golden_rows.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/support/scripted_client.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/solids.hpp"
#include "tests/support/touch.hpp"

namespace mechane {
namespace {

using Object = std::shared_ptr<const collision::Object>;

/// Boards side by side along x, their top at y = 0, from x = -0.1 to 0.1.
Object boards(int count) {
  std::vector<geometry::NamedMesh> parts;
  const double half_m = 0.1 / count;
  for (int i = 0; i < count; ++i)
    parts.push_back(
        {fmt::format("board {}", i), test::box({half_m, 0.01, 0.06}, {-0.1 + half_m * (2 * i + 1), -0.01, 0})});
  return test::built(parts);
}

/// Where the hand wants to be at a moment; between two of them it goes straight.
struct Key {
  double t_s;
  Vec3 p_WH;
  double closed = 0;  ///< see test::close_finger()
};

Key at(const std::vector<Key>& path, double t_s) {
  std::size_t i = 1;
  while (i + 1 < path.size() && path[i].t_s < t_s)
    ++i;
  const Key& from = path[i - 1];
  const Key& to = path[i];
  const double share = std::clamp((t_s - from.t_s) / (to.t_s - from.t_s), 0.0, 1.0);
  return {t_s, from.p_WH + share * (to.p_WH - from.p_WH), from.closed + share * (to.closed - from.closed)};
}

/// A glove that goes where it is told.
class ScriptedGlove final : public haptic::Device {
 public:
  explicit ScriptedGlove(std::vector<std::size_t> fingers) : fingers_(std::move(fingers)) {}
  [[nodiscard]] Expected<void> open() override { return {}; }
  void close() noexcept override {}
  [[nodiscard]] client::HandSample read(Duration dt) noexcept override {
    client::HandSample sample;
    sample.kind = client::HandKind::glove;
    sample.X_WH.p = key_.p_WH;
    sample.V_WH.v = (key_.p_WH - before_) / to_seconds(dt);
    before_ = key_.p_WH;
    for (const std::size_t f : fingers_)
      test::close_finger(sample, f, key_.closed);
    return sample;
  }
  void write(const hand::HandForce& /*force*/) noexcept override {}
  [[nodiscard]] hand::GovernorConfig limits() const override { return {}; }
  void intend(const Key& key) { key_ = key; }

 private:
  std::vector<std::size_t> fingers_;
  Key key_{0, Vec3::Zero()};
  Vec3 before_ = Vec3::Zero();
};

/// What the device was given, 20 times a second.
using Trace = std::vector<hand::HandForce>;

template <class Device, class Intend>
Trace play(const Object& object, const std::vector<Key>& path, Device& device, const Intend& intend) {
  constexpr double kUntouched_s = 1.2;  // the ramp at the start of a visit
  constexpr int kEvery = 50;
  test::FloorServer server(object);
  test::ScriptedClient client;
  const auto loop = haptic::HapticLoop::create(client, device, haptic::RenderMode::local).value();
  TimePoint now{std::chrono::hours(1)};
  Trace trace;
  const int ticks = static_cast<int>(1000 * (kUntouched_s + path.back().t_s));
  for (int tick = 0; tick <= ticks; ++tick) {
    now += kTickPeriod;
    client.answer_with(server.answer(client.hand), now);
    const double t_s = tick * kTickSeconds - kUntouched_s;
    intend(at(path, std::max(t_s, 0.0)));
    loop->tick(now, kTickPeriod);
    if (t_s >= 0 && tick % kEvery == 0) trace.push_back(loop->rendered());
  }
  return trace;
}

Trace by_stylus(const Object& object, const std::vector<Key>& path) {
  haptic::SimulatedStylus stylus({.hand = haptic::ArmConfig{}}, path.front().p_WH);
  return play(object, path, stylus, [&](const Key& key) { stylus.intend(key.p_WH); });
}

Trace by_glove(const Object& object, const std::vector<Key>& path, std::vector<std::size_t> fingers = {0, 1, 2, 3, 4}) {
  ScriptedGlove glove(std::move(fingers));
  return play(object, path, glove, [&](const Key& key) { glove.intend(key); });
}

struct Gesture {
  const char* name;
  std::function<Trace()> play;
};

/// The stylus has a tip of 8 mm. A flat hand's palm is 14 mm thick to each side.
std::vector<Gesture> gestures() {
  const Object board = boards(1);
  const Object bar = test::built(test::cylinder(0.018, 0.08, 32));
  const Object globe = test::built(test::ball(0.05, 24));
  const Object groove =
      test::built(std::vector<geometry::NamedMesh>{{"floor", test::box({0.1, 0.01, 0.06}, {0, -0.01, 0})},
                                                   {"wall", test::box({0.01, 0.05, 0.06}, {0.11, 0.03, 0})}});
  const auto stylus = [](const Object& object, std::vector<Key> path) {
    return [=] { return by_stylus(object, path); };
  };
  const auto glove = [](const Object& object, std::vector<Key> path,
                        std::vector<std::size_t> fingers = {0, 1, 2, 3, 4}) {
    return [=] { return by_glove(object, path, fingers); };
  };
  return {
      {"stylus.press",
       stylus(board, {{0, {0, 0.02, 0}}, {0.5, {0, 0.002, 0}}, {1, {0, 0.002, 0}}, {1.5, {0, 0.02, 0}}})},
      {"stylus.tap",
       stylus(board, {{0, {0, 0.03, 0}}, {0.1, {0, -0.01, 0}}, {0.2, {0, 0.03, 0}}, {0.5, {0, 0.03, 0}}})},
      {"stylus.stroke", stylus(board, {{0, {-0.05, 0.02, 0}},
                                       {0.3, {-0.05, 0.004, 0}},
                                       {0.9, {0.05, 0.004, 0}},
                                       {1.5, {-0.05, 0.004, 0}},
                                       {1.8, {-0.05, 0.02, 0}}})},
      {"stylus.over_an_edge",
       stylus(board, {{0, {0.06, 0.02, 0}}, {0.3, {0.06, 0.004, 0}}, {1.2, {0.12, 0.004, 0}}, {1.5, {0.12, 0.02, 0}}})},
      {"stylus.over_a_ball",
       stylus(globe,
              {{0, {-0.05, 0.07, 0}}, {0.3, {-0.03, 0.045, 0}}, {1.2, {0.03, 0.045, 0}}, {1.5, {0.05, 0.07, 0}}})},
      {"stylus.into_a_corner", stylus(groove, {{0, {0.05, 0.03, 0}},
                                               {0.3, {0.05, 0.004, 0}},
                                               {0.9, {0.1, 0.004, 0}},
                                               {1.2, {0.1, 0.004, 0}},
                                               {1.5, {0.05, 0.03, 0}}})},
      {"glove.lays_its_palm_down",
       glove(board,
             {{0, {-0.05, 0.04, 0}}, {0.5, {-0.05, 0.012, 0}}, {1, {-0.05, 0.012, 0}}, {1.5, {-0.05, 0.04, 0}}})},
      {"glove.strokes",
       glove(board,
             {{0, {-0.2, 0.03, 0}}, {0.3, {-0.2, 0.0065, 0}}, {1.2, {-0.14, 0.0065, 0}}, {1.5, {-0.14, 0.03, 0}}})},
      {"glove.closes_on_a_bar", glove(bar, {{0, {-0.1, 0.045, 0}, 0},
                                            {0.3, {-0.1, 0.036, 0}, 0},
                                            {0.9, {-0.1, 0.036, 0}, 1},
                                            {1.2, {-0.1, 0.036, 0}, 1},
                                            {1.5, {-0.1, 0.06, 0}, 0}})},
      {"glove.pinches_a_bar", glove(bar,
                                    {{0, {-0.1, 0.045, 0}, 0},
                                     {0.3, {-0.1, 0.036, 0}, 0},
                                     {0.9, {-0.1, 0.036, 0}, 1},
                                     {1.5, {-0.1, 0.06, 0}, 0}},
                                    {0, 1})},
  };
}

/// "NAME MS  FX FY FZ  THUMB .. LITTLE", newtons.
std::vector<std::string> rows(const std::string& name, const Trace& trace) {
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const Vec3& f = trace[i].force_W.f;
    rows.push_back(fmt::format("{} {} {:.3f} {:.3f} {:.3f} {:.3f}", name, 50 * i, f.x(), f.y(), f.z(),
                               fmt::join(trace[i].finger_force_n, " ")));
  }
  return rows;
}

double most_apart_n(const Trace& a, const Trace& b) {
  double apart_n = a.size() == b.size() ? 0 : 1e9;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    apart_n = std::max(apart_n, (a[i].force_W.f - b[i].force_W.f).norm());
  return apart_n;
}

TEST(Gestures, GiveTheForcesThatWereAccepted) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("25000 ticks");
  constexpr double kSame_n = 2e-3;
  std::vector<std::string> played;
  for (const Gesture& gesture : gestures()) {
    const Trace trace = gesture.play();
    const auto most =
        std::ranges::max_element(trace, {}, [](const hand::HandForce& force) { return force.force_W.f.norm(); });
    EXPECT_GT(most->force_W.f.norm(), 0.2) << gesture.name << " must feel something";
    EXPECT_LE(most->force_W.f.norm(), hand::GovernorConfig{}.max_force_n * (1 + 1e-9)) << gesture.name;
    EXPECT_LT(trace.back().force_W.f.norm(), 1e-3) << gesture.name << " ends in free air";
    std::ranges::copy(rows(gesture.name, trace), std::back_inserter(played));
  }
  test::expect_accepted("gestures.txt", played, kSame_n);
}

/// Eight boards are felt as one is. People notice differences of force from about a tenth on.
TEST(Gestures, SeamsOfPartsAreNotFelt) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("8000 ticks");
  const Object one = boards(1), eight = boards(8);
  const auto expect_the_same = [](const Trace& on_one, const Trace& on_eight) {
    const double force_n = on_one.back().force_W.f.norm();
    EXPECT_GT(force_n, 0.5);
    EXPECT_LT(most_apart_n(on_one, on_eight), 0.1 * force_n);
  };
  const std::vector<Key> stylus{{0, {-0.06, 0.02, 0}}, {0.3, {-0.06, 0.004, 0}}, {1, {0.06, 0.004, 0}}};
  expect_the_same(by_stylus(one, stylus), by_stylus(eight, stylus));
  const std::vector<Key> fingers{{0, {-0.2, 0.03, 0}}, {0.3, {-0.2, 0.0075, 0}}, {1, {-0.14, 0.0075, 0}}};
  expect_the_same(by_glove(one, fingers), by_glove(eight, fingers));
}

}  // namespace
}  // namespace mechane
