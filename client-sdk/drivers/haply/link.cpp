#include "client-sdk/drivers/haply/link.hpp"

#include <utility>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

namespace mechane::drivers {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kConnect{5000};
constexpr std::chrono::milliseconds kSend{200};  // a command fits the socket's buffer many times over
constexpr std::chrono::milliseconds kClose{20};
constexpr std::size_t kReservedBytes = 64U << 10U;
constexpr std::size_t kLargestMessage = 256U << 10U;

}  // namespace

struct HaplyLink::Wire {
  std::string host;
  std::string port;
  asio::io_context io{1};
  websocket::stream<beast::tcp_stream> socket{io};
  beast::flat_buffer buffer{kLargestMessage};
  bool open = false;
  bool reading = false;   // a read has begun, and its message has not been handed on yet
  bool read_done = true;  // none is on its way, or it has ended
  error_code read_error{};

  /// Runs what is ready, even past the deadline, then waits for more until `done` or the deadline.
  void run_until(const bool& done, Clock::time_point deadline) {
    while (!done) {
      io.restart();
      if (io.poll_one() == 0 && io.run_one_until(deadline) == 0) return;
    }
  }

  /// Starts an operation on `stream` and waits for its end. What is too late is cancelled by closing the stream.
  template <class Start>
  error_code await(beast::tcp_stream& stream, std::chrono::milliseconds patience, Start&& start) {
    error_code result;
    bool done = false;
    start([&](error_code error, auto&&...) {
      result = error;
      done = true;
    });
    run_until(done, Clock::now() + patience);
    if (done) return result;
    stream.close();
    run_until(done, Clock::time_point::max());
    return asio::error::timed_out;
  }

  error_code connect(beast::tcp_stream& stream) {
    error_code error;
    tcp::resolver resolver(io);
    const auto found = resolver.resolve(host, port, error);
    if (error) return error;
    error = await(stream, kConnect, [&](auto done) { stream.async_connect(found, std::move(done)); });
    if (!error) stream.socket().set_option(tcp::no_delay(true), error);
    return error;
  }

  [[nodiscard]] std::string fault(const std::string& what, const error_code& error) const {
    return "the Haply service at " + host + ":" + port + " " + what + " (" + error.message() + ")";
  }
  [[nodiscard]] std::string not_there(const error_code& error) const {
    return fault("cannot be reached", error) +
           "; start it (systemctl start haply-inverse-service), or correct the options host and port";
  }
  [[nodiscard]] std::string gone(const error_code& error) const {
    return fault("ended the connection", error) + "; is it running? (systemctl status haply-inverse-service)";
  }
};

HaplyLink::HaplyLink(std::string host, std::uint16_t port) : wire_(std::make_unique<Wire>()) {
  wire_->host = std::move(host);
  wire_->port = std::to_string(port);
}

HaplyLink::~HaplyLink() {
  Wire& wire = *wire_;
  beast::tcp_stream& stream = beast::get_lowest_layer(wire.socket);
  if (wire.open)
    wire.await(stream, kClose,
               [&](auto done) { wire.socket.async_close(websocket::close_code::normal, std::move(done)); });
  stream.close();
  wire.run_until(wire.read_done, Clock::now() + kClose);  // its end still writes to the wire
}

std::string HaplyLink::ask_version(std::string& body) {
  beast::tcp_stream stream(wire_->io);
  if (const error_code error = wire_->connect(stream)) return wire_->not_there(error);
  http::request<http::empty_body> question(http::verb::get, "/version", 11);
  question.set(http::field::host, wire_->host);
  question.set(http::field::connection, "close");
  error_code error =
      wire_->await(stream, kConnect, [&](auto done) { http::async_write(stream, question, std::move(done)); });
  beast::flat_buffer buffer(kLargestMessage);
  http::response<http::string_body> answer;
  if (!error)
    error =
        wire_->await(stream, kConnect, [&](auto done) { http::async_read(stream, buffer, answer, std::move(done)); });
  if (error) return wire_->fault("does not report its version", error) + "; give the option key=values or key=vector";
  body = answer.body();
  return {};
}

std::string HaplyLink::open() {
  Wire& wire = *wire_;
  beast::tcp_stream& stream = beast::get_lowest_layer(wire.socket);
  if (const error_code error = wire.connect(stream)) return wire.not_there(error);
  const std::string host = wire.host + ":" + wire.port;
  const error_code error =
      wire.await(stream, kConnect, [&](auto done) { wire.socket.async_handshake(host, "/", std::move(done)); });
  if (error) return wire.fault("does not speak WebSocket", error) + "; is the option port right?";
  wire.socket.read_message_max(kLargestMessage);
  wire.socket.text(true);
  wire.socket.auto_fragment(false);
  wire.buffer.reserve(kReservedBytes);
  wire.open = true;
  return {};
}

std::string HaplyLink::send(std::string_view text) {
  Wire& wire = *wire_;
  const error_code error = wire.await(beast::get_lowest_layer(wire.socket), kSend, [&](auto done) {
    wire.socket.async_write(asio::buffer(text.data(), text.size()), std::move(done));
  });
  if (!error) return {};
  wire.open = false;
  return wire.gone(error);
}

std::string HaplyLink::receive(std::chrono::milliseconds patience, std::string_view& message) {
  Wire& wire = *wire_;
  message = {};
  if (!wire.reading) {
    wire.buffer.clear();
    wire.reading = true;
    wire.read_done = false;
    wire.socket.async_read(wire.buffer, [&wire](error_code error, std::size_t) {
      wire.read_error = error;
      wire.read_done = true;
    });
  }
  wire.run_until(wire.read_done, Clock::now() + patience);
  if (!wire.read_done) return {};
  wire.reading = false;
  if (wire.read_error) {
    wire.open = false;
    return wire.gone(wire.read_error);
  }
  const auto bytes = wire.buffer.cdata();
  message = {static_cast<const char*>(bytes.data()), bytes.size()};
  return {};
}

}  // namespace mechane::drivers
