// DisplayLink: a display's endpoints beside its world: sends its status, receives technicians' requests and the position of
// the visitor's head.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "client-sdk/client/request_queue.hpp"
#include <mechane/client/displays.hpp>
#include <mechane/client/head.hpp>
#include <mechane/proto/entity.hpp>

namespace mechane::client {

/// report() and take_requests() are called by one thread.
class DisplayLink {
 public:
  [[nodiscard]] static Expected<std::unique_ptr<DisplayLink>> create(const proto::Participant& participant,
                                                                     const std::string& kiosk,
                                                                     const std::string& display, std::uint64_t session);
  DisplayLink(const DisplayLink&) = delete;
  DisplayLink& operator=(const DisplayLink&) = delete;

  /// The link fills in kiosk, display and session. False where the status could not be sent.
  bool report(const DisplayStatus& status);
  [[nodiscard]] std::vector<DisplayRequest> take_requests() { return requests_.take(); }
  /// The newest head position that was sent to this display.
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
  RequestQueue<DisplayRequest, 32> requests_;
  std::mutex mutex_;  // for what follows
  std::optional<ViewerHead> head_;
  proto::Writer<proto::DisplayStatus> statuses_;
  // Declared last, so that their listeners end before the rest is destroyed.
  proto::Reader<proto::DisplayRequest> request_reader_;
  proto::Reader<proto::ViewerHead> head_reader_;
};

}  // namespace mechane::client
