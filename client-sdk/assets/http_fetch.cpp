#include "client-sdk/assets/http_fetch.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <new>
#include <utility>

#include <curl/curl.h>
#include <fmt/format.h>

#include "server/base/assert.hpp"

namespace mechane::assets {
namespace {

constexpr long kStallBytesPerSecond = 1000;

struct MultiFree {
  void operator()(CURLM* multi) const { curl_multi_cleanup(multi); }
};
struct EasyFree {
  void operator()(CURL* easy) const { curl_easy_cleanup(easy); }
};
struct HeadersFree {
  void operator()(curl_slist* list) const { curl_slist_free_all(list); }
};
using Easy = std::unique_ptr<CURL, EasyFree>;
using Headers = std::unique_ptr<curl_slist, HeadersFree>;

/// One file on its way.
struct Transfer {
  Easy easy;
  Headers headers;
  HttpAnswer answer;
  std::uint64_t limit = 0;
  bool too_big = false;
  std::array<char, CURL_ERROR_SIZE> words{};
};

std::size_t take_bytes(char* data, std::size_t one, std::size_t count, void* to) {
  auto& transfer = *static_cast<Transfer*>(to);
  const std::size_t size = one * count;
  if (transfer.answer.bytes.size() + size > transfer.limit) {
    transfer.too_big = true;
    return 0;
  }
  const auto* bytes = reinterpret_cast<const std::byte*>(data);
  try {
    transfer.answer.bytes.insert(transfer.answer.bytes.end(), bytes, bytes + size);
  } catch (const std::bad_alloc&) {
    return 0;
  }
  return size;
}

/// Whether a server's text may be sent back to it in a header: it must be one line of plain text.
bool fits_header(const std::string& text) {
  return !text.empty() && text.size() < 512 && std::ranges::all_of(text, [](char c) { return c >= 0x20 && c < 0x7f; });
}

std::string header_of(CURL* easy, const char* name) {
  curl_header* header = nullptr;
  if (curl_easy_header(easy, name, 0, CURLH_HEADER, -1, &header) != CURLHE_OK) return {};
  std::string value = header->value;
  return fits_header(value) ? value : std::string();
}

Headers conditions(const HttpRequest& request) {
  curl_slist* list = nullptr;
  if (fits_header(request.etag)) list = curl_slist_append(list, ("If-None-Match: " + request.etag).c_str());
  if (fits_header(request.modified)) list = curl_slist_append(list, ("If-Modified-Since: " + request.modified).c_str());
  return Headers(list);
}

void note_problem(Transfer& transfer, CURLcode code) {
  if (code == CURLE_OK) return;
  HttpAnswer& answer = transfer.answer;
  if (transfer.too_big || code == CURLE_FILESIZE_EXCEEDED) {
    answer.code = ErrorCode::too_large;
    answer.problem = fmt::format("the file is larger than {} bytes", transfer.limit);
  } else if (code == CURLE_OPERATION_TIMEDOUT) {
    answer.code = ErrorCode::timed_out;
    answer.problem = "the server takes too long";
  } else if (code == CURLE_TOO_MANY_REDIRECTS) {
    answer.problem = "the server redirects too often";
  } else {
    answer.problem = transfer.words.front() != '\0' ? transfer.words.data() : curl_easy_strerror(code);
  }
}

}  // namespace

struct HttpFetcher::Impl {
  HttpLimits limits;
  std::map<CURL*, std::unique_ptr<Transfer>> transfers;
  std::unique_ptr<CURLM, MultiFree> multi;
  std::deque<HttpRequest> waiting;  ///< more than `at_once`
  std::vector<HttpAnswer> refused;  ///< of requests that could not begin

