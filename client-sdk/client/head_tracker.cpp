#include <chrono>

#include <mechane/client/head.hpp>
#include <mechane/proto/convert.hpp>
#include <mechane/proto/entity.hpp>
#include <mechane/proto/identity.hpp>

namespace mechane::client {
namespace {

class HeadTrackerImpl final : public HeadTracker {
 public:
  HeadTrackerImpl(proto::Participant participant, proto::Writer<proto::ViewerHead> heads)
      : participant_(std::move(participant)), heads_(std::move(heads)) {}

  void address(const std::string& kiosk, const std::string& display) {
    proto::set_text(wire_.kiosk, kiosk);
    proto::set_text(wire_.display, display);
    wire_.protocol = proto::kProtocol;
    wire_.session = proto::random_id();
  }

  bool tell(const Pose& X_SV) override {
    Pose unit = X_SV;
    if (!X_SV.p.allFinite() || !proto::normalise(unit)) return false;
    proto::set_pose(wire_.X_SV, unit);
    wire_.seen = true;
    return send();
  }
  bool tell_nobody() override {
    proto::set_pose(wire_.X_SV, Pose{});
    wire_.seen = false;
    return send();
  }

 private:
  bool send() {
    ++wire_.seq;
    wire_.sent_ns = to_ns(std::chrono::steady_clock::now());
    return heads_.write(wire_);
  }

  proto::Participant participant_;
  proto::Writer<proto::ViewerHead> heads_;
  proto::ViewerHead wire_{};
};

}  // namespace

Expected<std::unique_ptr<HeadTracker>> HeadTracker::open(const std::string& kiosk, const std::string& display,
                                                         std::uint32_t domain) {
  if (auto ok = proto::check_name(kiosk, "kiosk"); !ok) return tl::unexpected(ok.error());
  if (!display.empty()) {
    if (auto ok = proto::check_name(display, "display"); !ok) return tl::unexpected(ok.error());
  }
  auto participant = proto::Participant::create(domain);
  if (!participant) return tl::unexpected(participant.error());
  auto heads = proto::Writer<proto::ViewerHead>::create(*participant, "");
  if (!heads) return tl::unexpected(heads.error());
  auto tracker = std::make_unique<HeadTrackerImpl>(std::move(*participant), std::move(*heads));
  tracker->address(kiosk, display);
  return tracker;
}

}  // namespace mechane::client
