// Reaches for the body named CRANK, grasps it and goes round in a circle of 10 cm about z. Exit status 0 when it was held.
#include <algorithm>
#include <cmath>
#include <cstdio>

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
  while (next - begin < std::chrono::duration<double>(arguments.seconds)) {
    clock.sleep_until(next += kTickPeriod);
    client::Frame frame;
    const auto objects = (*client)->objects();
    const auto crank = std::find_if(objects.begin(), objects.end(), [](const auto& o) { return o.name == "CRANK"; });
    if (crank == objects.end() || !(*client)->newest_frame(frame)) continue;
    const double t = std::chrono::duration<double>(next - begin).count();
    const double angle =
        2.0 * kPi * 0.5 * std::max(0.0, t - 1.0);  // half a turn a second, after one second of grasping
    client::HandInput hand;
    hand.X_WH.p = crank->X_WB.p + 0.1 * Vec3(std::cos(angle), std::sin(angle), 0);
    hand.grasp_intent = t > 0.5 ? 1.0 : 0.0;
    (*client)->send(hand);
    if (const auto force = (*client)->newest_force()) held = held || force->holding;
  }
  std::printf(held ? "the crank was held\n" : "the crank was not held\n");
  return held ? 0 : 1;
}
