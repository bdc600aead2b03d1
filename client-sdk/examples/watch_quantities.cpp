// Prints the quantities of a kiosk's world, four times a second. Exit status 0 when at least one frame was received.
#include <cstdio>
#include <thread>

#include "client-sdk/examples/arguments.hpp"

using namespace mechane;
using namespace std::chrono_literals;

int main(int argc, char** argv) {
  const auto arguments = example::read_arguments(argc, argv, "watch-quantities", client::Role::watcher);
  auto client = client::Client::connect(arguments.config);
  if (!client) return std::fprintf(stderr, "%s\n", client.error().to_string().c_str()), 1;
  if (!(*client)->wait_for(client::LinkState::joined, 10s)) {
    return std::fprintf(stderr, "no world: is a server running? %s\n", (*client)->refusal().c_str()), 1;
  }
  bool any = false;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(arguments.seconds);
  while (std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(250ms);
    client::Frame frame;
    const auto status = (*client)->world_status();
    if (!status || !(*client)->newest_frame(frame)) continue;
    any = true;
    std::printf("tick %llu, step %s:", static_cast<unsigned long long>(frame.tick), status->step.c_str());
    for (std::size_t i = 0; i < frame.quantities.size() && i < status->quantities.size(); ++i) {
      std::printf("  %s %.3f %s", status->quantities[i].name.c_str(), frame.quantities[i],
                  status->quantities[i].unit.c_str());
    }
    std::printf("\n");
  }
  return any ? 0 : 1;
}
