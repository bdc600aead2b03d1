#include "client-sdk/visit/calibration_guide.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "client-sdk/visit/device_number.hpp"
#include "client-sdk/visit/hand_drawing.hpp"

namespace mechane::visit {
namespace {

using client::CalibrationStep;
using client::PoseRefusal;

struct PoseWords {
  std::string_view text, more;
};

struct GuideWords {
  std::array<PoseWords, hand::kCalibrationPoses> poses;
  std::string_view hold;
  std::array<std::string_view, static_cast<std::size_t>(PoseRefusal::unseen)> again;  ///< from `moved` on
  PoseWords thanks;
  std::string_view glove;
};

constexpr GuideWords kGuideEn{
    .poses = {{{"Open your hand flat", "Fingers together, the thumb out to the side."},
               {"Make a fist", "The thumb lies over the fingers."},
               {"Make a ring", "The tips of thumb and index finger touch."}}},
    .hold = "Hold it still …",
    .again = {"Once more, please: your hand moved.", "Once more, please: just as in the picture.",
              "Once more from the beginning, please.", "Once more, please: until the circle is full."},
    .thanks = {"Thank you!", "The glove fits your hand now."},
    .glove = "The glove"};

constexpr GuideWords kGuideEl{
    .poses = {{{"Ανοίξτε την παλάμη σας", "Τα δάχτυλα ενωμένα, ο αντίχειρας στο πλάι."},
               {"Κλείστε το χέρι σε γροθιά", "Ο αντίχειρας πάνω από τα δάχτυλα."},
               {"Κάντε έναν κρίκο", "Οι άκρες αντίχειρα και δείκτη αγγίζονται."}}},
    .hold = "Μείνετε ακίνητοι …",
    .again = {"Πάλι, παρακαλούμε: το χέρι κουνήθηκε.", "Πάλι, παρακαλούμε: ακριβώς όπως στην εικόνα.",
              "Πάλι από την αρχή, παρακαλούμε.", "Πάλι, παρακαλούμε: ώσπου να κλείσει ο κύκλος."},
    .thanks = {"Ευχαριστούμε!", "Το γάντι ταιριάζει πια στο χέρι σας."},
    .glove = "Το γάντι"};

}  // namespace

void CalibrationGuide::hear(const std::vector<client::DeviceReport>& devices, TimePoint now) {
  const auto asking = std::ranges::find_if(
      devices, [](const client::DeviceReport& device) { return client::pose_of(device.calibration.step).has_value(); });
  if (asking == devices.end()) {
    const bool fits = std::ranges::any_of(devices, [this](const client::DeviceReport& device) {
      return device.user == glove_.user && device.calibration.step == CalibrationStep::done;
    });
    if (asks() && fits) thanked_ = now;
    told_ = {};
    return;
  }
  thanked_.reset();
  glove_ = *asking;
  numbered_ = std::ranges::any_of(
      devices, [asking](const client::DeviceReport& device) { return is_another_of_its_kind(device, *asking); });
  const client::CalibrationNews& news = asking->calibration;
  if (news == told_) return;
  const bool goes_on = news.step == told_.step && news.held > told_.held;
  ring_before_ = goes_on ? ring(now) : 0;
  since_ = now;
  told_ = news;
}

bool CalibrationGuide::asks() const {
  return client::pose_of(told_.step).has_value();
}

float CalibrationGuide::ring(TimePoint now) const {
  const auto share = static_cast<float>(std::clamp(to_seconds(now - since_) / to_seconds(kRingStep), 0.0, 1.0));
  return ring_before_ + share * (told_.held - ring_before_);
}

std::optional<picture::OverlayPose> CalibrationGuide::at(TimePoint now, const std::string& language) const {
  const GuideWords& words = language == "el" ? kGuideEl : kGuideEn;
  picture::OverlayPose shown;
  shown.total = hand::kCalibrationPoses;
  const auto pose = client::pose_of(told_.step);
  if (!pose) {
    if (!thanked_ || now - *thanked_ > kThanks) return {};
    shown.done = shown.total;
    shown.held = 1;
    shown.text = words.thanks.text;
    shown.more = numbered_ ? by_number(words.thanks.more, glove_) : words.thanks.more;
    return shown;
  }
  const PoseWords& said = words.poses[static_cast<std::size_t>(*pose)];
  shown.done = static_cast<std::uint32_t>(*pose);
  shown.held = ring(now);
  shown.drawing = draw_hand(*pose, glove_.side);
  shown.text = numbered_ ? by_number(words.glove, glove_) + ": " : "";
  shown.text += said.text;
  shown.more = shown.held > 0 ? words.hold : said.more;
  if (told_.refusal != PoseRefusal::none) shown.again = words.again[static_cast<std::size_t>(told_.refusal) - 1];
  return shown;
}

}  // namespace mechane::visit