  void begin(const HttpRequest& request);
  std::vector<HttpAnswer> move_on();
  void prepare(Transfer& transfer, const HttpRequest& request) const;
  void collect(std::vector<HttpAnswer>& into);
};

void HttpFetcher::Impl::prepare(Transfer& transfer, const HttpRequest& request) const {
  CURL* easy = transfer.easy.get();
  const char* onward = limits.secure_only ? "https" : "http,https";
  curl_easy_setopt(easy, CURLOPT_URL, request.address.c_str());
  curl_easy_setopt(easy, CURLOPT_PATH_AS_IS, 1L);
  curl_easy_setopt(easy, CURLOPT_PROTOCOLS_STR, "http,https");
  curl_easy_setopt(easy, CURLOPT_REDIR_PROTOCOLS_STR, onward);
  curl_easy_setopt(easy, CURLOPT_FOLLOWLOCATION, 1L);
  curl_easy_setopt(easy, CURLOPT_MAXREDIRS, limits.redirects);
  curl_easy_setopt(easy, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(easy, CURLOPT_QUICK_EXIT, 1L);  // do not wait for a name server at the end
  curl_easy_setopt(easy, CURLOPT_CONNECTTIMEOUT_MS, static_cast<long>(limits.connect.count()));
  curl_easy_setopt(easy, CURLOPT_TIMEOUT_MS, static_cast<long>(limits.whole.count()));
  curl_easy_setopt(easy, CURLOPT_LOW_SPEED_LIMIT, kStallBytesPerSecond);
  curl_easy_setopt(easy, CURLOPT_LOW_SPEED_TIME, static_cast<long>(limits.stall.count()));
  curl_easy_setopt(easy, CURLOPT_MAXFILESIZE_LARGE, static_cast<curl_off_t>(limits.bytes));
  curl_easy_setopt(easy, CURLOPT_USERAGENT, "mechane-display");
  curl_easy_setopt(easy, CURLOPT_ERRORBUFFER, transfer.words.data());
  curl_easy_setopt(easy, CURLOPT_WRITEFUNCTION, take_bytes);
  curl_easy_setopt(easy, CURLOPT_WRITEDATA, &transfer);
  if (transfer.headers) curl_easy_setopt(easy, CURLOPT_HTTPHEADER, transfer.headers.get());
}

void HttpFetcher::Impl::collect(std::vector<HttpAnswer>& into) {
  int left = 0;
  while (const CURLMsg* message = curl_multi_info_read(multi.get(), &left)) {
    if (message->msg != CURLMSG_DONE) continue;
    CURL* easy = message->easy_handle;
    const CURLcode code = message->data.result;
    const auto found = transfers.find(easy);
    MECHANE_ASSERT(found != transfers.end());
    Transfer& transfer = *found->second;
    note_problem(transfer, code);
    curl_easy_getinfo(easy, CURLINFO_RESPONSE_CODE, &transfer.answer.status);
    transfer.answer.etag = header_of(easy, "ETag");
    transfer.answer.modified = header_of(easy, "Last-Modified");
    into.push_back(std::move(transfer.answer));
    curl_multi_remove_handle(multi.get(), easy);
    transfers.erase(found);
  }
}

HttpFetcher::HttpFetcher(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

HttpFetcher::~HttpFetcher() {
  for (const auto& [easy, transfer] : impl_->transfers)
    curl_multi_remove_handle(impl_->multi.get(), easy);
}

Expected<std::unique_ptr<HttpFetcher>> HttpFetcher::create(const HttpLimits& limits) {
  // The library requires this once per process, before any other call.
  static const CURLcode begun = curl_global_init(CURL_GLOBAL_DEFAULT);
  auto impl = std::make_unique<Impl>();
  impl->limits = limits;
  if (begun == CURLE_OK) impl->multi.reset(curl_multi_init());
  if (!impl->multi)
    return fail(ErrorCode::not_supported, "files cannot be fetched: libcurl does not start", "http",
                "install libcurl4 and ca-certificates");
  return std::unique_ptr<HttpFetcher>(new HttpFetcher(std::move(impl)));
}

void HttpFetcher::Impl::begin(const HttpRequest& request) {
  auto transfer = std::make_unique<Transfer>();
  transfer->answer.id = request.id;
  transfer->limit = limits.bytes;
  transfer->easy.reset(curl_easy_init());
  transfer->headers = conditions(request);
  CURL* easy = transfer->easy.get();
  if (easy != nullptr) prepare(*transfer, request);
  if (easy == nullptr || curl_multi_add_handle(multi.get(), easy) != CURLM_OK) {
    transfer->answer.code = ErrorCode::too_large;
    transfer->answer.problem = "not enough memory for a connection";
    refused.push_back(std::move(transfer->answer));
    return;
  }
  transfers.emplace(easy, std::move(transfer));
}

std::vector<HttpAnswer> HttpFetcher::Impl::move_on() {
  for (; !waiting.empty() && transfers.size() < limits.at_once; waiting.pop_front())
    begin(waiting.front());
  int running = 0;
  curl_multi_perform(multi.get(), &running);
  std::vector<HttpAnswer> answers = std::exchange(refused, {});
  collect(answers);
  return answers;
}

void HttpFetcher::start(HttpRequest request) {
  impl_->waiting.push_back(std::move(request));
}

std::vector<HttpAnswer> HttpFetcher::wait(std::chrono::milliseconds at_most) {
  if (auto answers = impl_->move_on(); !answers.empty()) return answers;
  curl_multi_poll(impl_->multi.get(), nullptr, 0, static_cast<int>(at_most.count()), nullptr);
  return impl_->move_on();
}

void HttpFetcher::wake() {
  curl_multi_wakeup(impl_->multi.get());
}

}  // namespace mechane::assets
