#include "client-sdk/display/caption_history.hpp"

namespace mechane::display {

float CaptionHistory::Words::tell(const std::string& shown, TimePoint now) {
  if (text != shown) *this = {shown, now, {}};
  return static_cast<float>(to_seconds(now - from));
}

void CaptionHistory::tell(picture::OverlayContent& content, picture::PixelSize eye, TimePoint now) {
  if (eye.width != eye_.width || eye.height != eye_.height) caption_.at = note_.at = std::nullopt;
  eye_ = eye;
  constexpr char kBetween = '\n';
  content.caption_for_s = caption_.tell(content.goal + kBetween + content.caption + kBetween + content.hint, now);
  const std::string note = content.notice         ? content.notice->text + kBetween + content.notice->more
                           : content.note.empty() ? content.message
                                                  : content.note;
  content.note_for_s = note_.tell(note, now);
  content.caption_at = caption_.at;
  content.note_at = note_.at;
}

void CaptionHistory::see(const draw::OverlayLayout& drawn) {
  caption_.at = drawn.caption;
  note_.at = drawn.note;
}

}  // namespace mechane::display
