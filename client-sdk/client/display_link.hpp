// DisplayLink: a display's endpoints for whoever looks after it: how it is out, wishes in.
#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <mechane/client/displays.hpp>
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

 private:
  DisplayLink(std::string kiosk, std::string display, std::uint64_t session)
      : kiosk_(std::move(kiosk)), display_(std::move(display)), session_(session) {}
  void take(proto::ReaderView<proto::DisplayWish> view);

  std::string kiosk_;
  std::string display_;
  std::uint64_t session_;
  std::uint64_t sequence_ = 0;
  std::mutex mutex_;  // for what follows
  std::deque<DisplayWish> wishes_;
  proto::Writer<proto::DisplayStatus> statuses_;
  proto::Reader<proto::DisplayWish> reader_;  // last: its listener ends first
};

}  // namespace mechane::client
