// What the gateway's addresses mean: pages, meshes, exhibits' files, signing in, kiosks' sockets; the operator's API is in
// operator_api.hpp. On the loop's thread; what waits for a disk or a network is done elsewhere.
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "client-sdk/gateway/browsers/kiosk_hub.hpp"
#include "client-sdk/gateway/drafts/preview_desk.hpp"
#include "client-sdk/gateway/drafts/studio_desk.hpp"
#include "client-sdk/gateway/file_store.hpp"
#include "client-sdk/gateway/gateway.hpp"
#include "client-sdk/gateway/kiosk_keeper.hpp"
#include "client-sdk/gateway/operations/operations.hpp"
#include "client-sdk/gateway/operations/visits_desk.hpp"
#include "client-sdk/gateway/playback.hpp"
#include "client-sdk/gateway/sign_in/accounts.hpp"
#include "client-sdk/gateway/sign_in/audit_log.hpp"
#include "client-sdk/gateway/sign_in/sessions.hpp"
#include <mechane/client/exhibits.hpp>

namespace mechane::gateway {

class GatewaySite final : public Site {
 public:
  GatewaySite(const GatewayOptions& options, WebServer& server, Accounts accounts, Operations operations,
              std::shared_ptr<client::DisplaySeats> seats, client::DisplayWatch& watch, client::ExhibitWatch& exhibits);
  ~GatewaySite() override;

  void answer(HttpRequest request, Done done) override;
  [[nodiscard]] std::size_t longest_body(const HttpRequest& header) override;
  [[nodiscard]] std::variant<HttpAnswer, std::shared_ptr<SocketUser>> join(const HttpRequest& request) override;
  /// Call it two hundred times a second.
  void tick();

  // For the API.

  /// Those of the options, and those with a display that runs.
  [[nodiscard]] std::vector<std::string> kiosks();
  [[nodiscard]] bool knows_kiosk(const std::string& kiosk);
  /// Opened where it is not in use; null: there are too many.
  [[nodiscard]] std::shared_ptr<KioskHub> hub_of(const std::string& kiosk);
  [[nodiscard]] const std::map<std::string, std::shared_ptr<KioskHub>>& hubs() const { return hubs_; }
  /// "http://127.0.0.1:8480/kiosk/kiosk-1?token=...", where `origin` is its first part.
  [[nodiscard]] std::string address_of(const std::string& kiosk, const std::string& origin);
  [[nodiscard]] client::DisplayWatch& watch() { return watch_; }
  [[nodiscard]] client::ExhibitWatch& exhibits() { return exhibits_; }
  [[nodiscard]] const GatewayOptions& options() const { return options_; }
  [[nodiscard]] const AuditLog& audit() const { return audit_; }
  [[nodiscard]] WebServer::Traffic traffic() const { return server_.traffic(); }
  /// Asks again and again, fifty times a second, until there is an answer; at the end of the time, `late` is the answer.
  void wait_for(std::function<std::optional<HttpAnswer>()> look, Duration longest, HttpAnswer late, Done done);
  /// Does slow work on the disk's thread.
  void on_disk(std::function<HttpAnswer()> work, Done done);
  /// Writes the audit log. False, after telling it in the log: it cannot be written, so that nothing may be done.
  [[nodiscard]] bool note(const Session& session, const HttpRequest& request, std::string_view action,
                          std::string_view detail);
  /// The same for what the gateway does by itself, as operators have ordered it.
  void note_own(std::string_view action, std::string_view detail);
  [[nodiscard]] Accounts& accounts() { return accounts_; }
  [[nodiscard]] Operations& operations() { return operations_; }
  [[nodiscard]] Sessions& sessions() { return sessions_; }
  [[nodiscard]] VisitsDesk& visits() { return visits_; }
  [[nodiscard]] StudioDesk& studio() { return studio_; }
  [[nodiscard]] PlaybackShelf& playbacks() { return playbacks_; }
  [[nodiscard]] PreviewDesk& previews() { return previews_; }
  [[nodiscard]] const Backstage& backstage() const { return backstage_; }
  /// Hashes or checks a password on a thread of its own. False: too many are waiting.
  [[nodiscard]] bool on_passwords(std::function<std::function<void()>()> work);

 private:
  struct Waiting {
    std::function<std::optional<HttpAnswer>()> look;
    TimePoint until;
    HttpAnswer late;
    Done done;
  };
  void tell_codes();
  void remove_preview(const std::filesystem::path& file);
  /// Whether the page is a preview's, asked for by whom the studio gave its address: the studio shows it in a frame.
  [[nodiscard]] bool is_framed(const HttpRequest& request);
  void answer_get(const HttpRequest& request, const Done& done);
  void answer_post(const HttpRequest& request, const Done& done);
  void serve_file(const HttpRequest& request, FileWanted wanted, const Done& done);
  void serve_content(const HttpRequest& request, const std::string& hash, const Done& done);
  void serve_hand_model(const HttpRequest& request, const Done& done);
  void serve_exhibit(const HttpRequest& request, const std::string& rest, const Done& done);
  void sign_in(const HttpRequest& request, const Done& done);
  void signed_in(const HttpRequest& request, const std::string& user, Role role, const Done& done);
  [[nodiscard]] const Session* session_of(const HttpRequest& request);
  [[nodiscard]] bool may_read(const HttpRequest& request);

  const GatewayOptions options_;
  WebServer& server_;
  client::DisplayWatch& watch_;
  client::ExhibitWatch& exhibits_;
  Accounts accounts_;
  Operations operations_;
  KioskKeeper keeper_;
  Sessions sessions_;
  SignInGuard guard_;
  KioskTokens tokens_;
  KnownContent content_;
  AuditLog audit_;
  VisitsDesk visits_;
  StudioDesk studio_;
  FileStore files_;  // used by the disk's thread
  std::map<std::string, std::shared_ptr<KioskHub>> hubs_;
  std::deque<Waiting> waiting_;
  TimePoint next_look_, next_codes_;
  std::size_t passwords_waiting_ = 0;
  std::size_t disk_waiting_ = 0;
  Worker slow_{"gateway-links"};
  Worker disk_{"gateway-disk"};
  Worker password_thread_{"gateway-words"};
  const Backstage backstage_;
  PlaybackShelf playbacks_;
  PreviewDesk previews_;
};

}  // namespace mechane::gateway
