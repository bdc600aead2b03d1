// DisplayLink: a display's endpoints for whoever looks after it: how it is out, requests in; and where a tracker sees a visitor's head.
#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <mechane/client/displays.hpp>
#include <mechane/client/head.hpp>
#include <mechane/proto/entity.hpp>

namespace mechane::client {

/// report() and take_requests() are one thread's.
class DisplayLink {
 public:
  static constexpr std::size_t kRequests = 32;  ///< more at once are dropped, the oldest first

  [[nodiscard]] static Expected<std::unique_ptr<DisplayLink>> create(const proto::Participant& participant,
                                                                     const std::string& kiosk,
                                                                     const std::string& display, std::uint64_t session);
  DisplayLink(const DisplayLink&) = delete;
  DisplayLink& operator=(const DisplayLink&) = delete;

  /// Kiosk, display and session are the link's own. False where the network did not take it.
  bool report(const DisplayStatus& status);
  [[nodiscard]] std::vector<DisplayRequest> take_requests();
  /// The newest that was told of this display's screen.
  [[nodiscard]] std::optional<ViewerHead> viewer_head();

 private:
  DisplayLink(std::string kiosk, std::string display, std::uint64_t session)
      : kiosk_(std::move(kiosk)), display_(std::move(display)), session_(session) {}
  [[nodiscard]] bool is_meant(std::string_view kiosk, std::string_view display) const;
  void take(proto::ReaderView<proto::DisplayRequest> view);
  void take(proto::ReaderView<proto::ViewerHead> view);

  std::string kiosk_;
  std::string display_;
  std::uint64_t session_;
  std::uint64_t sequence_ = 0;
  std::mutex mutex_;  // for what follows
  std::deque<DisplayRequest> requests_;
  std::optional<ViewerHead> head_;
  proto::Writer<proto::DisplayStatus> statuses_;
  // Last: their listeners end first.
  proto::Reader<proto::DisplayRequest> request_reader_;
  proto::Reader<proto::ViewerHead> head_reader_;
};

}  // namespace mechane::client
