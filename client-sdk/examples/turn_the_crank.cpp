// Grasps the handle of Archimedes' screw and goes round with it. Exit status 0 when it was held.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "client-sdk/examples/arguments.hpp"

using namespace mechane;
using namespace std::chrono_literals;

int main(int argc, char** argv) {
  const auto arguments = example::read_arguments(argc, argv, "turn-the-crank", client::Role::hand);
  auto client = client::Client::connect(arguments.config);
  if (!client) return std::fprintf(stderr, "%s\n", client.error().to_string().c_str()), 1;
  if (!(*client)->wait_for(client::LinkState::joined, 10s)) {
    return std::fprintf(stderr, "no world: is a server running? %s\n", (*client)->refusal().c_str()), 1;
  }
  SystemClock clock;
  TimePoint next = clock.now();
  const TimePoint begin = next;
  bool held = false;
  // The handle of the exhibit's moving body INNER, in the body's frame; it goes round the body's z axis.
  const Vec3 p_BGrip(0.25, 0, 1.36);
  std::optional<Pose> X_WB;
  while (next - begin < std::chrono::duration<double>(arguments.seconds)) {
    clock.sleep_until(next += kTickPeriod);
    client::Frame frame;
    const auto objects = (*client)->objects();
    const auto inner = std::find_if(objects.begin(), objects.end(), [](const auto& o) { return o.name == "INNER"; });
    if (inner == objects.end() || !(*client)->newest_frame(frame)) continue;
    for (const auto& body : frame.bodies) {
      if (!X_WB && body.object == inner->index) X_WB = body.X_WB;
    }
    if (!X_WB) continue;
    const double t = std::chrono::duration<double>(next - begin).count();
    const double angle =
        -2.0 * kPi * 0.25 * std::max(0.0, t - 1.5);  // a quarter turn a second, after a second of grasping
    client::HandSample hand;
    hand.X_WH.p = *X_WB * (Eigen::AngleAxisd(angle, Vec3::UnitZ()) * p_BGrip);
    hand.grasp_intent = t > 0.5 ? 1.0 : 0.0;
    (*client)->send(hand);
    if (const auto force = (*client)->newest_force()) held = held || force->holding;
  }
  std::printf(held ? "the crank was held\n" : "the crank was not held\n");
  return held ? 0 : 1;
}
