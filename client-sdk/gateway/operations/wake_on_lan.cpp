#include "client-sdk/gateway/operations/wake_on_lan.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

namespace mechane::gateway {
namespace {

Expected<sockaddr_in> target_of(const std::string& to) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  const std::size_t colon = to.rfind(':');
  std::uint16_t port = 0;
  const bool has_port =
      colon != std::string::npos &&
      std::from_chars(to.data() + colon + 1, to.data() + to.size(), port).ptr == to.data() + to.size();
  if (!has_port || port == 0 || ::inet_pton(AF_INET, to.substr(0, colon).c_str(), &address.sin_addr) != 1)
    return fail(ErrorCode::invalid_value, "this is not an address to send to", to, "write --wake-to 255.255.255.255:9");
  address.sin_port = htons(port);
  return address;
}

}  // namespace

std::optional<MacAddress> parse_mac(std::string_view text) {
  if (text.size() != 17) return std::nullopt;
  MacAddress mac{};
  for (std::size_t i = 0; i < mac.size(); ++i) {
    const char* const pair = text.data() + 3 * i;
    if (i > 0 && pair[-1] != ':' && pair[-1] != '-') return std::nullopt;
    if (std::from_chars(pair, pair + 2, mac.at(i), 16).ptr != pair + 2) return std::nullopt;
  }
  return mac;
}

std::string mac_text(const MacAddress& mac) {
  return fmt::format("{:02x}:{:02x}:{:02x}:{:02x}:{:02x}:{:02x}", mac[0], mac[1], mac[2], mac[3], mac[4], mac[5]);
}

std::array<std::uint8_t, 102> magic_packet(const MacAddress& mac) {
  std::array<std::uint8_t, 102> packet{};
  std::fill_n(packet.begin(), 6, std::uint8_t{0xFF});
  for (std::size_t at = 6; at < packet.size(); at += mac.size())
    std::ranges::copy(mac, packet.begin() + static_cast<long>(at));
  return packet;
}

Expected<void> wake(const MacAddress& mac, const std::string& to) {
  const auto target = target_of(to);
  if (!target) return tl::unexpected(target.error());
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const auto packet = magic_packet(mac);
  const int yes = 1;
  const bool sent = socket >= 0 && ::setsockopt(socket, SOL_SOCKET, SO_BROADCAST, &yes, sizeof yes) == 0 &&
                    ::sendto(socket, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&*target),
                             sizeof *target) == static_cast<ssize_t>(packet.size());
  const int error = errno;
  if (socket >= 0) ::close(socket);
  if (sent) return {};
  return fail(ErrorCode::io_failure, std::string("no packet can be sent: ") + std::strerror(error), to,
              "check this machine's network; --wake-to names the broadcast address of the kiosks' network");
}

}  // namespace mechane::gateway
