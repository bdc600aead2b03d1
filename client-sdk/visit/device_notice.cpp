#include "client-sdk/visit/device_notice.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "client-sdk/visit/device_number.hpp"

namespace mechane::visit {
namespace {

using client::DeviceState;
using Sign = picture::OverlayNotice::Sign;

struct DeviceWords {
  std::string_view text, more;
};

/// What is said in one state. Grammar differs between a handle and a glove, so each has whole sentences.
struct StateWords {
  DeviceState state;
  Sign sign;
  DeviceWords handle_en, glove_en, handle_el, glove_el;
};

constexpr std::string_view kTellStaffEn = "Please tell the staff.";
constexpr std::string_view kTellStaffEl = "Παρακαλούμε, ενημερώστε το προσωπικό.";

/// The most serious first.
constexpr std::array<StateWords, 7> kWords{{
    {DeviceState::lost,
     Sign::unplugged,
     {"The handle is not connected", kTellStaffEn},
     {"The glove is not connected", kTellStaffEn},
     {"Η λαβή δεν είναι συνδεδεμένη", kTellStaffEl},
     {"Το γάντι δεν είναι συνδεδεμένο", kTellStaffEl}},
    {DeviceState::uncalibrated,
     Sign::target,
     {"The handle must be calibrated", kTellStaffEn},
     {"The glove must be calibrated", kTellStaffEn},
     {"Η λαβή χρειάζεται ρύθμιση", kTellStaffEl},
     {"Το γάντι χρειάζεται ρύθμιση", kTellStaffEl}},
    {DeviceState::hot,
     Sign::warm,
     {"The handle is resting", "It became too warm. It will push again once it has cooled."},
     {"The glove is resting", "It became too warm. It will work again once it has cooled."},
     {"Η λαβή ξεκουράζεται", "Ζεστάθηκε πολύ. Θα σπρώχνει ξανά μόλις κρυώσει."},
     {"Το γάντι ξεκουράζεται", "Ζεστάθηκε πολύ. Θα λειτουργήσει ξανά μόλις κρυώσει."}},
    {DeviceState::preparing,
     Sign::wait,
     {"The handle is being prepared", "It will be ready in a moment."},
     {"The glove is being prepared", "It will be ready in a moment."},
     {"Η λαβή ετοιμάζεται", "Σε λίγο θα είναι έτοιμη."},
     {"Το γάντι ετοιμάζεται", "Σε λίγο θα είναι έτοιμο."}},
    {DeviceState::warm,
     Sign::warm,
     {"The handle is warm", "It pushes more gently until it has cooled."},
     {"The glove is warm", "Its force is weaker until it has cooled."},
     {"Η λαβή ζεστάθηκε", "Σπρώχνει πιο απαλά ώσπου να κρυώσει."},
     {"Το γάντι ζεστάθηκε", "Η δύναμή του είναι μικρότερη ώσπου να κρυώσει."}},
    {DeviceState::not_ready,
     Sign::take,
     {"The handle is not ready", "Take it in your hand, or tell the staff."},
     {"The glove is not ready", "Put it on, or tell the staff."},
     {"Η λαβή δεν είναι έτοιμη", "Πιάστε την με το χέρι σας ή ενημερώστε το προσωπικό."},
     {"Το γάντι δεν είναι έτοιμο", "Φορέστε το ή ενημερώστε το προσωπικό."}},
    {DeviceState::let_go,
     Sign::take,
     {"Take the handle in your hand", ""},
     {"Put the glove on", ""},
     {"Πιάστε τη λαβή με το χέρι σας", ""},
     {"Φορέστε το γάντι", ""}},
}};

/// Its place in the table; the table's end where there is nothing to say.
std::size_t place_of(const client::DeviceReport& device) {
  return static_cast<std::size_t>(std::ranges::find(kWords, device.state, &StateWords::state) - kWords.begin());
}

bool is_free(const client::DeviceReport& device) {
  return device.state == DeviceState::not_ready || device.state == DeviceState::let_go;
}

bool is_in_use(const client::DeviceReport& device) {
  return device.state == DeviceState::ready || device.state == DeviceState::warm;
}

}  // namespace

void DeviceNotice::hear(const std::vector<client::DeviceReport>& devices, TimePoint now) {
  const bool used = std::ranges::any_of(devices, is_in_use);
  const client::DeviceReport* worst = nullptr;
  for (const client::DeviceReport& device : devices) {
    if (place_of(device) == kWords.size() || (used && is_free(device))) continue;
    if (worst == nullptr || place_of(device) < place_of(*worst)) worst = &device;
  }
  if (worst == nullptr) return told_.reset();
  if (!told_ || *told_ != *worst) since_ = now;
  told_ = *worst;
  numbered_ = std::ranges::any_of(devices, [worst](const client::DeviceReport& device) {
    return is_another_of_its_kind(device, *worst) && device.state != worst->state;
  });
}

std::optional<picture::OverlayNotice> DeviceNotice::at(TimePoint now, const std::string& language) const {
  if (!told_ || now - since_ < kLasts) return {};
  const StateWords& words = kWords[place_of(*told_)];
  const bool glove = told_->kind == client::HandKind::glove;
  const DeviceWords& said =
      language == "el" ? (glove ? words.glove_el : words.handle_el) : (glove ? words.glove_en : words.handle_en);
  const Sign sign = glove && words.sign == Sign::take ? Sign::wear : words.sign;
  const auto called = [this](std::string_view text) { return numbered_ ? by_number(text, *told_) : std::string(text); };
  return picture::OverlayNotice{sign, called(said.text), called(said.more)};
}

}  // namespace mechane::visit
