#include "client-sdk/gateway/http/web_server.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <deque>
#include <limits>
#include <list>
#include <optional>
#include <set>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <fmt/format.h>
#include <linux/sockios.h>
#include <sys/ioctl.h>

#include "client-sdk/gateway/http/request_path.hpp"
#include "client-sdk/gateway/http/security_headers.hpp"
#include "client-sdk/gateway/http/web_hall.hpp"
#include "server/base/utf8.hpp"
#include "server/log/log.hpp"

namespace mechane::gateway {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using boost::system::error_code;
using PlainStream = beast::tcp_stream;
using SecureStream = beast::ssl_stream<beast::tcp_stream>;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr seconds kRequestWithin{30};       // from one answer to the end of the next request
constexpr seconds kAnswerWithin{300};       // a large file over a slow network
constexpr seconds kUploadWithin{300};       // the same from a browser
constexpr seconds kLingers{2};              // so that a client reads why it was refused
constexpr std::size_t kMostRefusals = 200;  // that linger at a time
constexpr seconds kIdleSocket{30};
constexpr std::size_t kMostTexts = 100;
constexpr int kMostUnread_bytes = 16384;  // of frames, in the system's own buffer
constexpr std::string_view kProtocol = "mechane.1";

TimePoint now() {
  return std::chrono::steady_clock::now();
}

/// Reads what still comes until the other side closes, so that the system does not cut off what it was sent.
class Lingerer : public std::enable_shared_from_this<Lingerer> {
 public:
  Lingerer(PlainStream stream, std::shared_ptr<WebHall> hall) : stream_(std::move(stream)), hall_(std::move(hall)) {
    ++hall_->refusals;
  }
  Lingerer(const Lingerer&) = delete;
  Lingerer& operator=(const Lingerer&) = delete;
  ~Lingerer() { --hall_->refusals; }

  void say(std::string text) {
    text_ = std::move(text);
    stream_.expires_after(kLingers);
    asio::async_write(stream_, asio::buffer(text_), [self = shared_from_this()](error_code error, std::size_t) {
      if (!error) self->linger();
    });
  }
  void linger() {
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    stream_.expires_after(kLingers);
    drain();
  }

