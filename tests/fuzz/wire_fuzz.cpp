// Whatever bytes arrive as a sample: the doors of server and client take it or refuse it, and what they take is fit for use.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "client-sdk/client/frame_history.hpp"
#include "client-sdk/client/parse.hpp"
#include "server/transport/validate.hpp"
#include <mechane/client/types.hpp>
#include <mechane/proto/convert.hpp>

namespace {

using namespace mechane;

/// Reads values off the input, zeros behind its end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  template <class T>
  T take() {
    T value{};
    const std::size_t n = std::min(sizeof(T), size_);
    std::memcpy(&value, data_, n);
    data_ += n;
    size_ -= n;
    return value;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

void must(bool held) {
  if (!held) std::abort();
}

void fuzz_input(Bytes bytes) {
  auto wire = bytes.take<proto::HapticInput>();
  wire.protocol = proto::kProtocol;
  state::HandSample sample;
  if (transport::validate(wire, sample) != transport::Reject::none) return;
  must(sample.X_WH.p.norm() < transport::kMaxDistanceM && sample.session != 0);
  must(std::abs(sample.X_WH.R.norm() - 1) < 1e-9);
}

void fuzz_output(Bytes bytes) {
  auto wire = bytes.take<proto::HapticOutput>();
  wire.protocol = proto::kProtocol;
  client::ForceSample force;
  if (!client::parse(wire, force)) return;
  must(force.contact_count <= client::kMaxLocalContacts && force.force_W.f.allFinite() && force.force_W.t.allFinite());
}

void fuzz_kiosk(Bytes bytes) {
  auto wire = bytes.take<proto::KioskStatus>();
  wire.protocol = proto::kProtocol;
  transport::Session session;
  if (transport::validate(wire, session) != transport::Reject::none) return;
  must(proto::is_name(session.kiosk) && session.user < state::kMaxUsers && session.id != 0);
}

void fuzz_frame(Bytes bytes) {
  client::FrameHistory history;
  for (int i = 0; i < 3; ++i) {
    std::vector<proto::WireBodyPose> bodies(bytes.take<std::uint8_t>() % 8);
    for (auto& b : bodies)
      b = bytes.take<proto::WireBodyPose>();
    std::vector<std::uint8_t> visible(bytes.take<std::uint8_t>() % 8);
    std::vector<double> quantities(bytes.take<std::uint8_t>() % 4);
    for (auto& q : quantities)
      q = bytes.take<double>();
    std::vector<proto::WirePose> segments(bytes.take<std::uint8_t>() % 20);
    for (auto& s : segments)
      s = bytes.take<proto::WirePose>();
    std::vector<proto::WireHandPose> hands(bytes.take<std::uint8_t>() % 3);
    for (auto& h : hands) {
      h.kind = bytes.take<std::uint8_t>();
      proto::look_into(h.X_WS, segments);
    }
    proto::SceneFrame wire{};
    wire.protocol = proto::kProtocol;
    wire.seq = bytes.take<std::uint8_t>();
    wire.sent_ns = bytes.take<std::uint64_t>();
    proto::look_into(wire.bodies, bodies);
    proto::look_into(wire.visible, visible);
    proto::look_into(wire.quantities, quantities);
    proto::look_into(wire.hands, hands);
    client::Frame frame;
    if (!client::parse(wire, frame)) continue;
    frame.received = TimePoint(std::chrono::hours(1) + i * std::chrono::milliseconds(16));
    history.add(frame, wire.sent_ns);
  }
  client::Frame out;
  if (!history.at(TimePoint(std::chrono::hours(1)), out)) return;
  for (const auto& body : out.bodies)
    must(std::abs(body.X_WB.R.norm() - 1) < 1e-6);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const Bytes rest(data + 1, size - 1);
  switch (data[0] % 4) {
    case 0:
      fuzz_input(rest);
      break;
    case 1:
      fuzz_output(rest);
      break;
    case 2:
      fuzz_kiosk(rest);
      break;
    default:
      fuzz_frame(rest);
      break;
  }
  return 0;
}
