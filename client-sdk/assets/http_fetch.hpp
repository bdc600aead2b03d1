// Files over HTTP, several at a time, within limits of time and size. Knows nothing of assets.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "server/base/error.hpp"

namespace mechane::assets {

struct HttpLimits {
  std::chrono::milliseconds connect{5'000};
  std::chrono::seconds stall{15};            ///< a transfer that is slower than 1000 bytes/s for so long is given up
  std::chrono::milliseconds whole{600'000};  ///< for one file
  std::uint64_t bytes = 256ULL << 20U;       ///< of one file
  long redirects = 3;
  std::size_t at_once = 4;   ///< the others wait
  bool secure_only = false;  ///< redirects to plain http are refused
};

/// `etag` and `modified` are from an earlier answer of the server; where they are not empty, it may answer 304.
struct HttpRequest {
  std::uint64_t id = 0;
  std::string address;
  std::string etag;
  std::string modified;
};

struct HttpAnswer {
  std::uint64_t id = 0;
  std::string problem;                     ///< for people; empty: the whole answer arrived, with `status`
  ErrorCode code = ErrorCode::io_failure;  ///< of the problem
  long status = 0;
  std::vector<std::byte> bytes;
  std::string etag;
  std::string modified;
};

/// All on one thread, except wake().
class HttpFetcher {
 public:
  /// Errors: the library has no memory or no TLS.
  [[nodiscard]] static Expected<std::unique_ptr<HttpFetcher>> create(const HttpLimits& limits);
  ~HttpFetcher();
  HttpFetcher(const HttpFetcher&) = delete;
  HttpFetcher& operator=(const HttpFetcher&) = delete;

  /// Begins a request; wait() returns its answer.
  void start(HttpRequest request);
  /// Transfers bytes until an answer is complete, wake() is called, or `at_most` has passed.
  [[nodiscard]] std::vector<HttpAnswer> wait(std::chrono::milliseconds at_most);
  /// Makes wait() return soon. Any thread.
  void wake();

 private:
  struct Impl;
  explicit HttpFetcher(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace mechane::assets