 private:
  void drain() {
    stream_.async_read_some(asio::buffer(read_), [self = shared_from_this()](error_code error, std::size_t) {
      if (!error) self->drain();
    });
  }
  PlainStream stream_;
  std::shared_ptr<WebHall> hall_;
  std::string text_;
  std::array<char, 1024> read_{};
};

template <class Stream>
class SocketConnection final : public Socket,
                               public LiveSocket,
                               public std::enable_shared_from_this<SocketConnection<Stream>> {
 public:
  SocketConnection(Stream stream, WebPlace place, std::shared_ptr<SocketUser> user)
      : socket_(std::move(stream)), place_(std::move(place)), user_(std::move(user)) {
    place_.hall().sockets.insert(this);
  }
  SocketConnection(const SocketConnection&) = delete;
  SocketConnection& operator=(const SocketConnection&) = delete;
  ~SocketConnection() override { place_.hall().sockets.erase(this); }

  void accept(http::request<http::string_body> request) {
    request_ = std::move(request);
    beast::get_lowest_layer(socket_).expires_never();
    socket_.set_option(websocket::stream_base::timeout{seconds(10), kIdleSocket, true});
    const std::string host(request_[http::field::host]);
    socket_.set_option(websocket::stream_base::decorator(
        [host, program = place_.hall().options.hand_program](websocket::response_type& response) {
          response.set(http::field::sec_websocket_protocol, std::string(kProtocol));
          for (const auto& [name, value] : security_headers(std::is_same_v<Stream, SecureStream>, host, false, program))
            response.set(name, value);
        }));
    socket_.read_message_max(place_.hall().options.message_bytes);
    socket_.auto_fragment(false);
    socket_.async_accept(request_, [self = this->shared_from_this()](error_code error) {
      if (error) return self->end();
      self->open_ = true;
      self->user_->opened(self);
      self->read();
      self->pump();
    });
  }

  void send_text(std::string_view kind, std::shared_ptr<const std::string> text) override {
    if (ended_ || closing_) return;
    const auto waiting =
        std::ranges::find_if(texts_, [&](const auto& one) { return !kind.empty() && one.first == kind; });
    if (waiting != texts_.end()) {
      waiting->second = std::move(text);
    } else {
      texts_.emplace_back(std::string(kind), std::move(text));
      if (texts_.size() > kMostTexts) texts_.pop_front();
    }
    pump();
  }
  void send_frame(std::shared_ptr<const FrameBody> frame) override {
    if (ended_ || closing_) return;
    if (std::exchange(frame_, std::move(frame))) {
      ++skipped_;
      ++place_.hall().traffic.frames_skipped;
    }
    pump();
  }
  void close() override {
    closing_ = true;
    pump();
  }
  [[nodiscard]] std::uint32_t skipped() const override { return skipped_; }

  void end() override {
    if (std::exchange(ended_, true)) return;
    texts_.clear();
    frame_.reset();
    if (const auto user = std::exchange(user_, nullptr); user && open_) user->closed();
    error_code ignored;
    beast::get_lowest_layer(socket_).socket().close(ignored);
  }

 private:
  void read() {
    socket_.async_read(incoming_, [self = this->shared_from_this()](error_code error, std::size_t) {
      if (error == websocket::error::message_too_big)
        log::warning("a browser at " + self->place_.address() + " sent a message over the limit and was closed");
      if (error || self->ended_) return self->end();
      self->take();
      self->incoming_.consume(self->incoming_.size());
      if (!self->ended_) self->read();
    });
  }
  void take() {
    if (closing_) return;
    if (!messages_.take(now())) {
      send_text("bye", std::make_shared<const std::string>(
                           R"({"type":"bye","reason":"too many messages","remedy":"reload the page"})"));
      return close();
    }
    const auto data = incoming_.cdata();
    if (socket_.got_text())
      user_->text({static_cast<const char*>(data.data()), data.size()});
    else
      user_->binary({static_cast<const std::byte*>(data.data()), data.size()});
  }
  /// Texts first; then the newest frame.
  void pump() {
    if (!open_ || ended_ || writing_) return;
    if (!texts_.empty()) {
      text_ = std::move(texts_.front().second);
      texts_.pop_front();
      socket_.text(true);
      return write(asio::buffer(*text_));
    }
    if (frame_ && !lags()) {
      sent_ = std::exchange(frame_, nullptr);
      header_ = frame_header(*sent_, skipped_, now());
      socket_.binary(true);
      return write(std::array<asio::const_buffer, 2>{asio::buffer(header_), asio::buffer(sent_->bytes)});
    }
    if (!closing_) return;
    writing_ = true;
    socket_.async_close(websocket::close_code::policy_error,
                        [self = this->shared_from_this()](error_code) { self->end(); });
  }
  /// Whether the browser has not taken much of what it was sent: the system would keep minutes of frames for it. The newest one waits for
  /// the next look, when another frame comes.
  [[nodiscard]] bool lags() {
    int unread_bytes = 0;
    const int fd = beast::get_lowest_layer(socket_).socket().native_handle();
    return ::ioctl(fd, SIOCOUTQ, &unread_bytes) == 0 && unread_bytes > kMostUnread_bytes;
  }
  template <class Buffers>
  void write(const Buffers& buffers) {
    writing_ = true;
    socket_.async_write(buffers, [self = this->shared_from_this()](error_code error, std::size_t) {
      self->writing_ = false;
      if (error) return self->end();
      self->pump();
    });
  }

  websocket::stream<Stream> socket_;
  WebPlace place_;
  std::shared_ptr<SocketUser> user_;
  http::request<http::string_body> request_;
  beast::flat_buffer incoming_;
  RateLimit messages_{100, 300};
  std::deque<std::pair<std::string, std::shared_ptr<const std::string>>> texts_;
  std::shared_ptr<const FrameBody> frame_;  // not sent yet
  std::shared_ptr<const std::string> text_;
  std::shared_ptr<const FrameBody> sent_;
  std::array<std::byte, kFrameHeader> header_{};
  std::uint32_t skipped_ = 0;
  bool open_ = false, writing_ = false, closing_ = false, ended_ = false;
};

HttpRequest::Method method_of(http::verb verb) {
  if (verb == http::verb::get) return HttpRequest::Method::get;
  if (verb == http::verb::head) return HttpRequest::Method::head;
  if (verb == http::verb::post) return HttpRequest::Method::post;
  return HttpRequest::Method::other;
}

bool asks_for_protocol(std::string_view header) {
  while (!header.empty()) {
    if (next_part(header, ',') == kProtocol) return true;
  }
  return false;
}

template <class Stream>
class HttpConnection : public std::enable_shared_from_this<HttpConnection<Stream>> {
  static constexpr bool kSecure = std::is_same_v<Stream, SecureStream>;

