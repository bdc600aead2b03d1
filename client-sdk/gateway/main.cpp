// mechane-gateway: kiosks and the operator's console for browsers.
#include <filesystem>
#include <optional>

#include <CLI/CLI.hpp>

#include "client-sdk/gateway/gateway.hpp"
#include "server/base/program_folder.hpp"
#include "server/log/command_line.hpp"
#include "server/log/log.hpp"

namespace {

using namespace mechane;

struct Arguments {
  gateway::GatewayOptions options;
  std::string listen = "127.0.0.1:8480";
  double token_idle_minutes = 30;
};

void add_options(CLI::App& app, Arguments& a) {
  gateway::GatewayOptions& o = a.options;
  app.add_option("--listen", a.listen, "address and port; 0.0.0.0:8480: all networks of this machine")
      ->capture_default_str();
  app.add_option("--kiosk", o.kiosks, "kiosks whose addresses are printed at the start")->capture_default_str();
  app.add_option("--domain", o.domain, "DDS domain");
  app.add_option("--app", o.app, "folder of the built web app")->capture_default_str();
  app.add_option("--state", o.state, "folder of accounts, certificate and audit log")->capture_default_str();
  app.add_option("--records", o.records, "the server's folder of records, to show visits");
  app.add_option("--exhibit-key", o.exhibit_key,
                 "the server's key file, for operators who change exhibits; without: exhibits.key in --records");
  app.add_option("--scenarios", o.scenarios,
                 "the server's folder of exhibits, to play visits back and to edit and publish them");
  app.add_option("--playback-domain", o.playback_domain,
                 "first of two DDS domains, with no server in them, for playing back")
      ->check(CLI::Range(0, 229))
      ->capture_default_str();
  auto* certificate = app.add_option("--tls-cert", o.web.certificate, "the certificate, PEM; without: one made here");
  auto* key = app.add_option("--tls-key", o.web.key, "its key, PEM")->needs(certificate);
  certificate->needs(key);
  app.add_flag("--plain", o.plain, "without TLS beyond this machine, too: passwords and tokens can then be overheard");
  app.add_option("--phones", o.phones,
                 "native displays show a code that leads phones to this gateway, by this address as phones reach it: "
                 "https://HOST:PORT");
  app.add_option("--hand-model", o.hand_model,
                 "MediaPipe's hand_landmarker.task: pages then find a visitor's hand in their camera's pictures");
  app.add_option("--hand-program", o.web.hand_program,
                 "the same by a program on the browser's own machine: its port there")
      ->check(CLI::Range(1, 65535));
  app.add_option("--token-idle", a.token_idle_minutes, "minutes without a touch after which a kiosk's address ends")
      ->check(CLI::Range(0.05, 1440.0))
      ->capture_default_str();
  app.add_option("--wake-to", o.wake_to, "where packets go that wake kiosks at opening: a network's broadcast address")
      ->capture_default_str();
  app.add_option("--most-connections", o.web.most_sockets, "at a time; further ones are refused")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--most-of-address", o.web.most_of_address, "the same of one address")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
}

/// The app in the build tree, or else as it is installed.
std::filesystem::path usual_app() {
  const std::filesystem::path beside = program_folder().parent_path() / "web";
  return std::filesystem::exists(beside / "index.html") ? beside : program_folder().parent_path() / "share/mechane/web";
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  a.options.app = usual_app();
  a.options.state = "out/gateway";
  CLI::App app{"Shows kiosks and the operator's console to web browsers.", "mechane gateway"};
  add_options(app, a);
  if (const std::optional<int> status = parse_command_line(app, argc, argv)) return *status;
  log::start("gateway", log::Level::info);
  auto listen = gateway::parse_listen_address(a.listen);
  if (!listen) return log::error(listen.error()), 2;
  a.options.web.listen = *listen;
  if (a.options.exhibit_key.empty() && !a.options.records.empty())
    a.options.exhibit_key = a.options.records / "exhibits.key";
  a.options.token_idle = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(60 * a.token_idle_minutes));
  if (auto ran = gateway::run_gateway(std::move(a.options)); !ran) return log::error(ran.error()), 1;
  return 0;
}
