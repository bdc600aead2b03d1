// Haply's local service as a driver sees it, on a free port of this machine, in both formats, with one arm and one
// grip.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <nlohmann/json.hpp>
#include <sys/socket.h>

namespace mechane::test {

/// Serves one connection after the other on a thread of its own. A test may call every member while it runs.
class FakeHaply {
 public:
  using Json = nlohmann::json;
  /// From the state that is about to be sent to what is sent: a message for each line.
  using Reply = std::function<std::string(Json& frame)>;

  /// `version` is what GET /version names; from 3.5 on the service reads `vector`, before that `values`.
  explicit FakeHaply(std::string version = "3.5.0.0") : version_(std::move(version)), vector_(version_ >= "3.5") {
    frame_ = Json::parse(R"({"inverse3": [{"device_id": "049D", "config": {"handedness": "right"},
      "state": {"cursor_position": {"x": 0.01, "y": 0.02, "z": 0.03}, "cursor_velocity": {"x": 0, "y": 0, "z": 0},
                "current_cursor_force": {"x": 0, "y": 0, "z": 0}},
      "status": {"calibrated": true, "in_use": false, "power_supply": true, "ready": true, "started": true}}],
      "wireless_verse_grip": [{"device_id": "61548", "state": {"orientation": {"w": 0.5, "x": 0.5, "y": 0.5, "z": 0.5},
                               "buttons": {"a": false, "b": true, "c": false}}}]})");
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }
  ~FakeHaply() {
    thread_.request_stop();
    ::shutdown(acceptor_.native_handle(), SHUT_RDWR);  // ends a wait in accept()
    hang_up();
    thread_.join();
  }
  FakeHaply(const FakeHaply&) = delete;
  FakeHaply& operator=(const FakeHaply&) = delete;

  [[nodiscard]] std::string options(const std::string& more = "") const {
    return "port=" + std::to_string(port_) + (more.empty() ? "" : "," + more);
  }
  /// What all messages from now on are made of, the first of a connection too.
  void change(const std::function<void(Json& frame)>& edit) {
    const std::lock_guard lock(mutex_);
    edit(frame_);
  }
  void answer_with(Reply reply) {
    const std::lock_guard lock(mutex_);
    reply_ = std::move(reply);
  }
  /// N along z, on top of what is asked for, as another program's session would.
  void add_force(double newtons) { added_n_ = newtons; }
  void hang_up() {
    const std::lock_guard lock(mutex_);
    if (connection_ >= 0) ::shutdown(connection_, SHUT_RDWR);
  }

  /// The force that was last asked for, in Haply's axes.
  [[nodiscard]] std::array<double, 3> force() const {
    const std::lock_guard lock(mutex_);
    return force_;
  }
  [[nodiscard]] std::string first_command() const {
    const std::lock_guard lock(mutex_);
    return first_command_;
  }
  [[nodiscard]] int commands() const { return commands_; }
  /// How many WebSockets were opened and have ended.
  [[nodiscard]] int ended() const { return ended_; }

 private:
  using Tcp = boost::asio::ip::tcp;
  using Error = boost::system::error_code;

  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      Error error;
      Tcp::socket socket(io_);
      acceptor_.accept(socket, error);
      if (error || stop.stop_requested()) continue;
      hold(socket.native_handle());
      serve(socket);
      hold(-1);
    }
  }

  void hold(int connection) {
    const std::lock_guard lock(mutex_);
    connection_ = connection;
  }

  void serve(Tcp::socket& socket) {
    namespace http = boost::beast::http;
    Error error;
    boost::beast::flat_buffer buffer;
    http::request<http::string_body> request;
    http::read(socket, buffer, request, error);
    if (error) return;
    if (boost::beast::websocket::is_upgrade(request)) return talk(socket, request);
    http::response<http::string_body> answer(http::status::ok, 11);
    answer.body() = Json{{"project_name", "haply-inverse-service"}, {"project_version", version_}}.dump();
    answer.keep_alive(false);
    answer.prepare_payload();
    http::write(socket, answer, error);
  }

  template <class Request>
  void talk(Tcp::socket& socket, const Request& request) {
    Error error;
    boost::beast::websocket::stream<Tcp::socket&> stream(socket);
    stream.accept(request, error);
    stream.write(boost::asio::buffer(inventory()), error);
    while (!error) {
      boost::beast::flat_buffer buffer;
      stream.read(buffer, error);
      if (error) break;
      take(boost::beast::buffers_to_string(buffer.data()));
      std::istringstream messages(reply());
      for (std::string message; std::getline(messages, message);)
        stream.write(boost::asio::buffer(message), error);
    }
    ++ended_;
  }

  std::string inventory() {
    const std::lock_guard lock(mutex_);
    first_command_.clear();
    return frame_.dump();
  }

  /// As the service does, a command with the other format's key changes nothing, and a tick without one has no force.
  void take(const std::string& text) {
    const Json command = Json::parse(text);
    const std::lock_guard lock(mutex_);
    if (first_command_.empty()) first_command_ = text;
    force_ = {};
    const Json::json_pointer at("/inverse3/0/commands/set_cursor_force/" + std::string(vector_ ? "vector" : "values"));
    if (command["inverse3"][0]["device_id"] == "049D" && command.contains(at))
      force_ = {command[at]["x"], command[at]["y"], command[at]["z"]};
    ++commands_;
  }

  std::string reply() {
    const std::lock_guard lock(mutex_);
    Json frame = frame_;
    if (!frame["inverse3"].empty() && frame["inverse3"][0]["state"].contains("current_cursor_force"))
      frame["inverse3"][0]["state"]["current_cursor_force"] = {
          {"x", force_[0]}, {"y", force_[1]}, {"z", force_[2] + added_n_}};
    return reply_ ? reply_(frame) : frame.dump();
  }

  const std::string version_;
  const bool vector_;
  boost::asio::io_context io_;
  Tcp::acceptor acceptor_{io_, Tcp::endpoint(boost::asio::ip::address_v4::loopback(), 0)};
  const std::uint16_t port_ = acceptor_.local_endpoint().port();
  std::atomic<int> commands_ = 0;
  std::atomic<int> ended_ = 0;
  std::atomic<double> added_n_ = 0;
  mutable std::mutex mutex_;  // of the members below: the test's thread and the server's share them
  Json frame_;
  Reply reply_;
  std::array<double, 3> force_{};
  std::string first_command_;
  int connection_ = -1;
  std::jthread thread_;
};

}  // namespace mechane::test