 public:
  HttpConnection(Stream stream, std::shared_ptr<WebHall> hall, std::string address)
      : stream_(std::move(stream)), hall_(hall), place_(WebPlace(std::move(hall), std::move(address))) {}

  void begin() {
    if constexpr (kSecure) {
      lowest().expires_after(kRequestWithin);
      stream_.async_handshake(asio::ssl::stream_base::server, [self = this->shared_from_this()](error_code error) {
        if (!error) self->read();
      });
    } else {
      read();
    }
  }

 private:
  [[nodiscard]] beast::tcp_stream& lowest() { return beast::get_lowest_layer(stream_); }

  void read() {
    parser_.emplace();
    parser_->header_limit(static_cast<std::uint32_t>(hall_->options.header_bytes));
    // None until it is known what the request is; Beast takes boost::none for a limit of nothing.
    parser_->body_limit(std::numeric_limits<std::uint64_t>::max());
    lowest().expires_after(kRequestWithin);
    http::async_read_header(stream_, buffer_, *parser_,
                            [self = this->shared_from_this()](error_code error, std::size_t) { self->headed(error); });
  }

  void headed(error_code error) {
    std::size_t more = 0;
    if (!error)
      if (const auto header = plain_request()) more = hall_->site->longest_body(*header);
    longest_body_ = more > 0 ? more : hall_->options.body_bytes;
    if (!error && parser_->content_length().value_or(0) > longest_body_) error = http::error::body_limit;
    if (error) return taken(error);
    parser_->body_limit(longest_body_);
    if (more > 0) lowest().expires_after(kUploadWithin);
    http::async_read(stream_, buffer_, *parser_,
                     [self = this->shared_from_this()](error_code failed, std::size_t) { self->taken(failed); });
  }

  void taken(error_code error) {
    if (error == http::error::header_limit)
      return write(refusal(431, "the request's header is too long", "reload the page"), true);
    if (error == http::error::body_limit)
      return write(refusal(413, "the request is too long", fmt::format("send less than {} KiB", longest_body_ >> 10U)),
                   true);
    if (error == http::error::end_of_stream) return finish();
    if (error.category() == make_error_code(http::error::bad_target).category())
      return write(refusal(400, "this is not an HTTP request: " + error.message(), "use a web browser"), true);
    if (error) return;  // gone, or too slow
    if (!hall_->requests.take(place_->address(), now()))
      return write(refusal(429, "too many requests", "wait a few seconds"), true);
    auto request = plain_request();
    if (!request) return write(refusal(request.error()), false);
    if (websocket::is_upgrade(parser_->get())) return join(*request);
    lowest().expires_never();
    hall_->site->answer(std::move(*request), [self = this->shared_from_this()](HttpAnswer answer) {
      self->write(std::move(answer), !self->parser_->get().keep_alive());
    });
  }

  /// Takes the body, as far as it has come.
  [[nodiscard]] Expected<HttpRequest> plain_request() {
    const auto& from = parser_->get();
    auto target = parse_target(std::string_view(from.target().data(), from.target().size()));
    if (!target) return tl::unexpected(target.error());
    HttpRequest request;
    request.method = method_of(from.method());
    request.path = std::move(target->path);
    request.query = std::move(target->query);
    for (const auto& field : from)
      request.headers.try_emplace(lower_case(std::string(field.name_string())), std::string(field.value()));
    request.body = std::move(parser_->get().body());
    request.address = place_->address();
    request.secure = kSecure;
    return request;
  }

  void join(const HttpRequest& request) {
    if (!asks_for_protocol(request.header("sec-websocket-protocol")))
      return write(refusal(400, "this WebSocket speaks only 'mechane.1'", "ask for that subprotocol"), true);
    auto user = hall_->site->join(request);
    if (auto* refused = std::get_if<HttpAnswer>(&user)) return write(std::move(*refused), true);
    auto socket = std::make_shared<SocketConnection<Stream>>(std::move(stream_), std::move(*place_),
                                                             std::get<std::shared_ptr<SocketUser>>(std::move(user)));
    place_.reset();
    socket->accept(parser_->release());
  }

