// The floor under every round trip: two processes on this machine that do nothing but pass UDP datagrams, at the
// priority, payload and rate of the haptic samples.
#include <algorithm>
#include <csignal>
#include <cstring>
#include <iostream>
#include <span>
#include <vector>

#include <CLI/CLI.hpp>
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "server/base/clock.hpp"
#include "server/base/error.hpp"
#include "server/realtime/priority.hpp"
#include "tests/benchmark/bench_stats.hpp"

namespace mechane::benchmark {
namespace {

struct Config {
  int priority = 50;  // SCHED_FIFO; 0: an ordinary thread
  double seconds = 5;
  std::size_t out_bytes = 496;
  std::size_t back_bytes = 72;
};

constexpr std::size_t kMaxBytes = 65000;

// A socket on the loopback interface, on a port of the system's choice; receives give up after 100 ms.
struct Socket {
  int fd = -1;
  sockaddr_in address{};

  static Expected<Socket> open() {
    Socket socket{::socket(AF_INET, SOCK_DGRAM, 0), {}};
    const timeval limit{0, 100'000};
    socklen_t size = sizeof socket.address;
    socket.address.sin_family = AF_INET;
    socket.address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    auto* address = reinterpret_cast<sockaddr*>(&socket.address);
    if (socket.fd < 0 || ::bind(socket.fd, address, size) != 0 || ::getsockname(socket.fd, address, &size) != 0 ||
        ::setsockopt(socket.fd, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit) != 0)
      return fail(ErrorCode::io_failure, std::string("no UDP socket on 127.0.0.1: ") + std::strerror(errno));
    return socket;
  }
};

// The other process: answers each datagram with its first bytes, until its parent ends it.
[[noreturn]] void answer(const Socket& socket, const Socket& asker, const Config& config) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  (void)realtime::take_fifo(config.priority);
  std::vector<char> bytes(kMaxBytes);
  const auto* to = reinterpret_cast<const sockaddr*>(&asker.address);
  for (;;) {
    if (::recv(socket.fd, bytes.data(), bytes.size(), 0) > 0)
      ::sendto(socket.fd, bytes.data(), config.back_bytes, 0, to, sizeof asker.address);
  }
}

// Waits for the answer that carries `number`; older ones, of datagrams given up, are dropped.
bool wait_for(const Socket& socket, std::uint64_t number, std::span<char> bytes) {
  std::uint64_t answered = 0;
  while (::recv(socket.fd, bytes.data(), bytes.size(), 0) > 0) {
    std::memcpy(&answered, bytes.data(), sizeof answered);
    if (answered == number) return true;
  }
  return false;
}

void ask(const Socket& socket, const Socket& answerer, const Config& config, Report& report) {
  const auto count = static_cast<std::uint64_t>(config.seconds * 1000);
  Samples trips(count);
  SystemClock clock;
  std::vector<char> out(config.out_bytes);
  std::vector<char> back(kMaxBytes);
  const auto* to = reinterpret_cast<const sockaddr*>(&answerer.address);
  std::uint64_t lost = 0;
  TimePoint due = clock.now();
  for (std::uint64_t number = 1; number <= count; ++number) {
    due = std::max(due + kTickPeriod, clock.now());
    clock.sleep_until(due);  // sleeps: the pace
    std::memcpy(out.data(), &number, sizeof number);
    const TimePoint sent = clock.now();
    ::sendto(socket.fd, out.data(), out.size(), 0, to, sizeof answerer.address);
    if (wait_for(socket, number, back))
      trips.add(clock.now() - sent);
    else
      ++lost;
  }
  report.distribution("udp_us", trips);
  report.metric("udp_lost", static_cast<double>(lost));
}

int run(const Config& config) {
  auto asker = Socket::open();
  auto answerer = Socket::open();
  if (!asker || !answerer) {
    std::cerr << "udp_pingpong: " << (asker ? answerer : asker).error().to_string() << "\n";
    return 1;
  }
  const pid_t other = ::fork();
  if (other < 0) {
    std::cerr << "udp_pingpong: cannot start the answering process: " << std::strerror(errno) << "\n";
    return 1;
  }
  if (other == 0) answer(*answerer, *asker, config);

  Report report;
  if (!realtime::take_fifo(config.priority)) report.note("udp: SCHED_FIFO was refused, ordinary priority");
  ask(*asker, *answerer, config, report);
  ::kill(other, SIGKILL);
  ::waitpid(other, nullptr, 0);
  std::cout << report.text() << "\n";
  return 0;
}

}  // namespace
}  // namespace mechane::benchmark

int main(int argc, char** argv) {
  mechane::benchmark::Config config;
  CLI::App app{"UDP round trips between two processes on this machine, a thousand a second"};
  app.add_option("--priority", config.priority, "SCHED_FIFO priority of both; 0: none")->check(CLI::Range(0, 99));
  app.add_option("--seconds", config.seconds, "how long")->check(CLI::Range(0.1, 3600.0));
  app.add_option("--out", config.out_bytes, "bytes of a question")->check(CLI::Range(8, 60000));
  app.add_option("--back", config.back_bytes, "bytes of an answer")->check(CLI::Range(8, 60000));
  CLI11_PARSE(app, argc, argv);
  return mechane::benchmark::run(config);
}
