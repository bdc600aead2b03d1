// One browser at a kiosk: its words, its hand, its place among the kiosk's displays. On the loop's thread.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "client-sdk/gateway/browsers/browser_hand.hpp"
#include "client-sdk/gateway/browsers/browser_message.hpp"
#include "client-sdk/gateway/browsers/tracked_hands.hpp"
#include "client-sdk/gateway/http/http_types.hpp"
#include "client-sdk/visit/decision_sender.hpp"
#include "client-sdk/visit/overlay_text.hpp"
#include "client-sdk/visit/subtitles.hpp"
#include <mechane/client/displays.hpp>

namespace mechane::gateway {

class KioskHub;

class Browser final : public SocketUser, public std::enable_shared_from_this<Browser> {
 public:
  /// `token`: from the kiosk's address; empty: somebody who is signed in.
  Browser(std::shared_ptr<KioskHub> hub, std::string token);
  ~Browser() override;
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  void opened(std::shared_ptr<Socket> socket) override;
  void text(std::string_view message) override;
  void binary(std::span<const std::byte> message) override;
  void closed() override;

  // For the hub, while the socket is open.

  void tell(std::string_view kind, const std::shared_ptr<const std::string>& text) { socket_->send_text(kind, text); }
  void show(const std::shared_ptr<const FrameBody>& frame) { socket_->send_frame(frame); }
  void forget_world();
  /// The words over the picture; ten times a second.
  void refresh(TimePoint now);
  /// The hand, where it has changed; thirty times a second.
  void follow(TimePoint now);
  /// The status to technicians, once a second. Ends the visit of somebody whose token has ended.
  void report(TimePoint now);
  void part(const std::string& reason, const std::string& remedy);

 private:
  void take(const PointerMessage& message);
  void take(const PressMessage& message);
  void take(const TouchMessage& message);
  void take(const LanguageMessage& message);
  void take(const ClickMessage& message);
  void take(const SettingsMessage& message);
  void take(const StatusMessage& message);
  void refuse(const Error& error);
  void sit_down();
  void answer_requests();
  [[nodiscard]] client::DisplaySettings shown_settings() const;
  [[nodiscard]] picture::OverlayContent words(TimePoint now);
  void say(std::string_view kind, std::string text);

  const std::shared_ptr<KioskHub> hub_;
  const std::string token_;
  std::string display_;  ///< "web-3"
  std::shared_ptr<Socket> socket_;
  client::DisplaySettings settings_;
  visit::VisitorPanel panel_;
  visit::OverlayWriter writer_;
  visit::Subtitles subtitles_;
  BrowserHand hand_;
  TrackedHands tracked_;
  std::unique_ptr<client::DisplaySeat> seat_;               ///< null until the network has made it
  std::string told_overlay_, told_pointer_, told_tracked_;  ///< the last texts of these kinds
  visit::DecisionSender decisions_;
  StatusMessage status_;
  TimePoint status_came_, opened_, followed_;
  std::uint64_t pictures_ = 0;
  std::vector<client::RequestAnswer> answers_;
};

}  // namespace mechane::gateway
