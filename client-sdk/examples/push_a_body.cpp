// Moves a one-point hand to the first movable body and 3 mm further, and prints the force that it feels. Exit status 0
// when forces were received.
#include <algorithm>
#include <cstdio>

#include "client-sdk/examples/arguments.hpp"

using namespace mechane;
using namespace std::chrono_literals;

int main(int argc, char** argv) {
  const auto arguments = example::read_arguments(argc, argv, "push-a-body", client::Role::hand);
  auto client = client::Client::connect(arguments.config);
  if (!client) return std::fprintf(stderr, "%s\n", client.error().to_string().c_str()), 1;
  client::Frame frame;
  if (!(*client)->wait_for(client::LinkState::joined, 10s)) {
    return std::fprintf(stderr, "no world: is a server running? %s\n", (*client)->refusal().c_str()), 1;
  }
  SystemClock clock;
  TimePoint next = clock.now();
  const TimePoint begin = next;
  const Duration all = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(arguments.seconds));
  std::uint64_t forces = 0;
  double largest_n = 0;
  while (next - begin < all) {
    clock.sleep_until(next += kTickPeriod);
    if (!(*client)->newest_frame(frame) || frame.bodies.empty()) continue;
    // From 20 cm above the body down to 3 mm below its origin, over the whole time.
    const double share = std::chrono::duration<double>(next - begin) / std::chrono::duration<double>(all);
    client::HandSample hand;
    hand.X_WH.p = frame.bodies[0].X_WB.p + Vec3(0, 0.2 - 0.203 * share, 0);
    hand.V_WH.v = Vec3(0, -0.203 / arguments.seconds, 0);
    (*client)->send(hand);
    if (const auto force = (*client)->newest_force()) {
      largest_n = std::max(largest_n, force->force_W.f.norm());
      if (forces++ % 250 == 0) std::printf("%.3f s: %.2f N\n", share * arguments.seconds, force->force_W.f.norm());
    }
  }
  std::printf("%llu forces, the largest %.2f N\n", static_cast<unsigned long long>(forces), largest_n);
  return forces > 0 ? 0 : 1;
}
