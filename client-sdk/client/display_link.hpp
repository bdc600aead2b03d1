// DisplayLink: a display's endpoints for whoever looks after it: how it is out, wishes in; and where a tracker sees a visitor's head.
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

/// report() and take_wishes() are one thread's.
class DisplayLink {
 public:
  static constexpr std::size_t kWishes = 32;  ///< more at once are dropped, the oldest first

  [[nodiscard]] static Expected<std::unique_ptr<DisplayLink>> create(const proto::Participant& participant,
                                                                     const std::string& kiosk,
                                                                     const std::string& display, std::uint64_t session);
  DisplayLink(const DisplayLink&) = delete;
  DisplayLink& operator=(const DisplayLink&) = delete;

  /// Kiosk, display and session are the link's own. False where the network did not take it.
  bool report(const DisplayStatus& status);
  [[nodiscard]] std::vector<DisplayWish> take_wishes();
  /// The newest that was told of this display's screen.
  [[nodiscard]] std::optional<ViewerHead> viewer_head();

 private:
  DisplayLink(std::string kiosk, std::string display, std::uint64_t session)
      : kiosk_(std::move(kiosk)), display_(std::move(display)), session_(session) {}
  [[nodiscard]] bool is_meant(std::string_view kiosk, std::string_view display) const;
  void take(proto::ReaderView<proto::DisplayWish> view);
  void take(proto::ReaderView<proto::ViewerHead> view);

  std::string kiosk_;
  std::string display_;
  std::uint64_t session_;
  std::uint64_t sequence_ = 0;
  std::mutex mutex_;  // for what follows
  std::deque<DisplayWish> wishes_;
  std::optional<ViewerHead> head_;
  proto::Writer<proto::DisplayStatus> statuses_;
  // Last: their listeners end first.
  proto::Reader<proto::DisplayWish> wish_reader_;
  proto::Reader<proto::ViewerHead> head_reader_;
};

}  // namespace mechane::client
