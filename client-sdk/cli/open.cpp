#include "client-sdk/cli/open.hpp"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <set>

#include <fmt/format.h>

#include "server/base/clock.hpp"
#include "server/realtime/wakeup.hpp"
#include <mechane/client/client.hpp>
#include <mechane/proto/convert.hpp>
#include <mechane/proto/entity.hpp>

namespace mechane::cli {
namespace {

constexpr Duration kLookEvery = std::chrono::milliseconds(20);

Duration seconds(double s) {
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(s));
}

std::string known(const client::Client& client) {
  const auto server = client.server_status();
  return server ? fmt::format("name one of: {}", fmt::join(server->scenarios, ", "))
                : std::string("'mechane echo ServerStatus' lists its scenarios");
}

bool refused(client::Client& client, std::uint64_t command) {
  const auto events = client.take_events();
  return std::any_of(events.begin(), events.end(), [&](const client::WorldEvent& event) {
    return event.kind == "command_refused" && event.value == static_cast<double>(command);
  });
}

/// Sends the request and waits for the world that answers it.
Expected<client::WorldStatus> go_on(client::Client& client, const OpenOptions& options) {
  SystemClock clock;
  const TimePoint until = clock.now() + seconds(options.seconds);
  std::optional<client::WorldStatus> now = client.world_status();
  for (; !now && clock.now() < until; now = client.world_status())
    clock.sleep_until(clock.now() + kLookEvery);
  if (!now)
    return fail(ErrorCode::timed_out, "the kiosk's world sent no status", options.kiosk, "see the server's log");
  const std::string before = now->world;
  const std::uint64_t command = client.open_exhibit(options.scenario);
  while (clock.now() < until) {
    if (refused(client, command)) {
      return fail(ErrorCode::unknown_name, fmt::format("the server has no scenario '{}'", options.scenario),
                  options.kiosk, known(client));
    }
    now = client.world_status();
    if (now && now->world != before) return *now;
    clock.sleep_until(clock.now() + kLookEvery);
  }
  return fail(ErrorCode::timed_out,
              fmt::format("the kiosk did not go on to another exhibit within {:g} s", options.seconds), options.kiosk,
              "see the server's log");
}

/// Checks that a display or device has joined the kiosk: merely asking for a kiosk makes the server open a world for
/// it, which must not happen for a mistyped name.
Expected<void> find_kiosk(const OpenOptions& options) {
  auto participant = proto::Participant::create(options.domain);
  if (!participant) return tl::unexpected(participant.error());
  realtime::Wakeup news;
  auto reader = proto::Reader<proto::WorldAssignment>::create(*participant, "", [&news](auto) { news.signal(); });
  if (!reader) return tl::unexpected(reader.error());
  auto servers = proto::Reader<proto::ServerStatus>::create(*participant, "", [&news](auto) { news.signal(); });
  if (!servers) return tl::unexpected(servers.error());
  SystemClock clock;
  TimePoint until = clock.now() + seconds(options.seconds);
  std::set<std::string> kiosks;
  bool server_here = false;
  do {
    const bool server_before = server_here;
    servers->view().take_each([&](const proto::ServerStatus&, const proto::SampleInfo& info) {
      server_here = server_here || (info.valid && info.alive);
    });
    reader->view().take_each([&](const proto::WorldAssignment& wire, const proto::SampleInfo& info) {
      if (info.valid && info.alive) kiosks.emplace(proto::text_of(wire.kiosk));
    });
    if (kiosks.contains(options.kiosk)) return {};
    server_here = server_here || !kiosks.empty();
    // Once a server is found, it announces all its kiosks at about the same time.
    if (server_here && !server_before) until = std::min(until, clock.now() + seconds(0.2 * options.seconds));
    news.wait(kLookEvery);
  } while (clock.now() < until);
  if (!server_here) {
    return fail(ErrorCode::not_found, "no server answered", options.kiosk,
                "start one with 'mechane server', in the same DDS domain and network (mechane doctor)");
  }
  if (kiosks.empty()) {
    return fail(ErrorCode::not_found, "a server runs, but no display and no device has joined any kiosk", options.kiosk,
                fmt::format("start 'mechane display --kiosk {}' first", options.kiosk));
  }
  return fail(ErrorCode::unknown_name, "there is no kiosk of this name", options.kiosk,
              fmt::format("name one of: {}", fmt::join(kiosks, ", ")));
}

Expected<client::WorldStatus> open(const OpenOptions& options) {
  if (auto found = find_kiosk(options); !found) return tl::unexpected(found.error());
  auto client = client::Client::connect({.kiosk = options.kiosk, .program = "mechane-open", .domain = options.domain});
  if (!client) return tl::unexpected(client.error());
  if (!(*client)->wait_for(client::LinkState::joined, seconds(options.seconds))) {
    const std::string why = (*client)->refusal();
    return fail(why.empty() ? ErrorCode::timed_out : ErrorCode::busy,
                why.empty() ? "the kiosk's world does not answer" : why, options.kiosk, "see the server's log");
  }
  return go_on(**client, options);
}

}  // namespace

int run_open(const OpenOptions& options) {
  const auto world = open(options);
  if (!world) {
    std::cerr << "mechane open: " << world.error().to_string() << "\n";
    return 1;
  }
  std::cout << fmt::format("{} is at {} ({})\n", options.kiosk, world->scenario, world->world);
  return 0;
}

}  // namespace mechane::cli
