#include "client-sdk/client/display_link.hpp"
#include <mechane/client/displays.hpp>
#include <mechane/proto/entity.hpp>
#include <mechane/proto/identity.hpp>
#include <mechane/proto/names.hpp>

namespace mechane::client {
namespace {

class DisplaySeatImpl final : public DisplaySeat {
 public:
  explicit DisplaySeatImpl(std::unique_ptr<DisplayLink> link) : link_(std::move(link)) {}
  bool report(const DisplayStatus& status) override { return link_->report(status); }
  [[nodiscard]] std::vector<DisplayRequest> take_requests() override { return link_->take_requests(); }

 private:
  std::unique_ptr<DisplayLink> link_;
};

class DisplaySeatsImpl final : public DisplaySeats {
 public:
  explicit DisplaySeatsImpl(proto::Participant participant) : participant_(std::move(participant)) {}

  [[nodiscard]] Expected<std::unique_ptr<DisplaySeat>> add(const std::string& kiosk,
                                                           const std::string& display) override {
    if (auto ok = proto::check_name(kiosk, "kiosk"); !ok) return tl::unexpected(ok.error());
    if (auto ok = proto::check_name(display, "display"); !ok) return tl::unexpected(ok.error());
    auto link = DisplayLink::create(participant_, kiosk, display, proto::random_id());
    if (!link) return tl::unexpected(link.error());
    return std::make_unique<DisplaySeatImpl>(std::move(*link));
  }

 private:
  proto::Participant participant_;
};

}  // namespace

Expected<std::unique_ptr<DisplaySeats>> DisplaySeats::open(std::uint32_t domain) {
  auto participant = proto::Participant::create(domain);
  if (!participant) return tl::unexpected(participant.error());
  return std::make_unique<DisplaySeatsImpl>(std::move(*participant));
}

}  // namespace mechane::client
