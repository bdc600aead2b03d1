#include "client-sdk/gateway/gateway.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "client-sdk/gateway/browsers/hand_finders.hpp"
#include "client-sdk/gateway/http/certificate.hpp"
#include "client-sdk/gateway/sign_in/secrets.hpp"
#include "client-sdk/gateway/site.hpp"
#include "server/log/log.hpp"
#include <mechane/proto/identity.hpp>
#include <mechane/proto/names.hpp>

namespace mechane::gateway {
namespace {

constexpr Duration kTick = std::chrono::milliseconds(5);

Expected<void> make_state_folder(const std::filesystem::path& folder) {
  std::error_code error;
  const bool made = std::filesystem::create_directories(folder, error);
  if (!error && made)
    std::filesystem::permissions(folder, std::filesystem::perms::owner_all, std::filesystem::perm_options::replace,
                                 error);
  if (error)
    return fail(ErrorCode::io_failure, "the folder cannot be made: " + error.message(), folder.string(),
                "name another one with --state");
  return {};
}

/// Beyond this machine, passwords and tokens travel over TLS, or somebody says that they need not.
Expected<void> choose_tls(GatewayOptions& options) {
  if (options.web.listen.loopback || options.plain || !options.web.certificate.empty()) return {};
  std::vector<std::string> names{"localhost"};
  const std::string host = proto::host_name();
  if (proto::check_name(host, "host")) names = {host, host + ".local", "localhost"};
  auto files = own_certificate(options.state, names, own_addresses());
  if (!files) return tl::unexpected(files.error());
  if (files->made)
    log::info("made a certificate: browsers warn of it until they are told to trust " + files->certificate.string());
  options.web.certificate = files->certificate;
  options.web.key = files->key;
  return {};
}

/// What a browser on this machine, or for an address of the network on another one, is given.
std::string origin_of(const GatewayOptions& options, std::uint16_t port) {
  const std::string& address = options.web.listen.address;
  std::string host = address.find(':') == std::string::npos ? address : "[" + address + "]";
  if (address == "0.0.0.0" || address == "::") host = proto::host_name();
  return fmt::format("{}://{}:{}", options.web.certificate.empty() ? "http" : "https", host, port);
}

/// On stdout, for people and for the program that started this one.
void print_addresses(GatewaySite& site, const std::string& origin, const std::string& first_password) {
  if (!first_password.empty()) fmt::print("operator's password, shown only now: operator {}\n", first_password);
  for (const std::string& kiosk : site.options().kiosks)
    fmt::print("kiosk {}: {}\n", kiosk, site.address_of(kiosk, origin));
  fmt::print("console: {}/console\n", origin);
  fmt::print("ready\n");
  std::fflush(stdout);
}

}  // namespace

Expected<void> run_gateway(GatewayOptions options) {
  for (const std::string& kiosk : options.kiosks)
    if (auto named = proto::check_name(kiosk, "kiosk"); !named) return named;
  client::DisplaySettings unused;
  if (auto address = client::apply({"phone-address", options.phones}, unused); !address)
    return fail(ErrorCode::invalid_value, "'" + options.phones + "' is not an address for phones", "--phones",
                "write https://HOST:PORT, without a path, in 63 characters at most");
  if (!options.hand_model.empty()) {
    if (auto model = check_hand_model(options.hand_model); !model) return model;
    options.hand_model = std::filesystem::absolute(options.hand_model);
  }
  if (auto ready = start_secrets(); !ready) return ready;
  if (auto made = make_state_folder(options.state); !made) return made;
  if (auto chosen = choose_tls(options); !chosen) return chosen;
  auto accounts = Accounts::open(options.state);
  if (!accounts) return tl::unexpected(accounts.error());
  const std::string first_password = accounts->first_password();
  auto operations = Operations::open(options.state);
  if (!operations) return tl::unexpected(operations.error());
  auto server = WebServer::open(options.web);
  if (!server) return tl::unexpected(server.error());
  auto seats = client::DisplaySeats::open(options.domain);
  if (!seats) return tl::unexpected(seats.error());
  auto watch = client::DisplayWatch::open(options.domain);
  if (!watch) return tl::unexpected(watch.error());
  auto exhibits = client::ExhibitWatch::open(options.domain);
  if (!exhibits) return tl::unexpected(exhibits.error());
  GatewaySite site(options, **server, std::move(*accounts), std::move(*operations), std::move(*seats), **watch,
                   **exhibits);
  (*server)->every(kTick, [&site] { site.tick(); });
  print_addresses(site, origin_of(options, (*server)->port()), first_password);
  (*server)->run(site);
  return {};
}

}  // namespace mechane::gateway