  void write(HttpAnswer answer, bool close) {
    answer_ = std::move(answer);
    const auto& request = parser_->get();
    response_.emplace();
    response_->version(request.version() == 0 ? 11 : request.version());
    response_->result(answer_.status);
    response_->keep_alive(!close);
    response_->set(http::field::server, "mechane");
    if (answer_.status != 304) {
      response_->set(http::field::content_type, answer_.content_type);
      response_->content_length(answer_.size);
      if (request.method() != http::verb::head) response_->body() = {answer_.body->data() + answer_.from, answer_.size};
    }
    const std::string host(request[http::field::host]);
    for (const auto& [name, value] : security_headers(kSecure, host, answer_.framed, hall_->options.hand_program))
      response_->set(name, value);
    for (const auto& [name, value] : answer_.headers)
      response_->insert(name, value);
    lowest().expires_after(kAnswerWithin);
    http::async_write(stream_, *response_, [self = this->shared_from_this(), close](error_code error, std::size_t) {
      if (error) return;
      self->answer_ = {};
      if (close) return self->finish();
      self->read();
    });
  }

  void finish() {
    lowest().expires_after(kLingers);
    if constexpr (kSecure) {
      stream_.async_shutdown([self = this->shared_from_this()](error_code) {});
    } else if (hall_->refusals < kMostRefusals) {
      std::make_shared<Lingerer>(std::move(stream_), hall_)->linger();
    }
  }

  Stream stream_;
  std::shared_ptr<WebHall> hall_;
  std::optional<WebPlace> place_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  std::optional<http::response<http::span_body<const char>>> response_;
  HttpAnswer answer_;
  std::size_t longest_body_ = 0;  // of the request that is read
};

std::string busy_text() {
  const HttpAnswer answer = refusal(503, "the gateway has as many connections as it may have", "try again in a minute");
  return fmt::format(
      "HTTP/1.1 503 Service Unavailable\r\nContent-Type: application/json\r\nContent-Length: {}\r\nRetry-After: "
      "60\r\nConnection: close\r\n\r\n{}",
      answer.size, *answer.body);
}

class WebServerImpl final : public WebServer {
 public:
  explicit WebServerImpl(const WebServerOptions& options)
      : hall_(std::make_shared<WebHall>(options)), acceptor_(loop_), again_(loop_), signals_(loop_) {}

  [[nodiscard]] Expected<void> open() {
    const WebServerOptions& options = hall_->options;
    const std::string place = fmt::format("{}:{}", options.listen.address, options.listen.port);
    if (!options.certificate.empty()) {
      if (auto read = read_certificate(); !read) return read;
    }
    error_code error;
    const tcp::endpoint endpoint(asio::ip::make_address(options.listen.address), options.listen.port);
    acceptor_.open(endpoint.protocol(), error);
    if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(1024, error);
    if (error)
      return fail(ErrorCode::io_failure, "cannot listen: " + error.message(), place,
                  "choose another address or port with --listen, or end the program that uses it");
    return {};
  }

  void run(Site& site) override {
    hall_->site = &site;
    error_code ignored;
    signals_.add(SIGINT, ignored);
    signals_.add(SIGTERM, ignored);
    signals_.async_wait([this](error_code error, int) {
      if (!error) loop_.stop();
    });
    accept();
    loop_.run();
    // While the site is still there.
    const std::set<LiveSocket*> all = hall_->sockets;
    for (LiveSocket* socket : all)
      socket->end();
  }
  void stop() override { loop_.stop(); }
  [[nodiscard]] std::uint16_t port() const override {
    error_code ignored;
    return acceptor_.local_endpoint(ignored).port();
  }
  void post(std::function<void()> job) override { asio::post(loop_, std::move(job)); }
  void every(Duration period, std::function<void()> job) override {
    timers_.push_back(std::make_unique<Timer>(loop_, period, std::move(job)));
  }
  [[nodiscard]] Traffic traffic() const override { return hall_->traffic; }

 private:
  struct Timer {
    Timer(asio::io_context& loop, Duration every, std::function<void()> what)
        : timer(loop), period(every), job(std::move(what)) {
      wait();
    }
    void wait() {
      timer.expires_after(period);
      timer.async_wait([this](error_code error) {
        if (error) return;
        job();
        wait();
      });
    }
    asio::steady_timer timer;
    Duration period;
    std::function<void()> job;
  };

