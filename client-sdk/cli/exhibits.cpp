#include "client-sdk/cli/exhibits.hpp"

#include <iostream>
#include <optional>

#include "client-sdk/cli/exhibits_text.hpp"
#include "server/base/clock.hpp"
#include <mechane/client/exhibits.hpp>

namespace mechane::cli {
namespace {

using client::ExhibitStatus;

constexpr Duration kExhibitLook = std::chrono::milliseconds(50);
constexpr double kServerWithin_s = 5;

int tell_of_exhibits(const Error& error, int status) {
  std::cerr << "mechane exhibits: " << error.to_string() << "\n";
  return status;
}

TimePoint in_seconds(double s) {
  return SystemClock().now() + std::chrono::duration_cast<Duration>(std::chrono::duration<double>(s));
}

/// The server of this name; without one, the first that is heard.
Expected<ExhibitStatus> find_server(client::ExhibitWatch& watch, const std::string& name) {
  const TimePoint until = in_seconds(kServerWithin_s);
  SystemClock clock;
  while (clock.now() < until) {
    watch.wait(kExhibitLook);
    for (const ExhibitStatus& status : watch.servers())
      if (name.empty() || status.server == name) return status;
  }
  return fail(ErrorCode::not_found, name.empty() ? "no server is heard" : "no server of this name is heard", name,
              "start one with 'mechane server', in the same DDS domain and network (mechane doctor)");
}

int ask(client::ExhibitWatch& watch, const std::string& server, client::ExhibitVerb verb,
        const ExhibitsOptions& options) {
  const auto id = watch.request(server, {.verb = verb, .exhibit = options.name, .now = options.now}, options.key);
  if (!id) return tell_of_exhibits(id.error(), 2);
  SystemClock clock;
  const TimePoint until = in_seconds(options.seconds);
  std::optional<client::ExhibitAnswer> answer;
  while (!answer && clock.now() < until) {
    watch.wait(kExhibitLook);
    answer = watch.answer(*id);
  }
  if (!answer) {
    return tell_of_exhibits({ErrorCode::timed_out, "the server has not answered yet", options.name,
                             "look at its log; where it still prepares the exhibit, mechane exhibits tells so"},
                            1);
  }
  if (!answer->refusal.empty())
    return tell_of_exhibits({ErrorCode::conflict, answer->refusal, answer->place, answer->remedy}, 1);
  std::cout << options.name << ": done\n";
  return 0;
}

}  // namespace

int run_exhibits(const std::string& verb, const ExhibitsOptions& options) {
  auto watch = client::ExhibitWatch::open(options.domain);
  if (!watch) return tell_of_exhibits(watch.error(), 1);
  const auto server = find_server(**watch, options.server);
  if (!server) return tell_of_exhibits(server.error(), 1);
  if (const auto order = client::exhibit_verb(verb)) return ask(**watch, server->server, *order, options);
  std::cout << (options.json ? exhibits_json(*server) : exhibits_table(*server));
  return 0;
}

}  // namespace mechane::cli
