#include "client-sdk/gateway/browsers/browser.hpp"

#include <algorithm>
#include <utility>

#include <unistd.h>

#include "client-sdk/gateway/browsers/browser_text.hpp"
#include "client-sdk/gateway/browsers/kiosk_hub.hpp"
#include "server/log/log.hpp"
#include <mechane/proto/identity.hpp>

namespace mechane::gateway {
namespace {

constexpr std::size_t kAnswersKept = 8;
constexpr std::size_t kMissingTold = 8;
/// A page in the background reports nothing.
constexpr Duration kStatusOld = std::chrono::seconds(5);

client::DisplaySettings settings_of_browser() {
  client::DisplaySettings settings;
  settings.attract = false;  // a browser has no recorded visit to show
  return settings;
}

}  // namespace

Browser::Browser(std::shared_ptr<KioskHub> hub, std::string token)
    : hub_(std::move(hub)),
      token_(std::move(token)),
      display_(hub_->next_display()),
      settings_(settings_of_browser()),
      panel_(visit::panel_settings(settings_)),
      writer_(settings_.language),
      hand_([this] { return std::make_unique<pointer::PointerLink>(hub_->kiosk(), hub_->backstage().domain); }),
      tracked_([this] { return std::make_unique<TrackedLink>(hub_->kiosk(), hub_->backstage().domain); },
               [this](std::unique_ptr<TrackedLink> link) { hub_->backstage().end_slowly(std::move(link)); }) {}

Browser::~Browser() {
  for (auto& hand : hand_.take_away())
    hub_->backstage().end_slowly(std::move(hand));
  hub_->backstage().end_slowly(std::move(seat_));
}

void Browser::opened(std::shared_ptr<Socket> socket) {
  socket_ = std::move(socket);
  opened_ = followed_ = time_now();
  say("hello", hello_text(hub_->kiosk(), display_, hub_->backstage().finders));
  say("settings", settings_text(settings_));
  hub_->join(shared_from_this());
  sit_down();
}

/// Asks the network for a place among the kiosk's displays.
void Browser::sit_down() {
  const Backstage& backstage = hub_->backstage();
  backstage.slow.give([kiosk = hub_->kiosk(), display = display_, backstage, weak = weak_from_this()] {
    auto seat = backstage.seats->add(kiosk, display);
    if (!seat) return log::error(seat.error());
    backstage.post([backstage, weak, made = std::make_shared<std::unique_ptr<client::DisplaySeat>>(std::move(*seat))] {
      if (const auto self = weak.lock()) return void(self->seat_ = std::move(*made));
      backstage.end_slowly(std::move(*made));
    });
  });
}

void Browser::closed() {
  hand_.release();
  tracked_.release();
  hub_->leave(*this);
  socket_.reset();
}

void Browser::say(std::string_view kind, std::string text) {
  if (socket_) socket_->send_text(kind, std::make_shared<const std::string>(std::move(text)));
}

void Browser::part(const std::string& reason, const std::string& remedy) {
  say("bye", bye_text(reason, remedy));
  if (socket_) socket_->close();
}

void Browser::refuse(const Error& error) {
  log::warning("a message of " + hub_->kiosk() + "/" + display_ + " was refused: " + error.to_string());
  part(error.where.empty() ? error.what : error.what + ": " + error.where,
       "reload the page; if this comes again, gateway and page are of different versions");
}

void Browser::text(std::string_view message) {
  const auto parsed = parse_browser_message(message);
  if (!parsed) return refuse(parsed.error());
  if (!std::holds_alternative<StatusMessage>(*parsed)) hub_->backstage().tokens.use(token_, time_now());
  std::visit([this](const auto& one) { take(one); }, *parsed);
}

void Browser::binary(std::span<const std::byte> message) {
  const auto hands = parse_tracked_message(message);
  if (!hands) return refuse(hands.error());
  const bool seen = std::ranges::any_of(*hands, &TrackedHand::tracked);
  if (seen) panel_.notice_visitor(time_now());
  if (seen) hub_->backstage().tokens.use(token_, time_now());
  tracked_.take(*hands);
}

void Browser::take(const PointerMessage& message) {
  using Kind = pointer::PointerEvent::Kind;
  const auto presses = [](const PointerMessage::One& one) {
    return one.event.kind != Kind::left && one.event.kind != Kind::gone;
  };
  if (std::ranges::any_of(message.events, presses)) panel_.touch(time_now());
  if (panel_.has_sign()) return hand_.release();
  hand_.take(message, hub_->world());
}

void Browser::take(const PressMessage& message) {
  if (panel_.has_sign()) return;
  const bool begins = message.action.kind == picture::OverlayAction::Kind::activity && hub_->status() != nullptr &&
                      std::ranges::count(hub_->status()->activities, message.action.value) > 0;
  if (begins) (void)hub_->client()->start_activity(message.action.value);
  panel_.press(message.action, time_now());
}

void Browser::take(const TouchMessage& /*message*/) {
  panel_.touch(time_now());
}

void Browser::take(const LanguageMessage& message) {
  panel_.press({picture::OverlayAction::Kind::language, message.code}, time_now());
}

void Browser::take(const ClickMessage& message) {
  panel_.touch(time_now());
  const client::SceneObject* object = pointer::object_of(hub_->world().objects, message.object);
  if (object != nullptr && hub_->client() != nullptr && !panel_.has_sign()) (void)hub_->client()->click(object->name);
}

void Browser::take(const SettingsMessage& message) {
  const picture::OverlayStyle style = panel_.settings().style;
  if (message.large_text && *message.large_text != (style.text_scale > 1)) panel_.toggle_large_text();
  if (message.high_contrast && *message.high_contrast != style.high_contrast) panel_.toggle_high_contrast();
}

void Browser::take(const StatusMessage& message) {
  status_ = message;
  status_came_ = time_now();
}

void Browser::forget_world() {
  hand_.release();
  decisions_ = {};  // the next world is told the language anew
}

picture::OverlayContent Browser::words(TimePoint now) {
  const std::string& language = panel_.language();
  picture::OverlayContent content;
  writer_.set_language(language);
  if (hub_->status() != nullptr) content = writer_.write(*hub_->status(), hub_->frame());
  content.note = visit::link_note(hub_->link(), hub_->status() != nullptr, language);
  content.notice = hub_->devices().at(now, language);
  content.pose = hub_->calibration().at(now, language);
  panel_.write(content, now);
  if (content.pose) content.panel.reset();  // the questions would cover the pose
  if (content.note.empty() && !content.panel) content.note = hand_.note(language);
  if (const auto button = pointer::go_on_button(hub_->status(), language); button && !content.panel)
    content.corner.insert(content.corner.begin(), *button);
  return content;
}

void Browser::refresh(TimePoint now) {
  if (!socket_) return;
  if (hub_->calibration().asks()) panel_.notice_visitor(now);
  client::Client* const client = hub_->client();
  const auto server = client == nullptr ? std::nullopt : client->server_status();
  const std::string home = server && !server->scenarios.empty() ? server->scenarios.front() : std::string();
  panel_.update({hub_->status(), hub_->presentation(), hub_->frame(), home}, now);
  if (client != nullptr)
    decisions_.send(panel_, *client, hub_->presentation());
  else
    (void)panel_.take_requests();  // there is nobody to send them to
  subtitles_.hear(hub_->status(), panel_.language(), now);
  const picture::OverlayContent content = words(now);
  const auto& presentation = hub_->presentation();
  std::string text =
      overlay_text({content, panel_.language(), presentation ? presentation->languages : std::vector<std::string>(),
                    subtitles_.at(now)});
  if (text == told_overlay_) return;
  told_overlay_ = text;
  say("overlay", std::move(text));
}

void Browser::follow(TimePoint now) {
  hand_.pass(to_seconds(now - std::exchange(followed_, now)));
  if (std::string text = tracked_.text(); text != told_tracked_) {
    told_tracked_ = text;
    say("tracked", std::move(text));
  }
  const std::vector<HandTold> hands = hand_.told();
  if (hands.empty()) return;
  std::string text = pointer_text(hands);
  if (text == told_pointer_) return;
  told_pointer_ = text;
  say("pointer", std::move(text));
}

/// As technicians have set them, and visitors after that.
client::DisplaySettings Browser::shown_settings() const {
  client::DisplaySettings shown = settings_;
  shown.large_text = panel_.settings().style.text_scale > 1;
  shown.high_contrast = panel_.settings().style.high_contrast;
  return shown;
}

void Browser::answer_requests() {
  if (!seat_) return;
  for (const client::DisplayRequest& request : seat_->take_requests()) {
    client::DisplaySettings wanted = shown_settings();
    client::RequestAnswer answer{request.id, "", ""};
    if (request.restart) {
      answer.refusal = "a browser cannot be started again from afar; reload its page";
    } else if (request.picture) {
      answer.refusal = "a browser gives no picture of itself; look at the browser";
    } else if (auto applied = client::apply(request.settings, wanted); !applied) {
      answer.refusal = applied.error().to_string();
    } else if (wanted.attract) {
      answer.refusal = "a browser has no recorded visit to show";
    } else {
      settings_ = wanted;
      panel_.change(visit::panel_settings(settings_));
      if (panel_.has_sign()) hand_.release();
      say("settings", settings_text(settings_));
    }
    answers_.push_back(std::move(answer));
    if (answers_.size() > kAnswersKept) answers_.erase(answers_.begin());
  }
}

void Browser::report(TimePoint now) {
  if (!token_.empty() && !hub_->backstage().tokens.opens(token_, hub_->kiosk(), now))
    return part("this address has ended, because nobody touched anything for a while",
                "scan the kiosk's code again, or ask the museum's staff");
  if (!seat_ || !socket_) return;
  answer_requests();
  const bool fresh = now - status_came_ < kStatusOld;
  pictures_ += fresh ? static_cast<std::uint64_t>(status_.pictures_per_s) : 0;
  client::DisplayStatus out;
  out.version = MECHANE_VERSION;
  out.host = proto::host_name();
  out.process_id = static_cast<std::uint32_t>(::getpid());
  out.uptime_s = static_cast<std::uint64_t>(to_seconds(now - opened_));
  out.width = status_.width;
  out.height = status_.height;
  out.pictures = pictures_;
  out.pictures_per_s = fresh ? status_.pictures_per_s : 0;
  out.picture_ms_median = status_.picture_ms_median;
  out.picture_ms_p99 = status_.picture_ms_p99;
  out.link = static_cast<std::uint32_t>(hub_->link());
  if (hub_->link() == client::LinkState::refused) out.refusal = hub_->client()->refusal();
  if (hub_->status() != nullptr) {
    out.world = hub_->status()->world;
    out.scenario = hub_->status()->scenario;
  }
  out.frames_per_s = hub_->frames_per_s();
  out.missing_total = static_cast<std::uint32_t>(status_.missing.size());
  out.missing.assign(status_.missing.begin(),
                     status_.missing.begin() + static_cast<long>(std::min(kMissingTold, status_.missing.size())));
  out.renderer = status_.renderer.empty() ? "a browser" : status_.renderer;
  out.sound_problem = settings_.silent() ? "muted" : "";
  out.showing = "world";
  out.settings = client::settings_of(shown_settings());
  out.answers = answers_;
  (void)seat_->report(out);
}

}  // namespace mechane::gateway