  [[nodiscard]] Expected<void> read_certificate() {
    const WebServerOptions& options = hall_->options;
    tls_.emplace(asio::ssl::context::tls_server);
    error_code error;
    SSL_CTX_set_min_proto_version(tls_->native_handle(), TLS1_2_VERSION);
    tls_->use_certificate_chain_file(options.certificate.string(), error);
    if (error)
      return fail(ErrorCode::damaged, "cannot be used as a certificate: " + error.message(),
                  options.certificate.string(), "give a PEM file with --tls-cert");
    tls_->use_private_key_file(options.key.string(), asio::ssl::context::pem, error);
    if (error)
      return fail(ErrorCode::damaged, "cannot be used as the certificate's key: " + error.message(),
                  options.key.string(), "give the key's PEM file with --tls-key");
    return {};
  }

  void accept() {
    acceptor_.async_accept([this](error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) {  // no descriptor is free: look again soon
        log::warning("a connection could not be taken: " + error.message());
        again_.expires_after(milliseconds(100));
        return again_.async_wait([this](error_code stopped) {
          if (!stopped) accept();
        });
      }
      take(std::move(socket));
      accept();
    });
  }

  void take(tcp::socket socket) {
    error_code error;
    const tcp::endpoint remote = socket.remote_endpoint(error);
    if (error) return;
    socket.set_option(tcp::no_delay(true), error);
    const std::string address = remote.address().to_string();
    const auto known = hall_->by_address.find(address);
    const std::size_t of_address = known == hall_->by_address.end() ? 0 : known->second;
    if (hall_->traffic.connections >= hall_->options.most_sockets || of_address >= hall_->options.most_of_address)
      return refuse(std::move(socket), address);
    if (tls_)
      return std::make_shared<HttpConnection<SecureStream>>(SecureStream(std::move(socket), *tls_), hall_, address)
          ->begin();
    std::make_shared<HttpConnection<PlainStream>>(PlainStream(std::move(socket)), hall_, address)->begin();
  }

  /// Over TLS, telling why would take a handshake: the connection is closed.
  void refuse(tcp::socket socket, const std::string& address) {
    ++hall_->traffic.refused;
    if (refusal_warnings_.take(now())) log::warning("connections from " + address + " are refused: too many are open");
    if (tls_) return;
    if (hall_->refusals >= kMostRefusals) return tell_and_close(std::move(socket));
    std::make_shared<Lingerer>(PlainStream(std::move(socket)), hall_)->say(busy_text());
  }

  /// Without waiting until it is read. What has come already is taken: the system would cut off the answer for it.
  static void tell_and_close(tcp::socket socket) {
    error_code ignored;
    std::array<char, 1024> asked{};
    socket.non_blocking(true, ignored);
    socket.read_some(asio::buffer(asked), ignored);
    socket.write_some(asio::buffer(busy_text()), ignored);
    socket.shutdown(tcp::socket::shutdown_send, ignored);
  }

  std::shared_ptr<WebHall> hall_;
  asio::io_context loop_{1};
  std::optional<asio::ssl::context> tls_;
  RateLimit refusal_warnings_{1, 5};  // a flood of connections is not to fill the disk
  tcp::acceptor acceptor_;
  asio::steady_timer again_;
  asio::signal_set signals_;
  std::vector<std::unique_ptr<Timer>> timers_;
};

}  // namespace

Expected<ListenAddress> parse_listen_address(const std::string& text) {
  const auto wrong = [&] {
    return fail(ErrorCode::invalid_value, "'" + text + "' is not an address to listen at", "--listen",
                "write --listen 127.0.0.1:8480, or 0.0.0.0:8480 for all of this machine's networks");
  };
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos) return wrong();
  std::string host = text.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  if (host == "localhost") host = "127.0.0.1";
  const std::string digits = text.substr(colon + 1);
  if (digits.empty() || digits.size() > 5 || !std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; }))
    return wrong();
  const unsigned long port = std::stoul(digits);
  error_code error;
  const asio::ip::address address = asio::ip::make_address(host, error);
  if (error || port > 65535) return wrong();
  return ListenAddress{address.to_string(), static_cast<std::uint16_t>(port), address.is_loopback()};
}

Expected<std::unique_ptr<WebServer>> WebServer::open(const WebServerOptions& options) {
  auto server = std::make_unique<WebServerImpl>(options);
  if (auto opened = server->open(); !opened) return tl::unexpected(opened.error());
  return server;
}

}  // namespace mechane::gateway
