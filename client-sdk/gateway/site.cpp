#include "client-sdk/gateway/site.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "client-sdk/gateway/http/security_headers.hpp"
#include "client-sdk/gateway/operator_api.hpp"
#include "client-sdk/gateway/sign_in/secrets.hpp"
#include "client-sdk/gateway/studio_api.hpp"
#include "client-sdk/studio/draft/preview_file.hpp"
#include "server/base/program_folder.hpp"
#include "server/log/log.hpp"
#include <mechane/proto/identity.hpp>
#include <mechane/proto/names.hpp>

namespace mechane::gateway {
namespace {

using SiteJson = nlohmann::json;
using Method = HttpRequest::Method;

constexpr std::size_t kMostHubs = 32;
constexpr std::size_t kMostWaiting = 64;
constexpr Duration kHubStays = std::chrono::seconds(10);
constexpr Duration kLookAgain = std::chrono::milliseconds(20);
constexpr Duration kTellCodes = std::chrono::seconds(15);  // displays that have just started wait so long

HttpAnswer nothing_here() {
  return refusal(404, "there is nothing at this address", "go to /console, or scan a kiosk's code");
}

HttpAnswer not_signed_in() {
  return refusal(401, "nobody is signed in", "sign in at /console");
}

HttpAnswer no_way_in() {
  return refusal(403, "this address does not open anything, or not any more",
                 "scan the kiosk's code again, or ask the museum's staff");
}

/// For whoever scans a kiosk's code meanwhile; the page comes back by itself.
HttpAnswer maintenance_page() {
  HttpAnswer answer = fresh_answer(
      "<!doctype html><html lang=\"el\"><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">"
      "<title>Mechane</title><h1>Υπό συντήρηση</h1><p>Αυτό το έκθεμα συντηρείται. Παρακαλούμε ελάτε ξανά αργότερα.</p>"
      "<div lang=\"en\"><h1>Under maintenance</h1><p>This exhibit is being looked after. Please come back "
      "later.</p></div>",
      "text/html; charset=utf-8", 503);
  answer.headers.emplace_back("Refresh", "30");
  return answer;
}

/// What stands behind a prefix of a path; none: the path begins otherwise.
std::optional<std::string> after(const std::string& path, std::string_view prefix) {
  if (!path.starts_with(prefix)) return std::nullopt;
  return path.substr(prefix.size());
}

SiteJson of_session(const Session& session) {
  return {{"user", session.user}, {"role", word_of(session.role)}, {"csrf", session.csrf}};
}

}  // namespace

GatewaySite::GatewaySite(const GatewayOptions& options, WebServer& server, Accounts accounts, Operations operations,
                         std::shared_ptr<client::DisplaySeats> seats, client::DisplayWatch& watch,
                         client::ExhibitWatch& exhibits)
    : options_(options),
      server_(server),
      watch_(watch),
      exhibits_(exhibits),
      accounts_(std::move(accounts)),
      operations_(std::move(operations)),
      tokens_(options.token_idle),
      audit_(options.state),
      visits_(options.records, options.state, [&server](std::function<void()> job) { server.post(std::move(job)); }),
      studio_(options.scenarios, options.state, [&server](std::function<void()> job) { server.post(std::move(job)); }),
      backstage_{options.domain,
                 slow_,
                 [&server](std::function<void()> job) { server.post(std::move(job)); },
                 std::move(seats),
                 content_,
                 tokens_,
                 {!options.hand_model.empty(), options.web.hand_program}},
      previews_({program_folder() / "mechane-server", program_folder() / "mechane-visitor", options.scenarios,
                 [this](const auto& file) { remove_preview(file); }},
                backstage_) {}

GatewaySite::~GatewaySite() {
  waiting_.clear();  // these hold hubs, too
  hubs_.clear();     // while the slow thread is there
  playbacks_ = {};
}

const Session* GatewaySite::session_of(const HttpRequest& request) {
  const std::string cookie = session_cookie(request.header("cookie"));
  return cookie.empty() ? nullptr : sessions_.find(cookie, time_now());
}

bool GatewaySite::may_read(const HttpRequest& request) {
  return tokens_.opens_any(request.query_value("token"), time_now()) || session_of(request) != nullptr;
}

void GatewaySite::answer(HttpRequest request, Done done) {
  if (request.method == Method::post) return answer_post(request, done);
  if (request.method == Method::other) return done(refusal(405, "this method is not served", "use GET, HEAD or POST"));
  answer_get(request, done);
}

std::size_t GatewaySite::longest_body(const HttpRequest& header) {
  const std::size_t longest = header.method == Method::post ? longest_studio_upload(header.path) : 0;
  const Session* session = longest > 0 ? session_of(header) : nullptr;
  return session != nullptr && session->role != Role::visitor ? longest : 0;
}

void GatewaySite::answer_get(const HttpRequest& request, const Done& done) {
  if (request.path.starts_with("/api/")) {
    const Session* session = session_of(request);
    if (session == nullptr) return done(not_signed_in());
    if (request.path == "/api/me") return done(answer_with(of_session(*session).dump(), "application/json"));
    if (!answer_api_get(*this, *session, request, done)) done(nothing_here());
    return;
  }
  if (const auto hash = after(request.path, "/content/")) return serve_content(request, *hash, done);
  if (request.path == "/hand-model") return serve_hand_model(request, done);
  if (const auto rest = after(request.path, "/exhibit/")) return serve_exhibit(request, *rest, done);
  if (request.path == "/app/sw.js")  // the app's service worker, for all pages
    return serve_file(request, {options_.app, "sw.js"}, [done](HttpAnswer answer) {
      answer.headers.emplace_back("Service-Worker-Allowed", "/");
      done(std::move(answer));
    });
  if (const auto file = after(request.path, "/app/"))
    return serve_file(request, {options_.app, *file, "", file->starts_with("assets/")}, done);
  const bool page = request.path == "/" || request.path == "/console" || request.path.starts_with("/console/") ||
                    request.path == "/studio" || request.path.starts_with("/studio/") ||
                    request.path.starts_with("/kiosk/") || request.path.starts_with("/playback/");
  if (!page) return done(nothing_here());
  if (const auto kiosk = after(request.path, "/kiosk/");
      kiosk && session_of(request) == nullptr && in_maintenance(operations_.state(), *kiosk, wall_now()))
    return done(maintenance_page());
  std::error_code unknown;
  if (!std::filesystem::exists(options_.app / "index.html", unknown))
    return done(refusal(503, "the web app is not built", "build it, or name its folder with --app"));
  serve_file(request, {options_.app, "index.html"}, [done, framed = is_framed(request)](HttpAnswer answer) {
    answer.framed = framed;
    done(std::move(answer));
  });
}

bool GatewaySite::is_framed(const HttpRequest& request) {
  const auto kiosk = after(request.path, "/kiosk/");
  return kiosk && previews_.hub_of(*kiosk) != nullptr &&
         tokens_.opens(request.query_value("token"), *kiosk, time_now());
}

/// Where the studio's thread is too busy, at once.
void GatewaySite::remove_preview(const std::filesystem::path& file) {
  const auto remove = [file](studio::Shelf&) {
    studio::remove_preview(file);
    return fresh_answer("{}");
  };
  studio_.give(remove, [file](const HttpAnswer& answer) {
    if (answer.status != 200) studio::remove_preview(file);
  });
}

void GatewaySite::on_disk(std::function<HttpAnswer()> work, Done done) {
  if (disk_waiting_ >= kMostWaiting)
    return done(refusal(503, "the gateway is busy reading files", "try again in a moment"));
  ++disk_waiting_;
  disk_.give([this, work = std::move(work), done = std::move(done)] {
    server_.post([this, done, answer = work()] {
      --disk_waiting_;
      done(answer);
    });
  });
}

void GatewaySite::serve_file(const HttpRequest& request, FileWanted wanted, const Done& done) {
  wanted.if_none_match = request.header("if-none-match");
  wanted.range = request.header("range");
  wanted.if_range = request.header("if-range");
  on_disk([this, wanted = std::move(wanted)] { return files_.answer(wanted); }, done);
}

void GatewaySite::serve_content(const HttpRequest& request, const std::string& hash, const Done& done) {
  if (!may_read(request)) return done(no_way_in());
  const auto mesh = content_.mesh(hash);
  if (!mesh)
    return done(refusal(404, "this gateway knows no mesh with this hash", "open the exhibit at a kiosk first"));
  serve_file(request, {mesh->folder, mesh->path, hash, true}, done);
}

void GatewaySite::serve_exhibit(const HttpRequest& request, const std::string& rest, const Done& done) {
  if (!may_read(request)) return done(no_way_in());
  const std::size_t slash = std::min(rest.find('/'), rest.size());
  const auto folder = content_.exhibit(rest.substr(0, slash));
  if (!folder || slash == rest.size())
    return done(refusal(404, "this gateway knows no such exhibit", "open the exhibit at a kiosk first"));
  serve_file(request, {*folder, rest.substr(slash + 1)}, done);
}

void GatewaySite::serve_hand_model(const HttpRequest& request, const Done& done) {
  if (!may_read(request)) return done(no_way_in());
  if (options_.hand_model.empty())
    return done(refusal(404, "the camera hand is off: this gateway has no model of hands",
                        "start the gateway with --hand-model FILE"));
  serve_file(request, {options_.hand_model.parent_path(), options_.hand_model.filename().string()}, done);
}

void GatewaySite::answer_post(const HttpRequest& request, const Done& done) {
  if (!is_own_origin(request.header("origin"), request.header("host"), request.secure))
    return done(refusal(403, "this request comes from another page", "use the gateway's own pages"));
  const bool upload = longest_studio_upload(request.path) > 0;
  if (!request.header("content-type").starts_with(upload ? "application/octet-stream" : "application/json"))
    return done(upload ? refusal(415, "this request is not a file's bytes", "send application/octet-stream")
                       : refusal(415, "this request is not JSON", "send application/json"));
  if (request.path == "/api/sign-in") return sign_in(request, done);
  const Session* session = session_of(request);
  if (session == nullptr) return done(not_signed_in());
  if (!same_secret(request.header("x-mechane-csrf"), session->csrf))
    return done(refusal(403, "the header X-Mechane-CSRF is missing or wrong", "reload the page"));
  if (request.path == "/api/sign-out") {
    sessions_.end(session_cookie(request.header("cookie")));
    HttpAnswer answer = answer_with("{}", "application/json");
    answer.headers.emplace_back("Set-Cookie", set_session_cookie("", request.secure));
    return done(std::move(answer));
  }
  if (!answer_api_post(*this, *session, request, done)) done(nothing_here());
}

bool GatewaySite::on_passwords(std::function<std::function<void()>()> work) {
  constexpr std::size_t kMostPasswords = 8;
  if (passwords_waiting_ >= kMostPasswords) return false;
  ++passwords_waiting_;
  password_thread_.give([this, work = std::move(work)] {
    server_.post([this, then = work()] {
      --passwords_waiting_;
      then();
    });
  });
  return true;
}

void GatewaySite::sign_in(const HttpRequest& request, const Done& done) {
  const SiteJson json = SiteJson::parse(request.body, nullptr, false);
  const bool right = json.is_object() && json.contains("user") && json["user"].is_string() &&
                     json.contains("password") && json["password"].is_string();
  if (!right) return done(refusal(400, "a user and a password are needed", "fill in both fields"));
  const std::string user = json["user"], password = json["password"];
  const std::string of_user = "user " + user.substr(0, 31), of_address = "address " + request.address;
  const auto wait = std::max(guard_.wait_of(of_user, time_now()), guard_.wait_of(of_address, time_now()));
  if (wait) {
    const auto seconds = static_cast<int>(to_seconds(*wait)) + 1;
    HttpAnswer answer = refusal(429, "too many failed sign-ins", fmt::format("try again in {} s", seconds));
    answer.headers.emplace_back("Retry-After", std::to_string(seconds));
    return done(std::move(answer));
  }
  const Account* account = accounts_.find(user);
  // An unknown user takes as long as a known one.
  static const std::string kNobody =
      "$argon2id$v=19$m=65536,t=2,p=1$AAAAAAAAAAAAAAAAAAAAAA$AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA";
  const std::string hash = account != nullptr ? account->password_hash : kNobody;
  const Role role = account != nullptr ? account->role : Role::visitor;
  const bool known = account != nullptr;
  const bool given = on_passwords([=, this]() -> std::function<void()> {
    const bool fits = is_password(hash, password) && known;
    return [=, this] {
      if (fits) {
        guard_.succeeded(of_user);
        guard_.succeeded(of_address);
        return signed_in(request, user, role, done);
      }
      guard_.failed(of_user, time_now());
      guard_.failed(of_address, time_now());
      (void)audit_.add(user.substr(0, 31), request.address, "sign-in failed", "");
      done(refusal(401, "user or password is wrong", "check both; an operator can give a new password"));
    };
  });
  if (!given) done(refusal(503, "too many sign-ins at a time", "try again in a few seconds"));
}

void GatewaySite::signed_in(const HttpRequest& request, const std::string& user, Role role, const Done& done) {
  const std::string cookie = sessions_.begin(user, role, time_now());
  const Session* session = sessions_.find(cookie, time_now());
  if (!note(*session, request, "sign-in", "")) {
    sessions_.end(cookie);
    return done(refusal(500, "the audit log cannot be written", "see the gateway's log"));
  }
  HttpAnswer answer = fresh_answer(of_session(*session).dump());
  answer.headers.emplace_back("Set-Cookie", set_session_cookie(cookie, request.secure));
  done(std::move(answer));
}

bool GatewaySite::note(const Session& session, const HttpRequest& request, std::string_view action,
                       std::string_view detail) {
  const auto written = audit_.add(session.user, request.address, action, detail);
  if (!written) log::error(written.error());
  return written.has_value();
}

void GatewaySite::note_own(std::string_view action, std::string_view detail) {
  if (auto written = audit_.add("gateway", "", action, detail); !written) log::error(written.error());
}

std::variant<HttpAnswer, std::shared_ptr<SocketUser>> GatewaySite::join(const HttpRequest& request) {
  if (!is_own_origin(request.header("origin"), request.header("host"), request.secure))
    return refusal(403, "this WebSocket comes from another page", "use the gateway's own pages");
  const auto kiosk = after(request.path, "/ws/kiosk/");
  if (!kiosk) return nothing_here();
  if (auto named = proto::check_name(*kiosk, "kiosk"); !named) return refusal(named.error());
  const std::string token = request.query_value("token");
  const bool by_token = tokens_.opens(token, *kiosk, time_now());
  if (!by_token && session_of(request) == nullptr) return no_way_in();
  if (!by_token && !knows_kiosk(*kiosk)) return refusal(404, "there is no kiosk of this name", "see /console");
  // A tablet that is signed in shows the sign; nobody else comes in meanwhile.
  if (by_token && session_of(request) == nullptr && in_maintenance(operations_.state(), *kiosk, wall_now()))
    return refusal(503, "this kiosk is under maintenance", "come back later");
  const auto preview = previews_.hub_of(*kiosk);
  const auto hub = preview ? preview : hub_of(*kiosk);
  if (!hub) return refusal(503, "too many kiosks are in use", "try again later");
  if (by_token) tokens_.use(token, time_now());
  return std::static_pointer_cast<SocketUser>(std::make_shared<Browser>(hub, by_token ? token : std::string()));
}

std::vector<std::string> GatewaySite::kiosks() {
  std::vector<std::string> all = options_.kiosks;
  for (const client::DisplayStatus& display : watch_.displays())
    all.push_back(display.kiosk);
  for (const client::KioskDevice& device : watch_.devices())
    all.push_back(device.kiosk);
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

bool GatewaySite::knows_kiosk(const std::string& kiosk) {
  return std::ranges::count(kiosks(), kiosk) > 0;
}

std::shared_ptr<KioskHub> GatewaySite::hub_of(const std::string& kiosk) {
  if (const auto known = hubs_.find(kiosk); known != hubs_.end()) {
    known->second->use(time_now());
    return known->second;
  }
  if (hubs_.size() >= kMostHubs) return nullptr;
  const auto hub = std::make_shared<KioskHub>(kiosk, backstage_);
  hub->use(time_now());
  hub->open();
  hubs_[kiosk] = hub;
  return hub;
}

std::string GatewaySite::address_of(const std::string& kiosk, const std::string& origin) {
  return origin + "/kiosk/" + kiosk + "?token=" + tokens_.token_for(kiosk, time_now());
}

void GatewaySite::wait_for(std::function<std::optional<HttpAnswer>()> look, Duration longest, HttpAnswer late,
                           Done done) {
  if (waiting_.size() >= kMostWaiting)
    return done(refusal(503, "too many requests are waiting", "try again in a moment"));
  waiting_.push_back({std::move(look), time_now() + longest, std::move(late), std::move(done)});
}

/// Native displays forget a code that is not told again for a minute; none is shown of a gateway that has ended. This
/// gateway's browsers are told nothing.
void GatewaySite::tell_codes() {
  for (const client::DisplayStatus& display : watch_.displays()) {
    if (display.process_id == static_cast<std::uint32_t>(::getpid()) && display.host == proto::host_name()) continue;
    const std::vector<client::DisplaySetting> code{{"phone-address", options_.phones},
                                                   {"phone-code", tokens_.token_for(display.kiosk, time_now())}};
    if (auto told = watch_.request(display.kiosk, display.display, {.settings = code}); !told)
      log::warning(told.error().to_string());
  }
}

void GatewaySite::tick() {
  const TimePoint now = time_now();
  if (!options_.phones.empty() && now >= next_codes_) {
    next_codes_ = now + std::min<Duration>(kTellCodes, options_.token_idle / 2);
    tell_codes();
  }
  for (const auto& [kiosk, hub] : hubs_)
    hub->tick(now);
  playbacks_.tick(now);
  previews_.tick(now);
  if (now < next_look_) return;
  next_look_ = now + kLookAgain;
  keeper_.tick(*this, wall_now(), now);
  std::erase_if(hubs_, [now](const auto& entry) { return now - entry.second->used() > kHubStays; });
  for (std::size_t count = waiting_.size(); count > 0; --count) {
    Waiting one = std::move(waiting_.front());
    waiting_.pop_front();
    if (auto answer = one.look()) {
      one.done(std::move(*answer));
    } else if (now >= one.until) {
      one.done(std::move(one.late));
    } else {
      waiting_.push_back(std::move(one));
    }
  }
}

}  // namespace mechane::gateway
