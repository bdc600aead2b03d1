#include "client-sdk/haptic/hand_recorder.hpp"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fmt/format.h>

namespace mechane::haptic {
namespace {

tl::unexpected<Error> cannot_write(const std::string& name) {
  return fail(ErrorCode::io_failure, std::string("the hand cannot be recorded: ") + std::strerror(errno), name,
              "make room on the disk, or give another file");
}

}  // namespace

Expected<std::unique_ptr<HandRecorder>> HandRecorder::open(const std::string& file) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out << "# A hand, recorded by mechane haptic: s, m, quaternion w x y z, grasp 0 to 1, buttons; of a glove 20 joints, "
         "rad; left: of a left hand\n"
      << std::flush;
  if (!out) return cannot_write(file);
  return std::unique_ptr<HandRecorder>(new HandRecorder(file, std::move(out)));
}

void HandRecorder::note(const client::HandSample& hand, TimePoint now) noexcept {
  if (!noted_.push({hand, now})) lost_.fetch_add(1, std::memory_order_relaxed);
}

Expected<void> HandRecorder::write() {
  fmt::memory_buffer text;
  for (Noted noted; noted_.pop(noted);) {
    if (first_ == TimePoint{}) {
      first_ = noted.at;
      if (noted.hand.side == client::HandSide::left) fmt::format_to(std::back_inserter(text), "left\n");
    }
    const Vec3& p = noted.hand.X_WH.p;
    const Quat& q = noted.hand.X_WH.R;
    fmt::format_to(std::back_inserter(text), "{:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.3f} {}",
                   to_seconds(noted.at - first_), p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z(),
                   noted.hand.grasp_intent, noted.hand.buttons);
    if (noted.hand.kind == client::HandKind::glove)
      for (const double joint : noted.hand.joints)
        fmt::format_to(std::back_inserter(text), " {:.4f}", joint);
    text.push_back('\n');
  }
  file_.write(text.data(), static_cast<std::streamsize>(text.size()));
  file_.flush();
  if (!file_) return cannot_write(name_);
  return {};
}

}  // namespace mechane::haptic
