// Requests, answers and sockets as the rest of the room sees them: plain data and two small interfaces, without the web
// library.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "client-sdk/gateway/http/frame_bytes.hpp"
#include "server/base/error.hpp"

namespace mechane::gateway {

struct HttpRequest {
  enum class Method : std::uint8_t { get, head, post, other };
  Method method = Method::get;
  std::string path;                            ///< decoded, begins with '/'
  std::map<std::string, std::string> query;    ///< decoded
  std::map<std::string, std::string> headers;  ///< names in lower case; of those that came twice, the first
  std::string body;
  std::string address;  ///< of the sender, in digits
  bool secure = false;  ///< came over TLS

  /// Empty where there is none.
  [[nodiscard]] const std::string& header(const std::string& name) const;
  [[nodiscard]] std::string query_value(const std::string& name) const;
};

struct HttpAnswer {
  unsigned status = 200;
  std::string content_type = "application/json";
  std::shared_ptr<const std::string> body = std::make_shared<const std::string>();
  std::size_t from = 0;  ///< the part of the body that is sent
  std::size_t size = 0;
  std::vector<std::pair<std::string, std::string>> headers{};
  bool framed = false;  ///< pages of this gateway may show it in a frame
};

[[nodiscard]] HttpAnswer answer_with(std::string body, std::string content_type, unsigned status = 200);
/// The same, and nobody on the way may keep it.
[[nodiscard]] HttpAnswer fresh_answer(std::string body, std::string content_type = "application/json",
                                      unsigned status = 200);
/// {"error": what happened, "remedy": what to do}.
[[nodiscard]] HttpAnswer refusal(unsigned status, const std::string& what, const std::string& remedy);
/// The same of an Error, with the status that fits its code.
[[nodiscard]] HttpAnswer refusal(const Error& error);

/// A browser's WebSocket, seen from the gateway. On the loop's thread. After the socket has gone, nothing has an effect.
class Socket {
 public:
  virtual ~Socket() = default;
  /// A text whose kind was not sent yet is replaced: a slow browser gets the newest state only. An empty kind replaces nothing; of those,
  /// the oldest are dropped beyond a hundred.
  virtual void send_text(std::string_view kind, std::shared_ptr<const std::string> text) = 0;
  /// Replaces a frame that was not sent yet, and counts it as skipped.
  virtual void send_frame(std::shared_ptr<const FrameBody> frame) = 0;
  /// Closes after what is waiting was sent.
  virtual void close() = 0;
  [[nodiscard]] virtual std::uint32_t skipped() const = 0;
};

/// Who uses a socket. On the loop's thread.
class SocketUser {
 public:
  virtual ~SocketUser() = default;
  virtual void opened(std::shared_ptr<Socket> socket) = 0;
  virtual void text(std::string_view message) = 0;
  virtual void binary(std::span<const std::byte> message) = 0;
  /// The last call.
  virtual void closed() = 0;
};

/// What the web server shows. On the loop's thread; never blocks it.
class Site {
 public:
  using Done = std::function<void(HttpAnswer)>;
  virtual ~Site() = default;
  /// `done` is called once, on the loop's thread, now or later.
  virtual void answer(HttpRequest request, Done done) = 0;
  /// How many bytes the body of a request may have, whose header has come; 0: as many as usual.
  [[nodiscard]] virtual std::size_t longest_body(const HttpRequest& /*header*/) { return 0; }
  /// Somebody asks for a WebSocket.
  [[nodiscard]] virtual std::variant<HttpAnswer, std::shared_ptr<SocketUser>> join(const HttpRequest& request) = 0;
};

}  // namespace mechane::gateway
